#include "pair_support.h"
#include "sealed_switch.h"

namespace plumbline::tests::corpus {

void add_sealed_phase(std::vector<Case>& cases);

namespace {

using fresh::on;
using fresh::said;

template <class T>
Frame<T> onward() {
  return Frame<T>(normalized(Xyz<T>{T(-0.2), T(0.7), T(0.5)}));
}

/// Cosine of the deflection after Henyey and Greenstein, and its density per solid angle.
template <class T>
T deflection(T g, T u) {
  const T k = (1 - g * g) / (1 + g - 2 * g * u);
  return std::clamp((1 + g * g - k * k) / (2 * g), T(-1), T(1));
}

template <class T>
T hg(T g, T cosine) {
  const T d = 1 + g * g - 2 * g * cosine;
  return (1 - g * g) / (4 * pi_v<T> * d * std::sqrt(d));
}

/// Cloud: a forward lobe, and a share that is scattered evenly. The second number chooses.
template <class T>
struct Cloud {
  int fault;
  T g, even;
  Frame<T> frame;

  std::optional<Record<Xyz<T>, T>> sample(T u, T v) const {
    const bool evenly = v < even;
    T left = evenly ? v / even : (v - even) / (1 - even);
    if (fault == 4) left = v;
    const T c = evenly ? 1 - 2 * u : deflection(g, u);
    const Xyz<T> w = frame.to_world(around_z(1 - c, 2 * pi_v<T> * left));
    const T density = pdf(w);
    if (fault == 3) {
      const T chosen = evenly ? 1 / (4 * pi_v<T>) : hg(g, dot(w, frame.z));
      return Record<Xyz<T>, T>{w, chosen, value(w) / chosen};
    }
    return Record<Xyz<T>, T>{w, density, fault == 5 ? T(1) : value(w) / density};
  }
  T pdf(const Xyz<T>& w) const {
    const T forward = hg(g, dot(w, frame.z));
    if (fault == 1) return even + (1 - even) * forward * 4 * pi_v<T>;
    if (fault == 2) return even / (4 * pi_v<T>)+forward;
    return even / (4 * pi_v<T>)+(1 - even) * forward;
  }
  T value(const Xyz<T>& w) const {  // with the albedo of single scattering
    return T(0.9) * (even / (4 * pi_v<T>)+(1 - even) * hg(g, dot(w, frame.z)));
  }
};

template <class T>
Pair cloud(T g, int fault) {
  return recorded_pair_of<Xyz<T>>("cloud", Domain::sphere(),
                                  Cloud<T>{on(fault), g, T(0.3), onward<T>()});
}

/// Henyey–Greenstein with Rayleigh's 1 + cos², by rejection from the former.
///
/// @source Cornette, Shanks 1992 (Applied Optics 31:16), "Physically reasonable analytic expression
/// for the single-scattering phase function"
template <class T>
struct Aerosol {
  int fault;
  T g;
  Frame<T> frame;

  Xyz<T> sample(Random& random) const {
    for (;;) {
      const T c = deflection(g, verify::uniform<T>(random));
      const T phi = 2 * pi_v<T> * verify::uniform<T>(random);
      const bool kept = verify::uniform<T>(random) < (1 + c * c) / 2;
      if (kept || fault == 2) return frame.to_world(around_z(1 - c, phi));
    }
  }
  T pdf(const Xyz<T>& w) const {
    const T c = fault == 1 ? -dot(w, frame.z) : dot(w, frame.z);
    return T(1.5) * (1 + c * c) / (2 + g * g) * hg(g, c);
  }
};

/// Any direction, two ways.
enum class Even { polar, ball };

template <class T>
struct EvenDirections {
  int fault;
  Even way;

  Xyz<T> sample(Random& random) const {
    const auto number = [&random] { return verify::uniform<T>(random); };
    if (way == Even::polar) {
      const T u = number(), phi = 2 * pi_v<T> * number();
      if (fault == 1) {
        return {std::sin(pi_v<T> * u) * std::cos(phi), std::sin(pi_v<T> * u) * std::sin(phi),
                std::cos(pi_v<T> * u)};
      }
      return around_z(2 * u, phi);
    }
    for (;;) {
      const Xyz<T> p{2 * number() - 1, 2 * number() - 1, 2 * number() - 1};
      const T r2 = dot(p, p);
      if (r2 > 0 && (r2 <= 1 || fault == 2)) return normalized(p);
    }
  }
  T pdf(const Xyz<T>&) const { return 1 / (4 * pi_v<T>); }
};

/// Fibres in a medium: a lobe that is wider one way than the other, a scaled cosine.
template <class T>
struct WideLobe {
  int fault;
  T wide, narrow;
  Frame<T> frame;

  Xyz<T> sample(T u, T v) const {
    const T r = std::sqrt(u), phi = 2 * pi_v<T> * v;
    return frame.to_world(
        normalized(Xyz<T>{wide * r * std::cos(phi), narrow * r * std::sin(phi), std::sqrt(1 - u)}));
  }
  T pdf(const Xyz<T>& w) const {
    Xyz<T> l = frame.to_local(w);
    if (fault == 1) l = {(l.x - l.y) * T(0.70710678), (l.x + l.y) * T(0.70710678), l.z};
    if (fault == 2) l = {l.y, l.x, l.z};
    if (!(l.z > 0)) return 0;
    const Xyz<T> back{l.x / wide, l.y / narrow, l.z};
    const T r = length(back);
    const T scale = fault == 3 ? T(1) : wide * narrow;
    return l.z / r / pi_v<T> / (scale * r * r * r);
  }
};

template <template <class> class Technique, class T>
Pair of_directions(std::string name, Technique<T> technique) {
  return pair_of<Xyz<T>>(std::move(name), Domain::sphere(), std::move(technique));
}

}  // namespace

void add_sealed_phase(std::vector<Case>& cases) {
  cases.push_back(twin("fresh cloud/g 0.6/float/without 1/(4π)",
                       said("pdf lacks 1/(4π) in both of its parts"), {Kind::constant},
                       [] { return cloud(0.6F, 1); }));
  cases.push_back(twin("fresh cloud/g 0.8/double/forward lobe without its share",
                       said("pdf has the forward lobe without its probability"),
                       {Kind::lobe_probability}, [] { return cloud(0.8, 2); }));
  cases.push_back(twin("fresh cloud/g -0.4/double/weight without the albedo",
                       said("the weight is 1, the albedo of 0.9 is missing"),
                       {Kind::weight, Kind::value_constant}, [] { return cloud(-0.4, 5); }));
  cases.push_back(twin(
      "fresh aerosol/0.55/double/sign of g", said("pdf has −cos for cos"), {Kind::mirrored}, [] {
        return of_directions("aerosol", Aerosol<double>{on(1), 0.55, onward<double>()});
      }));
  cases.push_back(
      twin("fresh even directions/double/corners of the cube kept",
           said("points of the cube outside the ball are not rejected"), {Kind::not_rejected}, [] {
             return of_directions("even directions", EvenDirections<double>{on(2), Even::ball});
           }));
  cases.push_back(twin(
      "fresh wide lobe/0.8, 0.2/double/another frame in pdf",
      said("pdf takes a frame that is turned by 45° about the axis"), {Kind::tangent_frame}, [] {
        return of_directions("wide lobe", WideLobe<double>{on(1), 0.8, 0.2, onward<double>()});
      }));
}

}  // namespace plumbline::tests::corpus
