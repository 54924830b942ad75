#include <plumbline/verify/detail/random.h>

#include "bsdf_case.h"
#include "bsdf_families.h"
#include "bsdf_math.h"
#include "sealed_switch.h"

namespace plumbline::tests::corpus {

namespace {

using fresh::on;
using fresh::said;

/// Paper: Lambert's law on the side that is looked at.
template <class T>
struct Paper {
  T albedo = T(0.25);
  int fault = 0;

  std::optional<Sampled<T>> sample(const V3<T>& wo, T u, T v) const {
    if (wo.z == 0) return std::nullopt;
    V3<T> wi = cosine_hemisphere(u, v);
    if (wo.z < 0 && fault != 4) wi.z = -wi.z;
    const T q = pdf(wo, wi);
    if (fault == 3) return Sampled<T>{wi, eval(wo, wi) / q, q};
    if (fault == 5) return Sampled<T>{wi, eval(wo, wi) * std::abs(wi.z) / q, q};
    return Sampled<T>{wi, albedo, q};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z * wi.z > 0)) return 0;
    return std::abs(fault == 2 ? wo.z : wi.z) / pi_v<T>;
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z * wi.z > 0)) return 0;
    const T f = albedo / pi_v<T>;
    return fault == 1 ? albedo : fault == 5 ? f / pi_v<T> : f;
  }
};

BsdfOptions of_known_albedo(double albedo) {
  BsdfOptions options = seen_from({0, 50});
  options.albedo = [albedo](const verify::Vec3&) { return albedo; };
  return options;
}

/// The moon, darker at the limb, by directions that are uniform over the hemisphere.
///
/// @source Minnaert 1941, "The reciprocity principle in lunar photometry"
template <class T>
struct Minnaert {
  T albedo = T(0.5), darkening = T(1.6);
  int fault = 0;

  std::optional<Sampled<T>> sample(const V3<T>& wo, const P2<T>& u) const {
    if (!(wo.z > 0)) return std::nullopt;
    const V3<T> wi = spherical(u.x, 2 * pi_v<T> * u.y);
    if (!(wi.z > 0)) return std::nullopt;
    const T q = pdf(wo, wi);
    return Sampled<T>{wi, eval(wo, wi) * wi.z / q, q};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    return 1 / ((fault == 1 ? 1 : 2) * pi_v<T>);
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    const T cosines = fault == 2 ? wi.z : wo.z * wi.z;
    return albedo / pi_v<T> * (darkening + 1) / 2 * std::pow(cosines, darkening - 1);
  }
};

/// Clay, with the cosine between the planes of wo and wi.
///
/// @source Oren, Nayar 1994; the azimuths' term as in Fujii's "tiny improvement"
struct Clay {
  double albedo = 0.7, sigma = 0.4;
  int fault = 0;

  std::optional<Sampled<double>> sample(const V3<double>& wo, verify::Random& random) const {
    if (!(wo.z > 0)) return std::nullopt;
    const double u = random.uniform(), v = random.uniform();
    const V3<double> wi = cosine_hemisphere(u, v);
    if (!(wi.z > 0)) return std::nullopt;
    const double q = pdf(wo, wi);
    return Sampled<double>{wi, eval(wo, wi) * wi.z / q, q};
  }
  double pdf(const V3<double>& wo, const V3<double>& wi) const {
    return wo.z > 0 && wi.z > 0 ? wi.z / pi_v<double> : 0;
  }
  double eval(const V3<double>& wo, const V3<double>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    const double a = 1 / (pi_v<double> + (pi_v<double> / 2 - 2.0 / 3) * sigma), b = sigma * a;
    const double flat_o = std::hypot(wo.x, wo.y), flat_i = std::hypot(wi.x, wi.y);
    double turn = 0;
    if (fault == 1 || flat_o * flat_i > 1e-12) {
      turn = (wo.x * wi.x + wo.y * wi.y) / (flat_o * flat_i);
    }
    const double s = flat_o * flat_i * turn, t = s > 0 ? std::max(wo.z, wi.z) : 1.0;
    return albedo * (a + b * s / t);
  }
};

}  // namespace

void add_sealed_diffuse_cases(std::vector<Case>& cases) {
  using F3 = V3<float>;
  using D3 = V3<double>;
  twin<F3>(cases, "fresh paper/float", "f without 1/pi", said("f is the albedo, without 1/pi"),
           {CauseKind::value_constant}, Paper<float>{0.25F, on(1)}, seen_from({0, 60}));
  twin<D3>(cases, "fresh paper/double", "cosine of wo in pdf",
           said("B13: pdf has the cosine of the given direction, not of the sampled one"),
           {CauseKind::directions_swapped, CauseKind::cosine}, Paper<double>{0.6, on(2)},
           seen_from({20, 70}));
  twin<F3>(cases, "fresh paper/float", "weight without the cosine",
           said("the weight is f/pdf, the cosine is missing"),
           {CauseKind::weight, CauseKind::value_cosine}, Paper<float>{0.5F, on(3)},
           seen_from({0, 60}));
  twin<F3>(cases, "fresh paper/two-sided/float", "not turned to the back",
           said("sample goes to the front, from whichever side it is looked at"),
           {CauseKind::mirrored, CauseKind::support}, Paper<float>{0.5F, on(4)},
           from_both_faces({20, 60}));
  twin<D3>(cases, "fresh paper/albedo known/double", "1/pi twice",
           said("f is divided by pi twice, weight with it"), {CauseKind::value_constant},
           Paper<double>{0.8, on(5)}, of_known_albedo(0.8));
  twin<D3>(cases, "fresh minnaert/1.6/double", "darkened for wi alone",
           said("f has the power of the cosine of wi alone"), {CauseKind::asymmetric},
           Minnaert<double>{0.5, 1.6, on(2)}, seen_from({10, 60}));
  twin<D3>(cases, "fresh clay/generator/double", "0/0 along the normal",
           said("f divides by the sine of wo without asking whether it is 0"),
           {CauseKind::not_finite}, Clay{0.7, 0.4, on(1)}, seen_from({0, 60}));
}

}  // namespace plumbline::tests::corpus
