#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include <plumbline/verify/bsdf.h>
#include <plumbline/verify/pair.h>

/// Correct BSDFs from the textbook, and a light, in double, written for the tests of the checks:
/// wrong ones are made of them. They know nothing of the renderer's.
namespace plumbline::verify {

inline double dot_of(const Vec3& a, const Vec3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline Vec3 unit(const Vec3& a) {
  const double l = std::sqrt(dot_of(a, a));
  return {a[0] / l, a[1] / l, a[2] / l};
}

inline Vec3 half_vector(const Vec3& a, const Vec3& b) {
  return unit({a[0] + b[0], a[1] + b[1], a[2] + b[2]});
}

inline Channels gray(double value) {
  Channels c;
  c.count = 1;
  c.value[0] = value;
  return c;
}

/// White diffuse reflection above the surface.
struct Diffuse {
  static double pdf(const Vec3& wo, const Vec3& wi) {
    return wo[2] > 0 && wi[2] > 0 ? wi[2] / std::numbers::pi : 0;
  }
  static double eval(const Vec3& wo, const Vec3& wi) {
    return wo[2] > 0 && wi[2] > 0 ? 1 / std::numbers::pi : 0;
  }
  static std::optional<SampleRecord> sample(const Vec3& wo, double u, double v) {
    if (!(wo[2] > 0)) return std::nullopt;
    const double r = std::sqrt(u), phi = 2 * std::numbers::pi * v;
    const Vec3 wi{r * std::cos(phi), r * std::sin(phi), std::sqrt(1 - u)};
    return SampleRecord{wi, gray(1), pdf(wo, wi)};
  }
};

/// Rough mirror: GGX of the given roughness, visible normals, reflectance 1.
struct RoughMirror {
  double alpha;

  /// @source Walter et al. 2007, Eqs. 33 and 34
  double distribution(const Vec3& h) const {
    const double c2 = h[2] * h[2], a2 = alpha * alpha;
    const double d = c2 * (a2 - 1) + 1;
    return a2 / (std::numbers::pi * d * d);
  }
  double masking(const Vec3& w) const {
    const double tan2 = (1 - w[2] * w[2]) / (w[2] * w[2]);
    return 2 / (1 + std::sqrt(1 + alpha * alpha * tan2));
  }
  double pdf(const Vec3& wo, const Vec3& wi) const {
    if (!(wo[2] > 0 && wi[2] > 0)) return 0;
    return masking(wo) * distribution(half_vector(wo, wi)) / (4 * wo[2]);
  }
  double eval(const Vec3& wo, const Vec3& wi) const {
    if (!(wo[2] > 0 && wi[2] > 0)) return 0;
    return masking(wo) * masking(wi) * distribution(half_vector(wo, wi)) / (4 * wo[2] * wi[2]);
  }
  /// @source Heitz 2018 (JCGT 7:4), Appendix A
  Vec3 visible_normal(const Vec3& wo, double u, double v) const {
    const Vec3 w = unit({alpha * wo[0], alpha * wo[1], wo[2]});
    const double across = std::hypot(w[0], w[1]);
    const Vec3 t1 = across > 0 ? Vec3{-w[1] / across, w[0] / across, 0} : Vec3{1, 0, 0};
    const Vec3 t2{w[1] * t1[2] - w[2] * t1[1], w[2] * t1[0] - w[0] * t1[2],
                  w[0] * t1[1] - w[1] * t1[0]};
    const double r = std::sqrt(u), phi = 2 * std::numbers::pi * v, s = 0.5 * (1 + w[2]);
    const double a = r * std::cos(phi);
    const double b = (1 - s) * std::sqrt(1 - a * a) + s * r * std::sin(phi);
    const double c = std::sqrt(std::max(0.0, 1 - a * a - b * b));
    const Vec3 h{a * t1[0] + b * t2[0] + c * w[0], a * t1[1] + b * t2[1] + c * w[1],
                 a * t1[2] + b * t2[2] + c * w[2]};
    return unit({alpha * h[0], alpha * h[1], std::max(0.0, h[2])});
  }
  std::optional<SampleRecord> sample(const Vec3& wo, double u, double v) const {
    if (!(wo[2] > 0)) return std::nullopt;
    const Vec3 h = visible_normal(wo, u, v);
    const double d = 2 * dot_of(wo, h);
    const Vec3 wi{d * h[0] - wo[0], d * h[1] - wo[1], d * h[2] - wo[2]};
    if (!(wi[2] > 0)) return std::nullopt;
    return SampleRecord{wi, gray(masking(wi)), pdf(wo, wi)};
  }
};

/// A BSDF with the three functions in the form that wrappers take apart.
template <class B>
ErasedBsdf erased(const B& b) {
  ErasedBsdf e;
  e.sample = [b](const Vec3& wo, const Uniforms& u) { return b.sample(wo, u[0], u[1]); };
  e.pdf = [b](const Vec3& wo, const Vec3& wi) { return b.pdf(wo, wi); };
  e.eval = [b](const Vec3& wo, const Vec3& wi) { return gray(b.eval(wo, wi)); };
  return e;
}

/// Two BSDFs, each with its share of the light; the first is chosen with probability `first(wo)`.
inline ErasedBsdf mixture(const ErasedBsdf& a, const ErasedBsdf& b, double share_of_a,
                          const std::function<double(const Vec3&)>& first) {
  ErasedBsdf e;
  e.pdf = [=](const Vec3& wo, const Vec3& wi) {
    return first(wo) * a.pdf(wo, wi) + (1 - first(wo)) * b.pdf(wo, wi);
  };
  e.eval = [=](const Vec3& wo, const Vec3& wi) {
    return gray(share_of_a * a.eval(wo, wi)[0] + (1 - share_of_a) * b.eval(wo, wi)[0]);
  };
  e.sample = [=](const Vec3& wo, const Uniforms& u) -> std::optional<SampleRecord> {
    const double p = first(wo);
    auto record = u[0] < p ? a.sample(wo, {u[0] / p, u[1], 0})
                           : b.sample(wo, {(u[0] - p) / (1 - p), u[1], 0});
    if (!record) return std::nullopt;
    record->pdf = p * a.pdf(wo, record->x) + (1 - p) * b.pdf(wo, record->x);
    const double f =
        share_of_a * a.eval(wo, record->x)[0] + (1 - share_of_a) * b.eval(wo, record->x)[0];
    record->weight = gray(f * std::abs(record->x[2]) / *record->pdf);
    return record;
  };
  e.lobes = {{first, a.sample, a.pdf},
             {[first](const Vec3& wo) { return 1 - first(wo); }, b.sample, b.pdf}};
  return e;
}

/// The BSDF turned over: what it reflects goes through instead.
inline ErasedBsdf transmitted(const ErasedBsdf& b) {
  const auto flip = [](const Vec3& w) { return Vec3{w[0], w[1], -w[2]}; };
  ErasedBsdf e;
  e.pdf = [=](const Vec3& wo, const Vec3& wi) { return b.pdf(wo, flip(wi)); };
  e.eval = [=](const Vec3& wo, const Vec3& wi) { return b.eval(wo, flip(wi)); };
  e.sample = [=](const Vec3& wo, const Uniforms& u) {
    auto record = b.sample(wo, u);
    if (record) record->x = flip(record->x);
    return record;
  };
  return e;
}

inline constexpr double kLightArea = 40;

/// A rectangle of 8 m by 5 m, by area.
inline SamplingPair rectangle() {
  return sampling_pair<Vec3>(
      "rectangle",
      Domain::surface(
          [](const Point2& p) {
            return Vec3{8 * p[0], 3, 5 * p[1]};
          },
          [](const Vec3& x) {
            return Point2{x[0] / 8, x[2] / 5};
          },
          [](const Point2&) { return kLightArea; }),
      [](double u, double v) {
        return Vec3{8 * u, 3, 5 * v};
      },
      [](const Vec3&) { return 1 / kLightArea; });
}

}  // namespace plumbline::verify
