#include <array>

#include "bsdf_case.h"
#include "bsdf_families.h"
#include "sealed_microfacet.h"
#include "sealed_switch.h"

namespace plumbline::tests::corpus {

namespace {

using fresh::Facets;
using fresh::on;
using fresh::said;

using Conventions = verify::BsdfConventions;

/// Foil in world space, around a normal of its own, brushed along a tangent of the mesh.
struct WorldFoil {
  using Vec = std::array<double, 3>;
  int fault = 0;
  Facets<double> facets{0.12, 0.45};
  V3<double> n{0.36, 0.48, 0.8};

  struct Record {
    Vec wi;
    double weight, pdf;
  };
  static V3<double> v(const Vec& a) { return {a[0], a[1], a[2]}; }
  V3<double> tangent(bool of_mesh) const {
    const V3<double> along = of_mesh ? V3<double>{1, 0.5, 0} : V3<double>{0, 0, 1};
    return unit(along - dot(along, n) * n);
  }
  V3<double> local(const Vec& world) const {
    const V3<double> s = tangent(true), t = cross(n, s), w = v(world);
    return {dot(w, s), dot(w, t), dot(w, n)};
  }
  std::optional<Record> sample(const Vec& wo, const P2<double>& u) const {
    const V3<double> o = local(wo);
    if (!(o.z > 0)) return std::nullopt;
    const V3<double> i = mirrored_at(o, facets.visible_normal(o, u.x, u.y));
    if (!(i.z > 0)) return std::nullopt;
    const V3<double> s = tangent(fault != 1), w = i.x * s + i.y * cross(n, s) + i.z * n;
    const Vec wi{w.x, w.y, w.z};
    const double q = pdf(wo, wi);
    return Record{wi, q > 0 ? eval(wo, wi) * dot(w, n) / q : 0, q};
  }
  double pdf(const Vec& wo, const Vec& wi) const {
    const V3<double> o = local(wo), i = local(wi);
    if (!(o.z > 0) || !(i.z > 0)) return 0;
    return facets.g1(o) * facets.ndf(unit(o + i)) / (4 * o.z);
  }
  double eval(const Vec& wo, const Vec& wi) const {
    const V3<double> o = local(wo), i = local(wi);
    if (!(o.z > 0) || !(i.z > 0)) return 0;
    return 0.9 * facets.ndf(unit(o + i)) * facets.g2(o, i) / (4 * o.z * i.z);
  }
};

/// wi comes before wo.
struct SampledFirst {
  int fault = 0;
  Facets<double> facets{0.3, 0.3};

  std::optional<Sampled<double>> sample(const V3<double>& wo, double u, double v) const {
    if (!(wo.z > 0)) return std::nullopt;
    const V3<double> wi = mirrored_at(wo, facets.visible_normal(wo, u, v));
    if (!(wi.z > 0)) return std::nullopt;
    const double q = fault == 1 ? pdf(wo, wi) : pdf(wi, wo);
    return Sampled<double>{wi, eval(wi, wo) * wi.z / q, q};
  }
  double pdf(const V3<double>& wi, const V3<double>& wo) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    const V3<double>& seen_from = fault == 1 ? wi : wo;
    return facets.g1(seen_from) * facets.ndf(unit(wo + wi)) / (4 * seen_from.z);
  }
  double eval(const V3<double>& wi, const V3<double>& wo) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    return facets.ndf(unit(wo + wi)) * facets.g2(wo, wi) / (4 * wo.z * wi.z);
  }
};

/// Coloured, on both faces alike.
template <class T>
struct ColouredCard {
  int fault = 0;
  Rgb<T> colour{T(0.8), T(0.5), T(0.2)};

  std::optional<SampledRgb<T>> sample(const V3<T>& wo, const P2<T>& u) const {
    if (wo.z == 0) return std::nullopt;
    const P2<T> d = concentric_disk(u.x, u.y);
    const T z = safe_sqrt(1 - d.x * d.x - d.y * d.y);
    const V3<T> wi{d.x, d.y, wo.z > 0 ? z : -z};
    if (fault == 1) return SampledRgb<T>{wi, {colour.b, colour.g, colour.r}, pdf(wo, wi)};
    return SampledRgb<T>{wi, colour, pdf(wo, wi)};
  }
  T pdf(V3<T> wo, V3<T> wi) const {
    if (wo.z < 0) {
      wo.z = -wo.z;
      if (fault != 2) wi.z = -wi.z;
    }
    return wi.z > 0 ? wi.z / pi_v<T> : T(0);
  }
  Rgb<T> eval(const V3<T>& wo, const V3<T>& wi) const {
    return (wo.z * wi.z > 0 ? 1 / pi_v<T> : T(0)) * colour;
  }
};

/// y is the normal; f holds the cosine.
struct YUpCloth {
  int fault = 0;

  struct Record {
    V3<double> wi;
    double value, pdf;
  };
  std::optional<Record> sample(const V3<double>& wo, double u, double v) const {
    if (!(wo.y > 0)) return std::nullopt;
    const V3<double> w = cosine_hemisphere(u, v), wi{w.x, w.z, w.y};
    return Record{wi, eval(wo, wi) * (fault == 1 ? wi.y : 1), pdf(wo, wi)};
  }
  double pdf(const V3<double>& wo, const V3<double>& wi) const {
    return wo.y > 0 && wi.y > 0 ? wi.y / pi_v<double> : 0;
  }
  double eval(const V3<double>& wo, const V3<double>& wi) const {
    if (!(wo.y > 0) || !(wi.y > 0)) return 0;
    return 0.5 / pi_v<double> * (1 - 0.5 * wo.y * wi.y) * wi.y;
  }
};

}  // namespace

void add_sealed_conventions_cases(std::vector<Case>& cases) {
  using D3 = V3<double>;
  BsdfOptions world = seen_from({15, 60});
  world.conventions.frame = Conventions::Frame::world;
  world.conventions.normal = {0.36, 0.48, 0.8};
  BsdfOptions first = seen_from({30, 70});
  first.conventions.sampled_direction_first = true;
  BsdfOptions y_up = seen_from({0, 60});
  y_up.conventions.frame = Conventions::Frame::local_y_up;
  y_up.conventions.cosine_in_eval = true;
  y_up.conventions.weight = Conventions::Weight::f_cosine;

  twin<WorldFoil::Vec>(cases, "fresh foil in world space/0.12, 0.45/double", "another tangent",
                       said("sample goes back to the world by another tangent than it came from"),
                       {CauseKind::tangent_frame}, WorldFoil{on(1)}, world);
  twin<D3>(cases, "fresh metal, wi first/alpha 0.3/double", "arguments as if wo came first",
           said("B13: pdf takes the sampled direction for the given one, sample calls it so"),
           {CauseKind::directions_swapped}, SampledFirst{on(1)}, first);
  twin<D3>(cases, "fresh cloth, y up/double", "record with the cosine twice",
           said("B28: the record multiplies a value that has the cosine by it"),
           {CauseKind::value_cosine, CauseKind::weight}, YUpCloth{on(1)}, y_up);
}

}  // namespace plumbline::tests::corpus
