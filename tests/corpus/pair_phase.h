#pragma once

#include <array>

#include "pair_lights.h"
#include "pair_support.h"

/// Phase functions and spherical lobes around an axis d, densities per solid angle.
namespace plumbline::tests::corpus {

/// cosθ of Henyey and Greenstein's function by inversion; isotropic below |g| = 1e-3.
template <class T>
T sample_henyey_greenstein(T g, T u) {
  if (std::abs(g) < T(1e-3)) return 1 - 2 * u;
  const T s = (1 - g * g) / (1 - g + 2 * g * u);
  return std::clamp((1 + g * g - s * s) / (2 * g), T(-1), T(1));
}

template <class T>
T henyey_greenstein(T g, T cosine) {
  const T d = std::max(1 + g * g - 2 * g * cosine, T(1e-7));
  return (1 - g * g) / (4 * pi_v<T> * d * std::sqrt(d));
}

/// @source Henyey, Greenstein 1941; sampling as in Pharr et al. 2023, §11.3.1
template <class T>
struct HenyeyGreenstein {
  int fault;
  T g;
  Frame<T> frame;

  std::optional<Record<Xyz<T>, T>> sample(T u, T v) const {
    const T c = sample_henyey_greenstein(g, u);
    const Xyz<T> local = around_z(1 - c, 2 * pi_v<T> * v);
    const Xyz<T> w = fault == 3 ? local : frame.to_world(local);
    const T density = pdf(w);
    if (fault == 4) return Record<Xyz<T>, T>{w, density * 4 * pi_v<T>, T(1)};
    return Record<Xyz<T>, T>{w, density, fault == 5 ? value(w) : value(w) / density};
  }
  T pdf(const Xyz<T>& w) const {
    const T c = dot(w, frame.z);
    if (fault == 1) return henyey_greenstein(g, -c);
    return henyey_greenstein(g, c) * (fault == 2 ? 2 : 1);
  }
  T value(const Xyz<T>& w) const { return henyey_greenstein(g, dot(w, frame.z)); }
};

/// Two lobes; the number that chose one is stretched and used again.
template <class T>
struct DoubleHenyeyGreenstein {
  int fault;
  T share, g0, g1;
  Frame<T> frame;

  Xyz<T> lobe(T g, T u, T v) const {
    return frame.to_world(around_z(1 - sample_henyey_greenstein(g, u), 2 * pi_v<T> * v));
  }
  std::optional<Record<Xyz<T>, T>> sample(T u, T v) const {
    const bool first = u < share;
    T left = first ? u / share : (u - share) / (1 - share);
    if (fault == 3) left = u;
    const T g = first ? g0 : g1;
    const Xyz<T> w = lobe(g, left, v);
    const T of_lobe = henyey_greenstein(g, dot(w, frame.z));
    const T stated = fault == 1 ? of_lobe : pdf(w);
    return Record<Xyz<T>, T>{w, stated, (fault == 4 ? of_lobe : value(w)) / stated};
  }
  T pdf(const Xyz<T>& w) const {
    const T c = dot(w, frame.z);
    const T p0 = henyey_greenstein(g0, c), p1 = henyey_greenstein(g1, c);
    if (fault == 2) return (p0 + p1) / 2;
    if (fault == 5) return share * p0 + p1;
    return share * p0 + (1 - share) * p1;
  }
  T value(const Xyz<T>& w) const {
    const T c = dot(w, frame.z);
    return share * henyey_greenstein(g0, c) + (1 - share) * henyey_greenstein(g1, c);
  }
};

/// Rayleigh's 3/(16π)(1 + cos²θ) by the real root of the cubic.
///
/// @source Frisvad 2011 (JOSA A 28:12), "Importance sampling the Rayleigh phase function", Eq. 7
template <class T>
struct Rayleigh {
  int fault;
  Frame<T> frame;

  Xyz<T> sample(T u, T v) const {
    const T q = 2 * (2 * u - 1);
    const T a = std::cbrt(std::abs(q) + std::sqrt(q * q + 1));  // of |q|, or it cancels for q < 0
    const T c = std::copysign(std::clamp(a - 1 / a, T(0), T(1)), q);
    return frame.to_world(around_z(1 - c, 2 * pi_v<T> * v));
  }
  T pdf(const Xyz<T>& w) const {
    const T c = dot(w, frame.z);
    return 3 * (1 + c * c) / ((fault == 1 ? 8 : 16) * pi_v<T>);
  }
};

/// @source Blasi, Le Saëc, Schlick 1993, "A Rendering Algorithm for Discrete Volume Density
/// Objects"
template <class T>
struct SchlickPhase {
  int fault;
  T k;
  Frame<T> frame;

  Xyz<T> sample(T u, T v) const {
    const T c = (2 * u + k - 1) / (2 * k * u - k + 1);
    return frame.to_world(around_z(1 - c, 2 * pi_v<T> * v));
  }
  T pdf(const Xyz<T>& w) const {
    const T d = 1 - (fault == 1 ? -k : k) * dot(w, frame.z);
    return (1 - k * k) / (4 * pi_v<T> * d * d);
  }
};

/// Von Mises–Fisher lobe with 1 − cosθ throughout, so that float holds at κ = 1e4.
///
/// @source Jakob 2012, "Numerically stable sampling of the von Mises-Fisher distribution on S²"
template <class T>
struct VonMisesFisher {
  int fault;
  T kappa;
  Frame<T> frame;

  Xyz<T> sample(T u, T v) const {
    T away = -std::log1p(u * std::expm1(-2 * kappa)) / kappa;
    const T phi = 2 * pi_v<T> * v;
    if (fault == 4) {
      const T c = 1 + std::log(1 - u * (1 - std::exp(-2 * kappa))) / kappa;
      const T s = std::sqrt(1 - c * c);
      return frame.to_world({s * std::cos(phi), s * std::sin(phi), c});
    }
    const Xyz<T> w = around_z(away, phi);
    return fault == 3 ? w : frame.to_world(w);
  }
  T pdf(const Xyz<T>& w) const {
    if (fault == 1) {
      return kappa / (4 * pi_v<T> * std::sinh(kappa)) * std::exp(kappa * dot(w, frame.z));
    }
    if (fault == 4) return kappa / (2 * pi_v<T>)*std::exp(kappa * (dot(w, frame.z) - 1));
    const T norm = kappa / ((fault == 2 ? 4 : 2) * pi_v<T> * -std::expm1(-2 * kappa));
    return norm * std::exp(-kappa * one_minus_dot(w, frame.z));
  }
};

/// Spherical Gaussians of a guiding cache: one of several lobes by its weight, with the number
/// stretched and used again.
template <class T>
struct SphericalGaussians {
  struct Lobe {
    T weight;
    VonMisesFisher<T> shape;
  };
  int fault;
  std::vector<Lobe> lobes;

  static SphericalGaussians made(int which) {
    const auto lobe = [](T weight, T kappa, const Xyz<T>& axis) {
      return Lobe{weight, VonMisesFisher<T>{0, kappa, Frame<T>(normalized(axis))}};
    };
    return {which,
            {lobe(T(0.4), 3, {0, T(0.2), 1}), lobe(T(0.3), 40, {1, 0, T(0.5)}),
             lobe(T(0.2), 400, {-1, T(0.3), T(0.2)}), lobe(T(0.1), 12, {0, -1, T(-0.4)})}};
  }
  Xyz<T> sample(T u, T v) const {
    T left = u;
    std::size_t k = 0;
    while (k + 1 < lobes.size() && left >= lobes[k].weight) left -= lobes[k++].weight;
    left = std::min(left / lobes[k].weight, 1 - std::numeric_limits<T>::epsilon() / 2);
    return lobes[k].shape.sample(left, v);
  }
  T pdf(const Xyz<T>& w) const {
    T sum = 0, largest = 0;
    for (std::size_t k = 0; k < lobes.size(); ++k) {
      const T p = lobes[k].shape.pdf(w);
      sum += (fault == 1 ? T(0.25) : lobes[fault == 2 ? (k + 1) % lobes.size() : k].weight) * p;
      largest = std::max(largest, p);
    }
    return fault == 3 ? largest : sum;
  }
};

/// exp(κ cosθ + β sin²θ cos 2φ): an elliptic lobe in the manner of Kent, by retries under a von
/// Mises–Fisher envelope of κ − 2β, for sin²θ ≤ 2(1 − cosθ).
template <class T>
struct Kent {
  int fault;
  T kappa, beta;
  Frame<T> frame;
  T norm = 0;

  Kent(int which, T k, T b, const Xyz<T>& axis) : fault(which), kappa(k), beta(b), frame(axis) {
    // ∫ over φ by 64 points of the trapezoid rule (exact for a period), over 1 − cosθ by Simpson.
    constexpr int kSteps = 4000, kTurns = 64;
    const double width = std::min(2.0, 40 / (static_cast<double>(k) - 2 * static_cast<double>(b)));
    double sum = 0;
    for (int i = 0; i <= kSteps; ++i) {
      const double away = width * i / kSteps, s2 = away * (2 - away);
      double ring = 0;
      for (int t = 0; t < kTurns; ++t) {
        ring += std::exp(static_cast<double>(b) * s2 *
                         std::cos(4 * std::numbers::pi * (t + 0.5) / kTurns));
      }
      const double simpson = i == 0 || i == kSteps ? 1 : i % 2 == 1 ? 4 : 2;
      sum += simpson * std::exp(-static_cast<double>(k) * away) * ring / kTurns;
    }
    norm = static_cast<T>(1 / (sum * width / kSteps / 3 * 2 * std::numbers::pi));
  }
  std::optional<Xyz<T>> sample(Random& random) const {
    const VonMisesFisher<T> envelope{0, kappa - 2 * beta, frame};
    for (;;) {
      const Xyz<T> w = envelope.sample(verify::uniform<T>(random), verify::uniform<T>(random));
      const Xyz<T> l = frame.to_local(w);
      const T log_ratio = beta * (l.x * l.x - l.y * l.y - 2 * one_minus_dot(w, frame.z));
      if (verify::uniform<T>(random) < std::exp(log_ratio)) return w;
      if (fault == 2) return std::nullopt;
      if (fault == 4) return w;
    }
  }
  T pdf(const Xyz<T>& w) const {
    const Xyz<T> l = frame.to_local(w);
    const T x = fault == 3 ? l.y : l.x, y = fault == 3 ? l.x : l.y;
    if (fault == 1) return VonMisesFisher<T>{0, kappa - 2 * beta, frame}.pdf(w);
    return norm * std::exp(beta * (x * x - y * y) - kappa * one_minus_dot(w, frame.z));
  }
};

/// A cosine lobe through a linear map, for area lights and glossy tables.
///
/// @source Heitz, Dupuy, Hill, Neubelt 2016 (TOG 35:4), "Real-Time Polygonal-Light Shading with
/// Linearly Transformed Cosines", Eq. 1
template <class T>
struct TransformedCosine {
  int fault;
  T m11, m13, m22, m31;  ///< rows (m11, 0, m13), (0, m22, 0), (m31, 0, 1)

  Xyz<T> sample(T u, T v) const {
    const T r = std::sqrt(u), phi = 2 * pi_v<T> * v;
    const Xyz<T> o{r * std::cos(phi), r * std::sin(phi), std::sqrt(1 - u)};
    return normalized(Xyz<T>{m11 * o.x + m13 * o.z, m22 * o.y, m31 * o.x + o.z});
  }
  T pdf(const Xyz<T>& w) const {
    const T minor = m11 - m13 * m31;
    const Xyz<T> o{(w.x - m13 * w.z) / minor, w.y / m22, (m11 * w.z - m31 * w.x) / minor};
    const T l = length(o);
    if (!(o.z > 0)) return 0;
    const T cosine = o.z / l;
    if (fault == 2) return 1 / (pi_v<T> * std::abs(minor * m22) * l * l * l);
    return cosine / pi_v<T> / ((fault == 1 ? T(1) : std::abs(minor * m22)) * l * l * l);
  }
};

template <class T>
Frame<T> medium_axis() {
  return Frame<T>(normalized(Xyz<T>{T(0.48), T(-0.6), T(0.64)}));
}

/// The mixture with its lobes stated, as the checks ask for.
template <class T>
Pair double_henyey_greenstein(bool with_lobes, int fault = 0) {
  const DoubleHenyeyGreenstein<T> phase{fault, T(0.7), T(0.85), T(-0.3), medium_axis<T>()};
  Pair pair = recorded_pair_of<Xyz<T>>("double Henyey–Greenstein", Domain::sphere(), phase);
  if (!with_lobes) return pair;
  const auto lobe = [phase](std::string name, T probability, T g) {
    verify::PairLobe l;
    l.name = std::move(name);
    l.probability = static_cast<double>(probability);
    l.sample = [phase, g](const verify::Uniforms& u) {
      return verify::detail::record_of_plain(
          phase.lobe(g, static_cast<T>(u[0]), static_cast<T>(u[1])));
    };
    l.pdf = [phase, g](const verify::Vec3& x) {
      return static_cast<double>(
          henyey_greenstein(g, dot(verify::from_point<Xyz<T>>(x), phase.frame.z)));
    };
    return l;
  };
  pair.lobes = {lobe("forward", phase.share, phase.g0),
                lobe("backward", 1 - phase.share, phase.g1)};
  return pair;
}

}  // namespace plumbline::tests::corpus
