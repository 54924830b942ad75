#include "bsdf_case.h"
#include "bsdf_families.h"
#include "sealed_facets.h"
#include "sealed_switch.h"

namespace plumbline::tests::corpus {
namespace fifth {
namespace {

/// Oren and Nayar's rough matte surface.
///
/// @source Oren, Nayar 1994, Eq. 30; sin alpha tan beta written with the larger cosine
template <class T>
struct Chalk {
  T albedo, sigma;
  int fault = 0;

  T roughened(const V3<T>& wo, const V3<T>& wi) const {
    const T s2 = sigma * sigma;
    const T a = 1 - s2 / (2 * (s2 + T(0.33))), b = T(0.45) * s2 / (s2 + T(0.09));
    const T together = std::max(T(0), wo.x * wi.x + wo.y * wi.y);
    return a + b * together / std::max(wo.z, wi.z);
  }
  std::optional<Sampled<T>> sample(const V3<T>& wo, const P2<T>& u) const {
    if (!(wo.z > 0)) return std::nullopt;
    const V3<T> wi = lambert_direction(u.x, u.y);
    if (!(wi.z > 0)) return std::nullopt;
    T weight = albedo * roughened(wo, wi);
    if (fault == 2) weight *= wi.z;
    return Sampled<T>{wi, weight, pdf(wo, wi)};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    if (!both_above(wo, wi)) return 0;
    return fault == 1 ? 1 / pi_v<T> : wi.z / pi_v<T>;
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    return both_above(wo, wi) ? albedo / pi_v<T> * roughened(wo, wi) : T(0);
  }
};

/// Matte, with directions spread evenly.
template <class T>
struct Plaster {
  T albedo = T(0.8);
  int fault = 0;

  std::optional<Sampled<T>> sample(const V3<T>& wo, T u, T v) const {
    if (!(wo.z > 0)) return std::nullopt;
    const V3<T> wi = spherical(1 - u, 2 * pi_v<T> * v);
    return Sampled<T>{wi, 2 * albedo * wi.z, pdf(wo, wi)};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    if (!both_above(wo, wi)) return 0;
    return 1 / ((fault == 1 ? 4 : 2) * pi_v<T>);
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    return both_above(wo, wi) ? albedo / pi_v<T> : T(0);
  }
};

/// Dust of the moon, after Lommel and Seeliger.
template <class T>
struct Regolith {
  T single = T(0.7);
  int fault = 0;

  std::optional<Sampled<T>> sample(const V3<T>& wo, const P2<T>& u) const {
    if (!(wo.z > 0)) return std::nullopt;
    const V3<T> wi = lambert_direction(u.x, u.y);
    if (!(wi.z > 0)) return std::nullopt;
    return Sampled<T>{wi, single / (4 * (wo.z + wi.z)), pdf(wo, wi)};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    return both_above(wo, wi) ? wi.z / pi_v<T> : T(0);
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    if (!both_above(wo, wi)) return 0;
    const T f = single / (4 * pi_v<T> * (wo.z + wi.z));
    return fault == 1 ? f * wi.z : f;
  }
};

/// Minnaert's law for dark cloth.
template <class T>
struct Felt {
  T albedo = T(0.7), k = T(1.5);
  int fault = 0;

  std::optional<Sampled<T>> sample(const V3<T>& wo, const P2<T>& u) const {
    if (!(wo.z > 0)) return std::nullopt;
    const V3<T> wi = lambert_direction(u.x, u.y);
    if (!(wi.z > 0)) return std::nullopt;
    return Sampled<T>{wi, eval(wo, wi) * pi_v<T>, pdf(wo, wi)};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    return both_above(wo, wi) ? wi.z / pi_v<T> : T(0);
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    if (!both_above(wo, wi)) return 0;
    const T darkened = fault == 1 ? wi.z : wo.z * wi.z;
    return albedo * (k + 1) / (2 * pi_v<T>)*std::pow(darkened, k - 1);
  }
};

/// A leaf that light comes back from and goes through.
template <class T>
struct Leaf {
  T back = T(0.2), through = T(0.5);
  int fault = 0;

  T share(bool returns) const { return (returns ? back : through) / (back + through); }
  std::optional<Sampled<T>> sample(const V3<T>& wo, const P3<T>& u) const {
    if (wo.z == 0) return std::nullopt;
    V3<T> wi = lambert_direction(u.y, u.z);
    const bool returns = u.x < share(true);
    if (returns != (wo.z > 0)) wi = upside_down(wi);
    if (wi.z == 0) return std::nullopt;
    return Sampled<T>{wi, back + through, pdf(wo, wi)};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    if (wo.z == 0 || wi.z == 0) return 0;
    const bool returns = wo.z * wi.z > 0;
    if (fault == 1) return share(!returns) * std::abs(wi.z) / pi_v<T>;
    if (fault == 2) return share(returns) * std::max(T(0), wi.z) / pi_v<T>;
    return share(returns) * std::abs(wi.z) / pi_v<T>;
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    if (wo.z == 0 || wi.z == 0) return 0;
    return (wo.z * wi.z > 0 ? back : through) / pi_v<T>;
  }
};

/// Matte, as the well-known introduction has it: the normal plus a random unit vector.
template <class T>
struct Weekend {
  T albedo = T(0.5);
  int fault = 0;

  std::optional<Sampled<T>> sample(const V3<T>& wo, verify::Random& random) const {
    if (!(wo.z > 0)) return std::nullopt;
    V3<T> p;
    do {
      p = {2 * verify::uniform<T>(random) - 1, 2 * verify::uniform<T>(random) - 1,
           2 * verify::uniform<T>(random) - 1};
    } while (dot(p, p) > 1 || dot(p, p) < T(1e-6));
    if (fault != 1) p = unit(p);
    const V3<T> wi = unit(V3<T>{p.x, p.y, p.z + 1});
    if (!(wi.z > 0)) return std::nullopt;
    return Sampled<T>{wi, albedo, pdf(wo, wi)};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    return both_above(wo, wi) ? wi.z / pi_v<T> : T(0);
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    return both_above(wo, wi) ? albedo / pi_v<T> : T(0);
  }
};

/// The diffuse lobe of a studio's BRDF, which brightens towards grazing angles where it is rough.
///
/// @source Burley 2012, §5.3
template <class T>
struct Burley {
  T albedo = T(0.6), roughness;
  int fault = 0;

  T retro(const V3<T>& wo, const V3<T>& wi, T cosine) const {
    const T more = T(0.5) + 2 * roughness * cosine * cosine - 1;
    return (1 + more * schlick(T(0), wo.z)) * (1 + more * schlick(T(0), wi.z));
  }
  std::optional<Sampled<T>> sample(const V3<T>& wo, const P2<T>& u) const {
    if (!(wo.z > 0)) return std::nullopt;
    const V3<T> wi = lambert_direction(u.x, u.y);
    if (!(wi.z > 0)) return std::nullopt;
    const T cosine = fault == 1 ? dot(wo, wi) : dot(wi, halfway(wo, wi));
    return Sampled<T>{wi, albedo * retro(wo, wi, cosine), pdf(wo, wi)};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    return both_above(wo, wi) ? wi.z / pi_v<T> : T(0);
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    if (!both_above(wo, wi)) return 0;
    return albedo / pi_v<T> * retro(wo, wi, dot(wi, halfway(wo, wi)));
  }
};

/// Matte by a disk that is lifted onto the hemisphere.
template <class T>
struct Lifted {
  T albedo = T(0.9);
  int fault = 0;

  std::optional<Sampled<T>> sample(const V3<T>& wo, T u, T v) const {
    if (!(wo.z > 0)) return std::nullopt;
    const T r = fault == 1 ? u : std::sqrt(u), turn = 2 * pi_v<T> * v;
    const V3<T> wi{r * std::cos(turn), r * std::sin(turn), safe_sqrt((1 - r) * (1 + r))};
    if (!(wi.z > 0)) return std::nullopt;
    return Sampled<T>{wi, albedo, pdf(wo, wi)};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    return both_above(wo, wi) ? wi.z / pi_v<T> : T(0);
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    return both_above(wo, wi) ? albedo / pi_v<T> : T(0);
  }
};

/// Velvet: a distribution of fibres that stand up, evenly sampled.
///
/// @source Estevez, Kulla 2017, "Production Friendly Microfacet Sheen BRDF"; Neubelt 2013
template <class T>
struct Velvet {
  T tint = T(0.4), alpha = T(0.5);
  int fault = 0;

  T lit(const V3<T>& wo, const V3<T>& wi, T width) const {
    const V3<T> h = halfway(wo, wi);
    const T power = 1 / width, sine = safe_sqrt(1 - h.z * h.z);
    const T d = (2 + power) * std::pow(sine, power) / (2 * pi_v<T>);
    return tint * d / (4 * (wo.z + wi.z - wo.z * wi.z));
  }
  std::optional<Sampled<T>> sample(const V3<T>& wo, const P2<T>& u) const {
    if (!(wo.z > 0)) return std::nullopt;
    const V3<T> wi = spherical(1 - u.x, 2 * pi_v<T> * u.y);
    const T f = lit(wo, wi, fault == 1 ? alpha * alpha : alpha);
    return Sampled<T>{wi, 2 * pi_v<T> * f * wi.z, pdf(wo, wi)};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    return both_above(wo, wi) ? 1 / (2 * pi_v<T>) : T(0);
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    return both_above(wo, wi) ? lit(wo, wi, alpha) : T(0);
  }
};

}  // namespace
}  // namespace fifth

void add_sealed_diffuse_cases(std::vector<Case>& cases) {
  using namespace fifth;
  using F3 = V3<float>;
  using D3 = V3<double>;
  twin<D3>(cases, "fifth chalk/sigma 0.4/double", "cosine left out of pdf",
           because("pdf is 1/pi where cosines are sampled"), {CauseKind::cosine},
           Chalk<double>{0.6, 0.4, put(1)}, seen_from({10, 60}));
  twin<F3>(cases, "fifth chalk/sigma 0.7/float", "cosine in the weight",
           because("the weight is multiplied by cos wi that pdf has cancelled already"),
           {CauseKind::weight, CauseKind::value_cosine}, Chalk<float>{0.6F, 0.7F, put(2)},
           seen_from({20, 70}));
  twin<F3>(cases, "fifth plaster/float", "whole sphere in pdf",
           because("pdf is 1/(4 pi) for a hemisphere"), {CauseKind::constant},
           Plaster<float>{0.8F, put(1)}, seen_from({0, 50}));
  twin<D3>(cases, "fifth regolith/double", "reflectance for f",
           because("f is the textbook's reflectance, which has cos wi in it"),
           {CauseKind::value_cosine}, Regolith<double>{0.7, put(1)}, seen_from({25, 65}));
  twin<D3>(cases, "fifth felt/k 1.5/double", "darkened for wi alone",
           because("f has the power of cos wi, not of the product of both cosines"),
           {CauseKind::asymmetric}, Felt<double>{0.7, 1.5, put(1)}, seen_from({30, 65}));
  twin<D3>(cases, "fifth leaf/double", "sides exchanged in pdf",
           because("pdf has the share of what goes through for what comes back"),
           {CauseKind::lobe_probability, CauseKind::constant_per_hemisphere},
           Leaf<double>{0.2, 0.5, put(1)}, from_both_faces({20, 60}));
  twin<F3>(cases, "fifth leaf/float", "no |cos| in pdf",
           because("pdf clamps cos wi at 0 where it is to take its absolute value"),
           {CauseKind::support, CauseKind::constant_per_hemisphere},
           Leaf<float>{0.3F, 0.3F, put(2)}, from_both_faces({0, 55}));
  twin<D3>(cases, "fifth weekend/generator/double", "in the sphere, not on it",
           because("the random vector is not normalised: the directions are like cos^3"),
           {CauseKind::cosine, CauseKind::radius}, Weekend<double>{0.5, put(1)},
           seen_from({0, 45}));
  twin<D3>(cases, "fifth Burley/roughness 0.9/double", "wo.wi in the weight",
           because("the weight has the cosine between wo and wi for that with the half vector"),
           {CauseKind::weight}, Burley<double>{0.6, 0.9, put(1)}, seen_from({40, 70}));
  twin<F3>(cases, "fifth lifted disk/float", "radius without root",
           because("the disk's radius is u, not its square root"),
           {CauseKind::radius, CauseKind::sine}, Lifted<float>{0.9F, put(1)}, seen_from({0, 60}));
  twin<D3>(cases, "fifth velvet/alpha 0.5/double", "alpha squared in the weight",
           because("the weight squares the roughness, f does not"),
           {CauseKind::roughness, CauseKind::weight}, Velvet<double>{0.4, 0.5, put(1)},
           seen_from({20, 60}));
}

}  // namespace plumbline::tests::corpus
