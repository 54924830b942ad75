#pragma once

#include "pair_support.h"

/// Densities on an interval: distances, wavelengths, angles of hair, one-dimensional warps.
namespace plumbline::tests::corpus {

/// Distance to a collision, given that it happens before `most`.
template <class T>
struct TruncatedExponential {
  int fault;
  T sigma, most;

  T sample(T u) const {
    if (fault == 3) return std::min(-std::log1p(-u) / sigma, most);
    return -std::log1p(u * std::expm1(-sigma * most)) / sigma;
  }
  T pdf(T t) const {
    if (!(t >= 0 && t <= most)) return 0;
    const T density = sigma * std::exp(-sigma * t);
    if (fault == 1 || fault == 3) return density;
    return (fault == 2 ? density / sigma : density) / -std::expm1(-sigma * most);
  }
};

/// Distance to a collision, or the surface at `most`, which is reached with probability
/// exp(−σ·most).
template <class T>
Pair distance_or_surface(T sigma, T most, int fault = 0) {
  Pair pair;
  pair.name = "distance to a collision or the surface";
  pair.domain = Domain::interval(0, static_cast<double>(most));
  pair.numbers = 1;
  pair.epsilon = std::is_same_v<T, float> ? 0x1p-24 : 0x1p-53;
  const auto density = [=](T t) { return t < most ? sigma * std::exp(-sigma * t) : T(0); };
  pair.sample = [=](const verify::Uniforms& u) -> std::optional<verify::SampleRecord> {
    const T t = -std::log1p(-static_cast<T>(u[0])) / sigma;
    verify::SampleRecord s;
    if (t < most) {
      s.x = {static_cast<double>(t), 0, 0};
      s.pdf = static_cast<double>(density(t));
      return s;
    }
    const T reached = std::exp(-sigma * most);
    s.x = {static_cast<double>(most), 0, 0};
    if (fault == 1) {
      s.pdf = 1;
    } else if (fault == 2) {
      s.mass = static_cast<double>(1 - reached);
    } else if (fault == 3) {
      s.x[0] = static_cast<double>(most * T(0.999));
    } else {
      s.mass = static_cast<double>(reached);
    }
    return s;
  };
  pair.pdf = [=](const verify::Vec3& x) {
    return static_cast<double>(density(static_cast<T>(x[0])));
  };
  return pair;
}

/// Delta tracking through a medium of density σ(t) = 1 + 0.8 sin 3t under the majorant 2, up to
/// `most`; who gets through has no distance.
template <class T>
struct DeltaTracking {
  int fault;
  T most;

  static T sigma(T t) { return 1 + T(0.8) * std::sin(3 * t); }
  static T depth(T t) { return t + T(0.8) / 3 * (1 - std::cos(3 * t)); }
  std::optional<T> sample(Random& random) const {
    T t = 0;
    for (;;) {
      t -= std::log(1 - verify::uniform<T>(random)) / 2;
      if (t > most) {
        if (fault != 1) return std::nullopt;
        t = 0;
        continue;
      }
      const T accept = fault == 3 ? sigma(most - t) / 2 : sigma(t) / 2;
      if (verify::uniform<T>(random) < accept) return t;
    }
  }
  T pdf(T t) const {
    if (!(t >= 0 && t <= most)) return 0;
    const T density = sigma(t) * std::exp(-depth(t));
    return fault == 2 ? density / -std::expm1(-depth(most)) : density;
  }
};

/// Point on a ray segment in proportion to 1/distance² from a light.
///
/// @source Kulla, Fajardo 2012 (CGF 31:4), "Importance Sampling Techniques for Path Tracing in
/// Participating Media", §3.2
template <class T>
struct EquiAngular {
  int fault;
  T nearest, height, most;  ///< where the ray passes the light, at which distance; its length

  T angle(T t) const { return std::atan((t - nearest) / height); }
  T sample(T u) const {
    const T a = angle(0), b = angle(most);
    return std::clamp(nearest + height * std::tan(a + u * (b - a)), T(0), most);
  }
  T pdf(T t) const {
    if (!(t >= 0 && t <= most)) return 0;
    const T x = fault == 1 ? t : t - nearest;
    const T span = fault == 3 ? pi_v<T> : angle(most) - angle(0);
    return (fault == 2 ? T(1) : height) / (span * (height * height + x * x));
  }
};

/// sech² around 538 nm over [360, 830] nm, as spectral renderers choose wavelengths; constants from
/// the ends, so that no sample leaves the range.
///
/// @source Radziszewski, Boryczko, Alda 2009, "An Improved Technique for Full Spectral Rendering"
template <class T>
struct VisibleWavelengths {
  static constexpr T kLow = 360, kHigh = 830, kCentre = 538, kWidth = T(0.0072);
  int fault;

  T low() const { return std::tanh(kWidth * (kLow - kCentre)); }
  T high() const { return std::tanh(kWidth * (kHigh - kCentre)); }
  T sample(T u) const {
    const T x = kCentre + std::atanh(low() + u * (high() - low())) / kWidth;
    return std::clamp(x, kLow, kHigh);
  }
  T pdf(T lambda) const {
    if (!(lambda >= kLow && lambda <= kHigh)) return 0;
    const T c = std::cosh(kWidth * (lambda - (fault == 1 ? T(558) : kCentre)));
    const T mass = fault == 2 ? T(2) : high() - low();
    return (fault == 3 ? T(1) : kWidth) / (mass * c * c);
  }
};

/// Azimuth of a hair lobe: a logistic density cut to [−π, π].
///
/// @source Chiang, Bitterli, Tappan, Burley 2016 (CGF 35:2), "A Practical and Controllable Hair and
/// Fur Model for Production Path Tracing", Eq. 13
template <class T>
struct TrimmedLogistic {
  int fault;
  T s, centre;

  static T cdf(T x, T scale) { return 1 / (1 + std::exp(-x / scale)); }
  T wrapped(T x) const {
    while (x > pi_v<T>) x -= 2 * pi_v<T>;
    while (x < -pi_v<T>) x += 2 * pi_v<T>;
    return x;
  }
  T sample(T u) const {
    const T low = cdf(-pi_v<T>, s), k = cdf(pi_v<T>, s) - low;
    const T x = -s * std::log(1 / (u * k + low) - 1);
    return wrapped(std::clamp(x, -pi_v<T>, pi_v<T>) + centre);
  }
  T pdf(T phi) const {
    const T x = std::abs(wrapped(phi - (fault == 1 ? -centre : fault == 4 ? T(0) : centre)));
    const T e = std::exp(-x / s), k = fault == 2 ? T(1) : cdf(pi_v<T>, s) - cdf(-pi_v<T>, s);
    return e / ((fault == 3 ? T(1) : s) * (1 + e) * (1 + e) * k);
  }
};

/// @source Best, Fisher 1979 (Applied Statistics 28:2), "Efficient Simulation of the von Mises
/// Distribution"
template <class T>
struct VonMises {
  int fault;
  T kappa;

  T sample(Random& random) const {
    const T tau = 1 + std::sqrt(1 + 4 * kappa * kappa);
    const T rho = (tau - std::sqrt(2 * tau)) / (2 * kappa), r = (1 + rho * rho) / (2 * rho);
    for (;;) {
      const T z = std::cos(pi_v<T> * verify::uniform<T>(random));
      const T f = (1 + r * z) / (r + z), c = kappa * (r - f);
      const T v = 1 - verify::uniform<T>(random);
      if (fault != 2 && !(std::log(c / v) + 1 - c >= 0)) continue;
      return std::copysign(std::acos(std::clamp(f, T(-1), T(1))),
                           fault == 3 ? T(1) : verify::uniform<T>(random) - T(0.5));
    }
  }
  T pdf(T phi) const {
    double bessel = 0, term = 1;  // I0(κ) = Σ (κ/2)^2k / k!²
    const double half = static_cast<double>(kappa) / 2;
    for (int k = 1; k < 60; ++k) bessel += term, term *= half * half / k / k;
    const T density = std::exp(kappa * std::cos(phi)) / static_cast<T>(bessel);
    return fault == 1 ? density : density / (2 * pi_v<T>);
  }
};

/// A tent of half width r around 0.
template <class T>
struct Tent {
  int fault;
  T r;

  T sample(T u) const {
    const bool left = u < T(0.5);
    const T x = left ? 2 * u : 2 * (u - T(0.5));
    if (fault == 3 && !left) return r * std::sqrt(x);
    return left ? r * (std::sqrt(x) - 1) : r * (1 - std::sqrt(1 - x));
  }
  T pdf(T x) const {
    if (!(std::abs(x) <= r)) return 0;
    const T height = 1 / r - std::abs(x) / (r * r);
    return fault == 1 ? height * r : fault == 2 ? 1 / (2 * r) : height;
  }
};

/// x²(3 − 2x) on [a, b], inverted by Newton's method within a bracket.
template <class T>
struct SmoothStep {
  int fault;
  T a, b;

  T sample(T u) const {
    // ∫ = x³ − x⁴/2, doubled to 1.
    T low = 0, high = 1, x = T(0.5);
    for (int k = 0; k < 60; ++k) {
      const T error = x * x * x * (2 - x) - u, slope = 2 * x * x * (3 - 2 * x);
      (error > 0 ? high : low) = x;
      const T next = x - error / slope;
      const T step = next > low && next < high ? next : (low + high) / 2;
      if (std::abs(step - x) <= std::numeric_limits<T>::epsilon() * x) break;
      x = step;
    }
    return a + x * (b - a);
  }
  T pdf(T t) const {
    const T x = (t - a) / (b - a);
    if (!(x >= 0 && x <= 1)) return 0;
    const T y = fault == 2 ? 1 - x : x;
    return (fault == 1 ? 1 : 2) * y * y * (3 - 2 * y) / (b - a);
  }
};

/// A tabulated density over [0, 1], constant in cells or linear between nodes.
template <class T>
struct Tabulated {
  int fault;
  bool linear;
  std::vector<T> f, cdf;

  Tabulated(int which, bool is_linear, std::vector<T> values)
      : fault(which), linear(is_linear), f(std::move(values)) {
    cdf.push_back(0);
    for (int i = 0; i < cells(); ++i) {
      const T mass = linear ? (at(f, i) + at(f, i + 1)) / 2 : at(f, i);
      cdf.push_back(cdf.back() + mass);
    }
  }
  int cells() const { return static_cast<int>(f.size()) - (linear ? 1 : 0); }
  T sample(T u) const {
    const T target = u * cdf.back();
    const auto above = std::upper_bound(cdf.begin() + 1, cdf.end() - 1, target);
    const int i = static_cast<int>(above - cdf.begin()) - 1;
    const T left = (target - at(cdf, i)) / (at(cdf, i + 1) - at(cdf, i));
    T x = left;
    if (linear) {
      const T p = at(f, i), q = at(f, i + 1);
      x = left * (p + q) / (p + std::sqrt(std::max(T(0), p * p + left * (q * q - p * p))));
    }
    if (fault == 5) x = u;
    return std::min((static_cast<T>(i) + x) / static_cast<T>(cells()), T(1));
  }
  T pdf(T x) const {
    if (!(x >= 0 && x <= 1)) return 0;
    if (fault == 3) x = 1 - x;
    if (fault == 1) x = std::min(x + T(0.5) / static_cast<T>(cells()), T(1));
    int i = cell_of(x, cells());
    const T t = x * static_cast<T>(cells()) - static_cast<T>(i);
    if (fault == 2) i = std::min(i + 1, cells() - 1);
    const T value = linear ? (1 - t) * at(f, i) + t * at(f, i + 1) : at(f, i);
    return value / cdf.back() * (fault == 4 ? T(1) : static_cast<T>(cells()));
  }
};

template <class T>
std::vector<T> spectrum_table() {
  return {T(0.5), T(2), T(3), T(0.2), T(0.9), T(4), T(1.5), T(0.1), T(0.4), T(2.2), T(1)};
}

/// Two Gaussians on [0, 1], each retried until it falls inside: the density of a lobe is divided by
/// its share.
template <class T>
struct TwoGaussians {
  int fault;
  T weight = T(0.35), mean0 = T(0.25), mean1 = T(0.85), dev0 = T(0.06), dev1 = T(0.25);

  T sample(Random& random) const {
    const bool first = verify::uniform<T>(random) < weight;
    for (;;) {
      const T r = std::sqrt(-2 * std::log(1 - verify::uniform<T>(random)));
      const T z = r * std::cos(2 * pi_v<T> * verify::uniform<T>(random));
      const T x = first ? mean0 + dev0 * z : mean1 + dev1 * z;
      if (x >= 0 && x <= 1) return x;
      if (fault == 3) return std::clamp(x, T(0), T(1));
    }
  }
  T lobe(T x, T mean, T dev) const {
    const T z = (x - mean) / dev, root = dev * std::numbers::sqrt2_v<T>;
    const T inside = (std::erf((1 - mean) / root) + std::erf(mean / root)) / 2;
    return std::exp(-z * z / 2) / (dev * std::sqrt(2 * pi_v<T>) * (fault == 1 ? T(1) : inside));
  }
  T pdf(T x) const {
    if (!(x >= 0 && x <= 1)) return 0;
    const T p0 = lobe(x, mean0, dev0), p1 = lobe(x, mean1, dev1);
    if (fault == 2) return (p0 + p1) / 2;
    if (fault == 4) return x < T(0.5) ? p0 : p1;
    return weight * p0 + (1 - weight) * p1;
  }
};

template <template <class> class Technique, class T>
Pair line(std::string name, T low, T high, Technique<T> technique) {
  return pair_of<T>(std::move(name),
                    Domain::interval(static_cast<double>(low), static_cast<double>(high)),
                    std::move(technique));
}

}  // namespace plumbline::tests::corpus
