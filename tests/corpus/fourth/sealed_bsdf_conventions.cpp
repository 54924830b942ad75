#include <array>

#include "bsdf_case.h"
#include "bsdf_families.h"
#include "sealed_microfacet.h"
#include "sealed_switch.h"

namespace plumbline::tests::corpus {

namespace {

using fourth::on;
using fourth::over;
using fourth::said;
using fourth::TrowbridgeReitz;

using Conventions = verify::BsdfConventions;

/// Silk in world space around the shading normal of a mesh, which is not that of its triangles.
struct ShadedSilk {
  using Vec = std::array<double, 3>;
  int fault = 0;
  TrowbridgeReitz<double> facets{0.4, 0.4};
  V3<double> shading{0.6, 0, 0.8}, geometric{0.48, 0.36, 0.8};

  struct Record {
    Vec wi;
    double weight, pdf;
  };
  V3<double> local(const Vec& w) const {
    return Frame<double>(shading).to_local({w[0], w[1], w[2]});
  }
  std::optional<Record> sample(const Vec& wo, const P2<double>& u) const {
    const V3<double> o = local(wo);
    if (!(o.z > 0)) return std::nullopt;
    const V3<double> i = mirrored_at(o, facets.visible(o, u.x, u.y));
    if (!(i.z > 0)) return std::nullopt;
    const V3<double> w = Frame<double>(shading).to_world(i);
    const Vec wi{w.x, w.y, w.z};
    const double q = pdf(wo, wi);
    const double cosine = std::abs(dot(w, fault == 1 ? geometric : shading));
    return Record{wi, eval(wo, wi) * cosine / q, q};
  }
  double pdf(const Vec& wo, const Vec& wi) const {
    const V3<double> o = local(wo), i = local(wi);
    if (!(o.z > 0) || !(i.z > 0)) return 0;
    const V3<double> m = unit(o + i);
    return facets.visible_density(o, m) / (4 * dot(o, m));
  }
  double eval(const Vec& wo, const Vec& wi) const {
    const V3<double> o = local(wo), i = local(wi);
    if (!(o.z > 0) || !(i.z > 0)) return 0;
    return 0.7 * facets.d(unit(o + i)) * facets.g2(o, i) / (4 * o.z * i.z);
  }
};

/// y is the normal outside, z inside.
struct YUpLinen {
  int fault = 0;

  static V3<double> swap(const V3<double>& w) { return {w.x, w.z, w.y}; }
  std::optional<Sampled<double>> sample(const V3<double>& wo, double u, double v) const {
    if (!(wo.y > 0)) return std::nullopt;
    const V3<double> inside = cosine_hemisphere(u, v), wi = fault == 1 ? inside : swap(inside);
    return Sampled<double>{wi, 0.55, inside.z / pi_v<double>};
  }
  double pdf(const V3<double>& wo, const V3<double>& wi) const {
    return wo.y > 0 && wi.y > 0 ? wi.y / pi_v<double> : 0;
  }
  double eval(const V3<double>& wo, const V3<double>& wi) const {
    return wo.y > 0 && wi.y > 0 ? 0.55 / pi_v<double> : 0;
  }
};

/// Densities per projected solid angle.
template <class T>
struct ProjectedFelt {
  int fault = 0;

  std::optional<Sampled<T>> sample(const V3<T>& wo, T u, T v) const {
    if (!(wo.z > 0)) return std::nullopt;
    const V3<T> wi = spherical(1 - u, 2 * pi_v<T> * v);
    if (!(wi.z > 0)) return std::nullopt;
    const T per_solid_angle = 1 / (2 * pi_v<T>);
    const T stated = fault == 1 ? per_solid_angle : per_solid_angle / wi.z;
    const T weight = eval(wo, wi) / per_solid_angle;
    return Sampled<T>{wi, fault == 2 ? weight : weight * wi.z, stated};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    return wo.z > 0 && wi.z > 0 ? 1 / (2 * pi_v<T> * wi.z) : T(0);
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    const T f = T(0.4) / pi_v<T> * (1 + (1 - wo.z) * (1 - wi.z));
    return fault == 2 ? f * wi.z : f;
  }
};

/// f holds the cosine; the sheet is alike on both sides.
template <class T>
struct TwoSidedFelt {
  int fault = 0;

  std::optional<Sampled<T>> sample(const V3<T>& wo, const P2<T>& u) const {
    if (wo.z == 0) return std::nullopt;
    const V3<T> up = cosine_hemisphere(u.x, u.y), wi = wo.z > 0 ? up : over(up);
    return Sampled<T>{wi, T(0.65), pdf(wo, wi)};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    return wo.z * wi.z > 0 ? std::abs(wi.z) / pi_v<T> : T(0);
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z * wi.z > 0)) return 0;
    return T(0.65) / pi_v<T> * (fault == 1 ? wi.z : std::abs(wi.z));
  }
};

}  // namespace

void add_sealed_conventions_cases(std::vector<Case>& cases) {
  using F3 = V3<float>;
  using D3 = V3<double>;
  BsdfOptions world = seen_from({20, 60});
  world.conventions.frame = Conventions::Frame::world;
  world.conventions.normal = {0.6, 0, 0.8};
  BsdfOptions y_up = seen_from({0, 60});
  y_up.conventions.frame = Conventions::Frame::local_y_up;
  BsdfOptions projected = seen_from({10, 60});
  projected.conventions.projected_pdf = true;
  BsdfOptions two_sided = from_both_faces({20, 60});
  two_sided.conventions.cosine_in_eval = true;

  twin<ShadedSilk::Vec>(cases, "fourth silk in world space/double", "cosine at the triangle",
                        said("the weight has the cosine with the triangle's normal"),
                        {CauseKind::weight, CauseKind::value_cosine}, ShadedSilk{on(1)}, world);
  twin<D3>(cases, "fourth linen, y up/double", "z up given away",
           said("sample returns wi with z up, as it is inside"),
           {CauseKind::tangent_frame, CauseKind::mirrored, CauseKind::support}, YUpLinen{on(1)},
           y_up);
  twin<F3>(cases, "fourth felt, projected/float", "record per solid angle",
           said("T4: the record is per solid angle, pdf() per projected solid angle"),
           {CauseKind::record_pdf, CauseKind::cosine}, ProjectedFelt<float>{on(1)}, projected);
  twin<F3>(cases, "fourth felt, projected/float", "f with the cosine",
           said("B28: f holds the cosine that is applied once more outside"),
           {CauseKind::value_cosine}, ProjectedFelt<float>{on(2)}, projected);
  twin<D3>(cases, "fourth felt, cosine in f/double", "cosine with its sign",
           said("f has the cosine with its sign, and is negative on the back"),
           {CauseKind::value_cosine, CauseKind::not_finite}, TwoSidedFelt<double>{on(1)},
           two_sided);
}

}  // namespace plumbline::tests::corpus
