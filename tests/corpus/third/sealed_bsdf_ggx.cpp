#include "bsdf_case.h"
#include "bsdf_families.h"
#include "sealed_microfacet.h"
#include "sealed_switch.h"

namespace plumbline::tests::corpus {

namespace {

using fresh::Facets;
using fresh::on;
using fresh::said;

/// A metal by visible normals, brushed along a direction that is turned in the surface.
template <class T>
struct BrushedMetal {
  Facets<T> facets{T(0.3), T(0.3)};
  int fault = 0;
  T f0 = T(0.8), turn = 0;

  V3<T> turned(const V3<T>& w, T angle) const {
    const T c = std::cos(angle), s = std::sin(angle);
    return {c * w.x - s * w.y, s * w.x + c * w.y, w.z};
  }
  V3<T> into(const V3<T>& w) const { return turned(w, -turn); }

  std::optional<Sampled<T>> sample(const V3<T>& given, T u, T v) const {
    if (!(given.z > 0)) return std::nullopt;
    const V3<T> wo = into(given);
    Facets<T> shape = facets;
    if (fault == 4) shape.ax *= shape.ax, shape.ay *= shape.ay;
    const V3<T> m = shape.visible_normal(wo, u, v);
    const V3<T> local = mirrored_at(wo, m);
    if (!(local.z > 0)) return std::nullopt;
    const V3<T> wi = turned(local, fault == 8 ? -turn : turn);
    const T q = fault == 7 ? pdf(wi, given) : pdf(given, wi);
    const T f = schlick(f0, fault == 9 ? wo.z : dot(wo, m));
    if (fault == 3) return Sampled<T>{wi, eval(given, wi) * wi.z / q, q};
    return Sampled<T>{wi, f * facets.g2(wo, local) / facets.g1(wo), q};
  }
  T pdf(const V3<T>& given, const V3<T>& sampled) const {
    if (!(given.z > 0) || !(sampled.z > 0)) return 0;
    const V3<T> wo = into(given), wi = into(sampled), m = unit(wo + wi);
    Facets<T> shape = facets;
    if (fault == 5) shape.ax = shape.ay = std::max(facets.ax, T(0.1));
    if (fault == 6) shape.ay = shape.ax;
    const T d = shape.ndf(m);
    if (fault == 1) return facets.g2(wo, wi) * d / (4 * wo.z);
    if (fault == 2) {
      const T rough = std::sqrt(facets.ax);
      return Facets<T>{rough, rough}.g1(wo) * d / (4 * wo.z);
    }
    if (fault == 10) return shape.visible_pdf(wo, m) / (4 * m.z);
    return shape.g1(wo) * d / (4 * wo.z);
  }
  T eval(const V3<T>& given, const V3<T>& sampled) const {
    if (!(given.z > 0) || !(sampled.z > 0)) return 0;
    const V3<T> wo = into(given), wi = into(sampled), m = unit(wo + wi);
    const T g = fault == 3 ? sqr(facets.g1(wo)) : facets.g2(wo, wi);
    return schlick(f0, dot(wo, m)) * facets.ndf(m) * g / (4 * wo.z * wi.z);
  }
};

template <class T>
BrushedMetal<T> metal(T ax, T ay, int fault, T turn = 0) {
  return {{ax, ay}, on(fault), T(0.8), turn};
}

/// A metal whose normals are sampled whether they are seen or not. f holds the cosine.
template <class T>
struct PlainMetal {
  T ax = T(0.3), ay = T(0.3);
  int fault = 0;

  struct Record {
    V3<T> wi;
    T value, pdf;
  };
  T ndf(const V3<T>& m, T along_x, T along_y) const {
    const T d = Facets<T>{along_x, along_y}.ndf(m);
    return fault == 4 ? d * pi_v<T> : d;
  }
  std::optional<Record> sample(const V3<T>& wo, const P2<T>& u) const {
    if (!(wo.z > 0)) return std::nullopt;
    const V3<T> m = Facets<T>{ax, ay}.any_normal(u.x, u.y);
    if (!(dot(wo, m) > 0)) return std::nullopt;
    const V3<T> wi = mirrored_at(wo, m);
    if (!(wi.z > 0)) return std::nullopt;
    return Record{wi, eval(wo, wi), pdf(wo, wi)};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    const V3<T> m = unit(wo + wi);
    const T d = fault == 3 ? ndf(m, ay, ax) : ndf(m, ax, ay);
    const T cosine = fault == 1 ? m.z * m.z : m.z;
    return d * cosine / ((fault == 2 ? 2 : 4) * dot(wo, m));
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    const V3<T> m = unit(wo + wi);
    const T g = Facets<T>{ax, ay}.g1(wo) * Facets<T>{ax, ay}.g1(wi);
    return ndf(m, ax, ay) * g * schlick(T(0.6), dot(wo, m)) / (4 * wo.z);
  }
};

BsdfOptions plain_options(std::vector<double> angles) {
  BsdfOptions options = seen_from(std::move(angles));
  options.conventions.cosine_in_eval = true;
  options.conventions.weight = verify::BsdfConventions::Weight::f_cosine;
  return options;
}

template <class T>
PlainMetal<T> plain(T ax, T ay, int fault) {
  return {ax, ay, on(fault)};
}

}  // namespace

void add_sealed_ggx_cases(std::vector<Case>& cases) {
  using F3 = V3<float>;
  using D3 = V3<double>;
  twin<D3>(cases, "fresh metal/alpha 0.4/double", "G2 in pdf",
           said("pdf of visible normals has G2(wo, wi) where G1(wo) belongs"), {CauseKind::masking},
           metal(0.4, 0.4, 1), seen_from({30, 70}));
  twin<F3>(cases, "fresh metal/alpha 0.25/float", "G1 of the square root",
           said("B26: G1 of the pdf has the square root of alpha, D has alpha"),
           {CauseKind::masking, CauseKind::roughness}, metal(0.25F, 0.25F, 2), seen_from({45, 75}));
  twin<D3>(cases, "fresh metal/alpha 0.5/double", "G1 of wo squared",
           said("f has G1(wo) G1(wo) for the masking of both directions"),
           {CauseKind::masking, CauseKind::asymmetric}, metal(0.5, 0.5, 3), seen_from({20, 70}));
  twin<D3>(cases, "fresh metal/alpha 0.05/double", "alpha at least 0.1 in pdf",
           said("B29: pdf clamps alpha to 0.1, sample and f do not"), {CauseKind::roughness},
           metal(0.05, 0.05, 5), seen_from({10, 60}));
  twin<D3>(cases, "fresh metal/alpha 0.35/double", "record with wo and wi exchanged",
           said("the record holds pdf(wi, wo)"),
           {CauseKind::directions_swapped, CauseKind::record_pdf}, metal(0.35, 0.35, 7),
           seen_from({30, 70}));
  twin<F3>(cases, "fresh metal/alpha 0.5/float", "F of wo in the weight",
           said("the weight has the Fresnel term at the cosine of wo, f at that of wo and h"),
           {CauseKind::fresnel, CauseKind::weight},
           BrushedMetal<float>{{0.5F, 0.5F}, on(9), 0.1F, 0}, seen_from({40, 75}));
  twin<D3>(cases, "fresh metal/alpha 0.4/double", "cosine of h in the Jacobian",
           said("the pdf's Jacobian is 1/(4 n.h) where 1/(4 wo.h) belongs"),
           {CauseKind::half_vector_jacobian}, metal(0.4, 0.4, 10), seen_from({25, 65}));
  twin<D3>(cases, "fresh plain metal/alpha 0.5/double", "cosine of h twice",
           said("pdf has the cosine of h twice"), {CauseKind::cosine}, plain(0.5, 0.5, 1),
           plain_options({0, 50}));
  twin<D3>(cases, "fresh plain metal/alpha 0.15, 0.45/double", "alphas exchanged in pdf",
           said("pdf has alpha x and alpha y exchanged"),
           {CauseKind::mirrored, CauseKind::roughness}, plain(0.15, 0.45, 3),
           plain_options({20, 50}));
}

}  // namespace plumbline::tests::corpus
