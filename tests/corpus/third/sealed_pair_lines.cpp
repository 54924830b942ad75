#include <array>

#include "pair_support.h"
#include "sealed_switch.h"

namespace plumbline::tests::corpus {

void add_sealed_lines(std::vector<Case>& cases);

namespace {

using fresh::on;
using fresh::said;

/// Emission of a lamp over [380, 780] nm in bands of 50 nm.
template <class T>
struct LampSpectrum {
  static constexpr T kFirst = 380, kLast = 780, kBand = 50;
  int fault;
  std::vector<T> band{T(0.3), T(1.2), T(0.7), T(3), T(1.5), T(2.5), T(0.6), T(0.2)};

  T total() const {
    T sum = 0;
    for (const T b : band) sum += b;
    return sum;
  }
  T sample(T u) const {
    T below = 0;
    int k = 0;
    const int n = static_cast<int>(band.size());
    while (k + 1 < n && u * total() >= below + at(band, k)) below += at(band, k++);
    const T left = fault == 3 ? u : std::min((u * total() - below) / at(band, k), T(1));
    if (fault == 2) k = (k + 1) % n;
    return kFirst + kBand * (static_cast<T>(k) + left);
  }
  T pdf(T lambda) const {
    if (!(lambda >= kFirst && lambda <= (fault == 4 ? T(700) : kLast))) return 0;
    const int n = static_cast<int>(band.size());
    const T p = at(band, cell_of((lambda - kFirst) / (kLast - kFirst), n)) / total();
    return fault == 1 ? p : p / kBand;
  }
};

template <class T>
Pair spectrum(int fault) {
  return pair_of<T>("lamp's spectrum", Domain::interval(380, 780), LampSpectrum<T>{on(fault)});
}

/// Distance to a collision in mist that three channels see differently, one of which is chosen.
struct Mist {
  int fault;
  std::array<double, 3> sigma{0.8, 2, 5}, albedo{0.9, 0.7, 0.5};
  double most = 2;

  double of_channel(std::size_t c, double t) const {
    return sigma[c] * std::exp(-sigma[c] * t) / -std::expm1(-sigma[c] * most);
  }
  std::optional<Record<double, double>> sample(double u, double v) const {
    const auto c = static_cast<std::size_t>(cell_of(u, 3));
    const double t = -std::log1p(v * std::expm1(-sigma[c] * most)) / sigma[c];
    const double stated = fault == 1 ? of_channel(c, t) : pdf(t);
    return Record<double, double>{t, stated, value(t) / stated};
  }
  double pdf(double t) const {
    if (!(t >= 0 && t <= most)) return 0;
    const double sum = of_channel(0, t) + of_channel(1, t) + of_channel(2, t);
    return fault == 2 ? sum : sum / 3;
  }
  double value(double t) const { return albedo[1] * sigma[1] * std::exp(-sigma[1] * t); }
};

Pair mist(int fault) {
  Pair pair = recorded_pair_of<double>("mist", Domain::interval(0, 2), Mist{on(fault)});
  pair.many_to_one = true;
  return pair;
}

/// Distance to a collision before `most`; extinction is absorption and scattering together.
template <class T>
struct Smoke {
  int fault;
  T scattering, absorption, most;

  T sample(T u) const {
    const T sigma = scattering + absorption;
    return std::min(-std::log1p(u * std::expm1(-sigma * most)) / sigma, most);
  }
  T pdf(T t) const {
    if (!(t >= 0 && t <= most)) return 0;
    const T sigma = scattering + absorption;
    const T rate = fault == 1 ? scattering : sigma;
    return rate * std::exp(-sigma * t) / -std::expm1(-sigma * most);
  }
};

/// Through fog to a wall, which is reached with what is left.
template <class T>
Pair fog_to_wall(int fault) {
  const T sigma = T(0.9), scattering = T(0.5), wall = T(1.8);
  Pair pair;
  pair.name = "fog to a wall";
  pair.domain = Domain::interval(0, static_cast<double>(wall));
  pair.numbers = 1;
  pair.epsilon = std::is_same_v<T, float> ? 0x1p-24 : 0x1p-53;
  const auto density = [=](T t) { return t < wall ? sigma * std::exp(-sigma * t) : T(0); };
  pair.sample = [=](const verify::Uniforms& u) -> std::optional<verify::SampleRecord> {
    const T t = -std::log1p(-static_cast<T>(u[0])) / sigma;
    verify::SampleRecord s;
    s.x = {static_cast<double>(std::min(t, wall)), 0, 0};
    if (t < wall) {
      s.pdf = static_cast<double>(density(t));
    } else {
      const T left = std::exp(-(fault == 1 ? scattering : sigma) * wall);
      if (fault == 2) s.pdf = static_cast<double>(left);
      if (fault != 2) s.mass = static_cast<double>(left);
    }
    return s;
  };
  pair.pdf = [=](const verify::Vec3& x) {
    return static_cast<double>(density(static_cast<T>(x[0])));
  };
  return pair;
}

/// A ramp from 0 at the near end.
template <class T>
struct Ramp {
  int fault;
  T low, high;

  T sample(T u) const {
    const T x = fault == 1 ? 1 - std::sqrt(1 - u) : std::sqrt(u);
    return low + x * (high - low);
  }
  T pdf(T t) const {
    const T x = (t - low) / (high - low);
    return x >= 0 && x <= 1 ? 2 * x / (high - low) : T(0);
  }
};

}  // namespace

void add_sealed_lines(std::vector<Case>& cases) {
  cases.push_back(twin("fresh lamp's spectrum/double/band without its width",
                       said("pdf is the band's probability, not over its 50 nm"), {Kind::constant},
                       [] { return spectrum<double>(1); }));
  cases.push_back(twin("fresh lamp's spectrum/float/nothing above 700 nm",
                       said("pdf is 0 above 700 nm, samples go up to 780"), {Kind::support},
                       [] { return spectrum<float>(4); }));
  cases.push_back(twin("fresh mist/double/record of the chosen channel",
                       said("B7: the record has the density of the channel that was chosen"),
                       {Kind::chosen_lobe_only, Kind::record_pdf}, [] { return mist(1); }));
  cases.push_back(twin("fresh fog to a wall/double/mass by scattering alone",
                       said("the wall's mass is exp(−σ_s d), not exp(−σ_t d)"),
                       {Kind::atom_as_density}, [] { return fog_to_wall<double>(on(1)); }));
  cases.push_back(
      twin("fresh ramp/double/from the other end",
           said("sample falls towards the far end, pdf rises"), {Kind::mirrored}, [] {
             return pair_of<double>("ramp", Domain::interval(1, 3), Ramp<double>{on(1), 1, 3});
           }));
}

}  // namespace plumbline::tests::corpus
