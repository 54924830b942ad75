#include "pair_support.h"
#include "sealed_choice.h"
#include "sealed_switch.h"

namespace plumbline::tests::corpus {

void add_sealed_phase(std::vector<Case>& cases);

namespace fifth {
namespace {

/// Which way light comes from; the scattered direction is counted from the way it goes.
template <class T>
Xyz<T> arriving() {
  return normalized(Xyz<T>{T(0.3), T(-0.6), T(0.5)});
}

/// Henyey and Greenstein's density of the cosine c with the way that light goes.
template <class T>
T henyey(T g, T c) {
  const T root = std::sqrt(1 + g * g - 2 * g * c);
  return (1 - g * g) / (4 * pi_v<T> * root * root * root);
}

template <class T>
T henyey_cosine(T g, T u) {
  if (std::abs(g) < T(1e-3)) return 2 * u - 1;
  const T s = (1 - g * g) / (1 - g + 2 * g * u);
  return std::clamp((1 + g * g - s * s) / (2 * g), T(-1), T(1));
}

template <class T>
struct Fog {
  int fault;
  T g;
  Xyz<T> wo = arriving<T>();

  Xyz<T> sample(T u, T v) const {
    T c = henyey_cosine(g, u);
    if (fault == 3) {
      const T s = (1 - g * g) / (1 - g + 2 * g * u);
      c = (1 + g * g - s * s) / (2 * g);
    }
    return Frame<T>(T(-1) * wo).to_world(at_height(c, 2 * pi_v<T> * v));
  }
  T pdf(const Xyz<T>& wi) const {
    if (fault == 1) return henyey(g, dot(wo, wi));
    const T q = henyey(g, -dot(wo, wi));
    return fault == 2 ? 2 * q : q;
  }
};

template <class T>
Pair fog(int fault, T g) {
  return pair_of<Xyz<T>>("fog", Domain::sphere(), Fog<T>{put(fault), g});
}

/// A sharp lobe forwards and a broad one backwards; the first number chooses as well.
template <class T>
struct TwoLobes {
  int fault;
  T forward = T(0.7), backward = T(-0.4), share = T(0.8);
  Xyz<T> wo = arriving<T>();

  Xyz<T> sample(T u, T v) const {
    const bool first = u < share;
    T left = first ? u / share : (u - share) / (1 - share);
    if (fault == 2) left = u;
    const T c = henyey_cosine(first ? forward : backward, short_of_one(left));
    return Frame<T>(T(-1) * wo).to_world(at_height(c, 2 * pi_v<T> * v));
  }
  T pdf(const Xyz<T>& wi) const {
    const T c = -dot(wo, wi), p = fault == 1 ? 1 - share : share;
    return p * henyey(forward, c) + (1 - p) * henyey(backward, c);
  }
};

template <class T>
Pair two_lobes(int fault) {
  Pair pair = pair_of<Xyz<T>>("two lobes", Domain::sphere(), TwoLobes<T>{put(fault)});
  pair.many_to_one = true;
  return pair;
}

/// Rayleigh's, with the root of the cubic.
///
/// @source Frisvad 2011 (JOSA A 28:12), "Importance sampling the Rayleigh phase function", Eq. 5
template <class T>
struct BlueSky {
  int fault;
  Xyz<T> wo = arriving<T>();

  Xyz<T> sample(T u, T v) const {
    const T z = 2 * (2 * u - 1), root = std::sqrt(z * z + 1);
    const T a = std::cbrt(z + root);
    const T c = std::clamp(a - 1 / a, T(-1), T(1));
    return Frame<T>(T(-1) * wo).to_world(at_height(c, 2 * pi_v<T> * v));
  }
  T pdf(const Xyz<T>& wi) const {
    const T c = dot(wo, wi);
    return 3 * (1 + c * c) / ((fault == 1 ? 8 : 16) * pi_v<T>);
  }
};

/// Schlick's stand-in for Henyey and Greenstein.
///
/// @source Blasi et al. 1993; k = 1.55 g - 0.55 g^3
template <class T>
struct Mist {
  int fault;
  T g = T(0.5);
  Xyz<T> wo = arriving<T>();

  T k() const { return T(1.55) * g - T(0.55) * g * g * g; }
  Xyz<T> sample(T u, T v) const {
    const T c = (2 * u + k() - 1) / (2 * k() * u - k() + 1);
    return Frame<T>(T(-1) * wo).to_world(at_height(c, 2 * pi_v<T> * v));
  }
  T pdf(const Xyz<T>& wi) const {
    const T width = fault == 1 ? g : k(), below = 1 + width * dot(wo, wi);
    return (1 - width * width) / (4 * pi_v<T> * below * below);
  }
};

/// Flakes that mirror, by the normals that wo sees.
///
/// @source Heitz et al. 2015 (TOG 34:4), "The SGGX Microflake Distribution", Eq. 5, 10, 16
template <class T>
struct Flakes {
  int fault;
  Xyz<T> size{T(0.25), T(0.6), T(1)};
  Xyz<T> wo = arriving<T>();

  static Xyz<T> times(const Xyz<T>& a, const Xyz<T>& b) {
    return {a.x * b.x, a.y * b.y, a.z * b.z};
  }
  T area(const Xyz<T>& w) const { return length(times(size, w)); }
  T density(const Xyz<T>& m) const {
    const Xyz<T> s = times({1 / size.x, 1 / size.y, 1 / size.z}, m);
    return 1 / (pi_v<T> * size.x * size.y * size.z * dot(s, s) * dot(s, s));
  }
  Xyz<T> sample(T u, T v) const {
    const Frame<T> seen(normalized(times(size, wo)));
    const T r = std::sqrt(u), turn = 2 * pi_v<T> * v;
    const Xyz<T> p{r * std::cos(turn), r * std::sin(turn), std::sqrt(std::max(T(0), 1 - u))};
    const Xyz<T> m = normalized(times(size, seen.to_world(p)));
    return normalized(2 * dot(wo, m) * m - wo);
  }
  T pdf(const Xyz<T>& wi) const {
    const Xyz<T> sum = wo + wi;
    if (!(dot(sum, sum) > 0)) return 0;
    const Xyz<T> m = normalized(sum);
    if (fault == 1) return density(m) * dot(wo, m) / area(wo);
    return density(m) / (4 * area(fault == 2 ? wi : wo));
  }
};

template <class T>
Pair flakes(int fault) {
  return pair_of<Xyz<T>>("flakes", Domain::sphere(), Flakes<T>{put(fault)});
}

/// Light goes anywhere.
template <class T>
struct Anywhere {
  int fault;

  Xyz<T> sample(T u, T v) const {
    return at_height(fault == 1 ? std::cos(pi_v<T> * u) : 1 - 2 * u, 2 * pi_v<T> * v);
  }
  T pdf(const Xyz<T>&) const { return 1 / (4 * pi_v<T>); }
};

/// A measured phase function: even within steps of the cosine.
template <class T>
struct Droplets {
  static constexpr int kSteps = 12;
  int fault;
  std::vector<Choice<T>> step;  ///< one
  Frame<T> way{T(-1) * arriving<T>()};

  explicit Droplets(int which) : fault(which) {
    std::vector<T> light;
    for (int k = 0; k < kSteps; ++k) {
      const T c = (static_cast<T>(k) + T(0.5)) / kSteps;
      light.push_back(T(0.1) + 3 * c * c * c * c + (k == 1 ? T(0.4) : T(0)));
    }
    step.emplace_back(light);
  }
  Xyz<T> sample(T u, T v) const {
    const int k = step[0].index(u);
    const T c = 2 * (static_cast<T>(k) + step[0].left(u, k)) / kSteps - 1;
    return way.to_world(at_height(c, 2 * pi_v<T> * v));
  }
  T pdf(const Xyz<T>& wi) const {
    const int k = cell_of((dot(wi, way.z) + 1) / 2, kSteps);
    return step[0].probability(fault == 1 ? std::max(k - 1, 0) : k) * kSteps / (4 * pi_v<T>);
  }
};

}  // namespace
}  // namespace fifth

void add_sealed_phase(std::vector<Case>& cases) {
  using namespace fifth;
  cases.push_back(twin("fifth fog/g 0.6/double/backwards in pdf",
                       because("pdf takes the cosine with where light comes from, not goes to"),
                       {Kind::mirrored}, [] { return fog<double>(1, 0.6); }));
  cases.push_back(twin("fifth fog/g -0.3/float/2 pi for 4 pi",
                       because("pdf is normalised by 2 pi where it is to be 4 pi"),
                       {Kind::constant}, [] { return fog<float>(2, -0.3F); }));
  cases.push_back(twin("fifth fog/g 0/double/no case for g 0",
                       because("g = 0 has no case of its own in sample: 0/0"), {Kind::not_finite},
                       [] { return fog<double>(3, 0.0); }));
  cases.push_back(twin("fifth two lobes/double/shares exchanged in pdf",
                       because("pdf has the backward lobe's share for the forward one"),
                       {Kind::lobe_probability}, [] { return two_lobes<double>(1); }));
  cases.push_back(twin("fifth two lobes/float/number not stretched",
                       because("the number that chose the lobe is its cosine's as it is"),
                       {Kind::numbers_reused}, [] { return two_lobes<float>(2); }));
  cases.push_back(twin(
      "fifth blue sky/double/8 pi", because("pdf divides by 8 pi, not by 16 pi"), {Kind::constant},
      [] { return pair_of<Xyz<double>>("blue sky", Domain::sphere(), BlueSky<double>{put(1)}); }));
  cases.push_back(
      twin("fifth mist/g 0.5/double/g for k in pdf",
           because("pdf has g where the approximation has a cubic of it"), {Kind::roughness},
           [] { return pair_of<Xyz<double>>("mist", Domain::sphere(), Mist<double>{put(1)}); }));
  cases.push_back(twin("fifth flakes/double/per normal",
                       because("B3: pdf is that of the flake's normal, without 1/(4 wo.m)"),
                       {Kind::half_vector_jacobian}, [] { return flakes<double>(1); }));
  cases.push_back(twin("fifth flakes/float/area seen from wi",
                       because("B13: pdf has the flakes' area as wi sees them, sample as wo does"),
                       {Kind::directions_swapped}, [] { return flakes<float>(2); }));
  cases.push_back(twin(
      "fifth anywhere/float/angle evenly", because("sample draws the angle evenly, not its cosine"),
      {Kind::sine},
      [] { return pair_of<Xyz<float>>("anywhere", Domain::sphere(), Anywhere<float>{put(1)}); }));
  cases.push_back(twin(
      "fifth droplets/12/double/step before",
      because("pdf reads the step of the cosine before the direction's"), {Kind::shifted},
      [] { return pair_of<Xyz<double>>("droplets", Domain::sphere(), Droplets<double>(put(1))); }));
}

}  // namespace plumbline::tests::corpus
