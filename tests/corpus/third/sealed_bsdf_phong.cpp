#include "bsdf_case.h"
#include "bsdf_families.h"
#include "bsdf_math.h"
#include "sealed_switch.h"

namespace plumbline::tests::corpus {

namespace {

using fresh::on;
using fresh::said;

/// A power of the cosine around the mirror direction.
template <class T>
struct Gloss {
  T exponent = 25;
  int fault = 0;

  std::optional<Sampled<T>> sample(const V3<T>& wo, const P2<T>& u) const {
    if (!(wo.z > 0)) return std::nullopt;
    const T power = fault == 4 ? exponent / 2 : exponent;
    const Frame<T> around(V3<T>{-wo.x, -wo.y, wo.z});
    V3<T> wi = around.to_world(spherical(std::pow(1 - u.x, 1 / (power + 1)), 2 * pi_v<T> * u.y));
    if (fault == 3 && wi.z < T(0.01)) wi = unit(V3<T>{wi.x, wi.y, T(0.01)});
    if (!(wi.z > 0)) return std::nullopt;
    const T q = pdf(wo, wi);
    if (!(q > 0)) return std::nullopt;
    return Sampled<T>{wi, eval(wo, wi) * wi.z / q, q};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    const V3<T> axis = fault == 2 ? wo : V3<T>{-wo.x, -wo.y, wo.z};
    const T cosine = dot(axis, wi);
    if (!(cosine > 0)) return 0;
    return (exponent + 1) / ((fault == 1 ? 1 : 2) * pi_v<T>)*std::pow(cosine, exponent);
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    const T cosine = wo.z * wi.z - wo.x * wi.x - wo.y * wi.y;
    if (!(cosine > 0)) return 0;
    return T(0.8) * (exponent + 2) / (2 * pi_v<T>)*std::pow(cosine, exponent);
  }
};

/// Brushed metal of two slopes.
///
/// @source Ward 1992, "Measuring and modeling anisotropic reflection"; Walter 2005, "Notes on the
/// Ward BRDF", Eq. 6, 7, 9
template <class T>
struct Ward {
  T ax = T(0.15), ay = T(0.4);
  int fault = 0;

  V3<T> half(T u, T v) const {
    const T phi = std::atan2(ay * std::sin(2 * pi_v<T> * v), ax * std::cos(2 * pi_v<T> * v));
    const T c = std::cos(phi), s = std::sin(phi);
    const T steep = sqr(c / ax) + sqr(s / ay);
    const T tan2 = -std::log(1 - u) / (fault == 3 ? std::sqrt(steep) : steep);
    const T z = 1 / std::sqrt(1 + tan2), r = std::sqrt(tan2) * z;
    return {r * c, r * s, z};
  }
  T slopes(const V3<T>& h) const {
    return std::exp(-(sqr(h.x / ax) + sqr(h.y / ay)) / (h.z * h.z)) / (4 * pi_v<T> * ax * ay);
  }
  std::optional<Sampled<T>> sample(const V3<T>& wo, T u, T v) const {
    if (!(wo.z > 0)) return std::nullopt;
    const V3<T> h = half(u, v);
    if (!(dot(wo, h) > 0)) return std::nullopt;
    const V3<T> wi = mirrored_at(wo, h);
    if (!(wi.z > 0)) return std::nullopt;
    const T q = pdf(wo, wi);
    if (!(q > 0)) return std::nullopt;
    return Sampled<T>{wi, eval(wo, wi) * wi.z / q, q};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    const V3<T> h = unit(wo + wi);
    if (fault == 1) return slopes(h) / (dot(wo, h) * h.z * h.z);
    if (fault == 2) return slopes(h) / (dot(wo, h) * h.z * h.z * h.z) * ax * ay;
    return slopes(h) / (dot(wo, h) * h.z * h.z * h.z);
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    return T(0.6) * slopes(unit(wo + wi)) / std::sqrt(wo.z * wi.z);
  }
};

BsdfOptions ward_options(std::vector<double> angles) {
  BsdfOptions options = seen_from(std::move(angles));
  options.conserves_energy = false;  // the model does not at grazing angles
  return options;
}

}  // namespace

void add_sealed_phong_cases(std::vector<Case>& cases) {
  using D3 = V3<double>;
  twin<D3>(cases, "fresh gloss/exponent 25/double", "pdf around wo",
           said("pdf's lobe lies around wo, not around its mirror direction"),
           {CauseKind::mirrored}, Gloss<double>{25, on(2)}, seen_from({25, 60}));
  twin<D3>(cases, "fresh gloss/exponent 8/double", "set upon the horizon",
           said("a sample below the horizon is lifted to a cosine of 0.01"),
           {CauseKind::not_rejected, CauseKind::on_a_line}, Gloss<double>{8, on(3)},
           seen_from({50, 75}));
  twin<D3>(cases, "fresh ward/0.15, 0.4/double", "cos h squared for its cube",
           said("pdf has the square of the cosine of h in its denominator, not the cube"),
           {CauseKind::cosine}, Ward<double>{0.15, 0.4, on(1)}, ward_options({0, 50}));
}

}  // namespace plumbline::tests::corpus
