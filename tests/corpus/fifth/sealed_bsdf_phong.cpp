#include "bsdf_case.h"
#include "bsdf_families.h"
#include "sealed_facets.h"
#include "sealed_switch.h"

namespace plumbline::tests::corpus {
namespace fifth {
namespace {

/// Powers of the cosine with the mirror direction.
///
/// @source Lafortune, Willems 1994, "Using the modified Phong reflectance model"
template <class T>
struct Enamel {
  T power, gloss = T(0.7);
  int fault = 0;

  static V3<T> mirror(const V3<T>& wo) { return {-wo.x, -wo.y, wo.z}; }
  std::optional<Sampled<T>> sample(const V3<T>& wo, const P2<T>& u) const {
    if (!(wo.z > 0)) return std::nullopt;
    const T c = std::pow(1 - u.x, 1 / (power + (fault == 3 ? 2 : 1)));
    V3<T> wi = Frame<T>(mirror(wo)).to_world(spherical(c, 2 * pi_v<T> * u.y));
    if (fault == 2 && wi.z < 0) wi = upside_down(wi);
    if (!(wi.z > 0)) return std::nullopt;
    return Sampled<T>{wi, gloss * (power + 2) / (power + 1) * wi.z, pdf(wo, wi)};
  }
  T lobe(const V3<T>& wo, const V3<T>& wi) const {
    return std::pow(std::max(T(0), dot(mirror(wo), wi)), power) / (2 * pi_v<T>);
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    if (!both_above(wo, wi)) return 0;
    return (power + (fault == 1 ? 2 : 1)) * lobe(wo, wi);
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    return both_above(wo, wi) ? gloss * (power + 2) * lobe(wo, wi) : T(0);
  }
};

/// Blinn's powers of the normal's cosine, normals by their projected area.
template <class T>
struct Vinyl {
  T power, gloss = T(0.6);
  int fault = 0;

  T normals(const V3<T>& h) const { return (power + 2) / (2 * pi_v<T>)*std::pow(h.z, power); }
  std::optional<Sampled<T>> sample(const V3<T>& wo, T u, T v) const {
    if (!(wo.z > 0)) return std::nullopt;
    const V3<T> h = spherical(std::pow(1 - u, 1 / (power + 2)), 2 * pi_v<T> * v);
    if (!(dot(wo, h) > 0)) return std::nullopt;
    const V3<T> wi = mirrored_at(wo, h);
    if (!(wi.z > 0)) return std::nullopt;
    const T q = pdf(wo, wi);
    return Sampled<T>{wi, eval(wo, wi) * wi.z / q, q};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    if (!both_above(wo, wi)) return 0;
    const V3<T> h = halfway(wo, wi);
    if (fault == 1) return normals(h) / (4 * dot(wo, h));
    if (fault == 2) return normals(h) * h.z / (4 * wo.z);
    if (fault == 3) return normals(h) * h.z;
    return normals(h) * h.z / (4 * dot(wo, h));
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    if (!both_above(wo, wi)) return 0;
    const V3<T> h = halfway(wo, wi);
    const T lit = schlick(gloss, dot(wo, h)) * normals(h);
    return lit / (4 * std::max(wo.z, wi.z) * std::max(T(0.1), dot(wo, h)));
  }
};

/// Satin weave with two powers.
///
/// @source Ashikhmin, Shirley 2000, "An Anisotropic Phong BRDF Model", Eq. 4, 6, 8, 9
template <class T>
struct Weave {
  T along, across, gloss = T(0.5);
  int fault = 0;

  T root() const { return std::sqrt((along + 1) * (across + 1)); }
  T normals(const V3<T>& h, T nu, T nv) const {
    const T flat = 1 - h.z * h.z;
    const T e = flat > 0 ? (nu * h.x * h.x + nv * h.y * h.y) / flat : T(0);
    return root() / (2 * pi_v<T>)*std::pow(h.z, e);
  }
  std::optional<Sampled<T>> sample(const V3<T>& wo, const P2<T>& u) const {
    if (!(wo.z > 0)) return std::nullopt;
    // A quarter of the turn at a time, the number stretched to what is left of it.
    const T four = 4 * u.x;
    const int quarter = std::min(3, static_cast<int>(four));
    const T within = below_one(four - static_cast<T>(quarter));
    const T first =
        std::atan(std::sqrt((along + 1) / (across + 1)) * std::tan(pi_v<T> / 2 * within));
    const T c = std::cos(first), s = std::sin(first);
    const T cosine = std::pow(1 - u.y, 1 / (along * c * c + across * s * s + 1));
    const T sine = safe_sqrt(1 - cosine * cosine);
    const T x = quarter == 0 || quarter == 3 ? c : -c, y = quarter < 2 ? s : -s;
    const V3<T> h{sine * x, sine * y, cosine};
    if (!(dot(wo, h) > 0)) return std::nullopt;
    const V3<T> wi = mirrored_at(wo, h);
    if (!(wi.z > 0)) return std::nullopt;
    const T q = pdf(wo, wi);
    return Sampled<T>{wi, eval(wo, wi) * wi.z / q, q};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    if (!both_above(wo, wi)) return 0;
    const V3<T> h = halfway(wo, wi);
    const T d = fault == 1 ? normals(h, across, along) : normals(h, along, across);
    return d / (4 * dot(wo, h));
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    if (!both_above(wo, wi)) return 0;
    const V3<T> h = halfway(wo, wi);
    const T c = dot(wo, h);
    return normals(h, along, across) / (4 * c * std::max(wo.z, wi.z)) * schlick(gloss, c);
  }
};

/// One generalised cosine lobe.
///
/// @source Lafortune et al. 1997, "Non-Linear Approximation of Reflectance Functions", Eq. 8
template <class T>
struct Shingle {
  T power = 12;
  V3<T> c{T(-0.8), T(-0.8), T(0.5)};
  int fault = 0;

  V3<T> scaled(const V3<T>& w) const { return {c.x * w.x, c.y * w.y, c.z * w.z}; }
  std::optional<Sampled<T>> sample(const V3<T>& wo, const P2<T>& u) const {
    if (!(wo.z > 0)) return std::nullopt;
    const T cosine = std::pow(1 - u.x, 1 / (power + 1));
    const V3<T> wi = Frame<T>(unit(scaled(wo))).to_world(spherical(cosine, 2 * pi_v<T> * u.y));
    if (!(wi.z > 0)) return std::nullopt;
    const T q = pdf(wo, wi);
    if (!(q > 0)) return std::nullopt;
    return Sampled<T>{wi, eval(wo, wi) * wi.z / q, q};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    if (!both_above(wo, wi)) return 0;
    const T cosine = fault == 1 ? dot(wo, unit(scaled(wi))) : dot(unit(scaled(wo)), wi);
    return (power + 1) / (2 * pi_v<T>)*std::pow(std::max(T(0), cosine), power);
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    if (!both_above(wo, wi)) return 0;
    const T cosine = std::max(T(0), dot(scaled(wo), wi));
    return (power + 2) / (2 * pi_v<T>)*std::pow(cosine, power);
  }
};

}  // namespace
}  // namespace fifth

void add_sealed_phong_cases(std::vector<Case>& cases) {
  using namespace fifth;
  using F3 = V3<float>;
  using D3 = V3<double>;
  twin<F3>(cases, "fifth enamel/power 20/float", "n + 2 in pdf",
           because("pdf is normalised like f, by n + 2"), {CauseKind::constant},
           Enamel<float>{20, 0.7F, put(1)}, seen_from({10, 55}));
  twin<D3>(cases, "fifth enamel/power 8/double", "turned up at the horizon",
           because("samples below the horizon are turned up, pdf knows nothing of it"),
           {CauseKind::not_rejected, CauseKind::mirrored}, Enamel<double>{8, 0.7, put(2)},
           seen_from({50, 75}));
  twin<D3>(cases, "fifth enamel/power 5/double", "n + 2 in sample",
           because("sample draws with the power n + 1, pdf has n"), {CauseKind::roughness},
           Enamel<double>{5, 0.7, put(3)}, seen_from({0, 45}));
  twin<D3>(cases, "fifth vinyl/power 6/double", "D for D cos",
           because("pdf lacks the normal's cosine that projects the facets"), {CauseKind::cosine},
           Vinyl<double>{6, 0.6, put(1)}, seen_from({15, 60}));
  twin<F3>(cases, "fifth vinyl/power 30/float", "wo.n in the Jacobian",
           because("pdf divides by 4 wo.n where it is to be 4 wo.h"),
           {CauseKind::half_vector_jacobian}, Vinyl<float>{30, 0.6F, put(2)}, seen_from({30, 65}));
  twin<D3>(cases, "fifth vinyl/power 40/double", "per half vector",
           because("B3: pdf is that of the half vector"), {CauseKind::half_vector_jacobian},
           Vinyl<double>{40, 0.6, put(3)}, seen_from({20, 60}));
  twin<D3>(cases, "fifth weave/powers 8 and 60/double", "powers exchanged in pdf",
           because("pdf has the power along for the one across"),
           {CauseKind::mirrored, CauseKind::tangent_frame, CauseKind::roughness},
           Weave<double>{8, 60, 0.5, put(1)}, seen_from({10, 50}));
  twin<D3>(cases, "fifth shingle/power 12/double", "lobe about wi",
           because("B13: pdf scales wi to the lobe's axis, sample scales wo"),
           {CauseKind::directions_swapped}, Shingle<double>{12, {-0.8, -0.8, 0.5}, put(1)},
           seen_from({20, 55}));
}

}  // namespace plumbline::tests::corpus
