#include "bsdf_case.h"
#include "bsdf_families.h"
#include "sealed_facets.h"
#include "sealed_switch.h"

namespace plumbline::tests::corpus {
namespace fifth {
namespace {

/// A given and a sampled direction, turned so that the given one is above, with the index of the
/// other side over that of its own.
template <class T>
struct Seen {
  V3<T> o, i;
  T eta;
};

/// Ground glass that is rough from both sides.
///
/// @source Walter et al. 2007, Eq. 16, 17, 21
template <class T>
struct Ground {
  T alpha, index;
  int fault = 0;

  Ggx<T> facets() const { return {alpha, alpha}; }
  Seen<T> turned(const V3<T>& wo, const V3<T>& wi) const {
    if (wo.z > 0) return {wo, wi, index};
    return {-wo, -wi, 1 / index};
  }
  /// The facet between, if there is one that both directions see.
  static std::optional<V3<T>> facet(const Seen<T>& s) {
    const bool reflects = s.i.z > 0;
    const V3<T> sum = s.o + (reflects ? T(1) : s.eta) * s.i;
    if (!(dot(sum, sum) > 0)) return std::nullopt;
    V3<T> h = unit(sum);
    if (h.z < 0) h = -h;
    if (!(dot(s.o, h) > 0) || reflects != (dot(s.i, h) > 0)) return std::nullopt;
    return h;
  }
  /// Probability of reflection, as pdf has it.
  T choice(const Seen<T>& s, T c) const {
    if (fault == 3) return 1 - fresnel_dielectric(c, s.eta);
    if (fault == 4) return fresnel_dielectric(s.o.z, s.eta);
    if (fault == 7) return fresnel_dielectric(c, index);
    return fresnel_dielectric(c, s.eta);
  }
  T per_refracted(const Seen<T>& s, const V3<T>& h) const {
    const T o = dot(s.o, h), i = dot(s.i, h), sum = o + s.eta * i;
    if (fault == 1) return std::abs(i) / (sum * sum);
    return s.eta * s.eta * (fault == 2 ? o : std::abs(i)) / (sum * sum);
  }
  T density(const Seen<T>& s, const V3<T>& h) const {
    const T c = dot(s.o, h), p = choice(s, c), q = facets().seen(s.o, h);
    return s.i.z > 0 ? p * q / (4 * c) : (1 - p) * q * per_refracted(s, h);
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    if (wo.z == 0 || wi.z == 0) return 0;
    const Seen<T> s = turned(wo, wi);
    const auto h = facet(s);
    return h ? density(s, *h) : T(0);
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    if (wo.z == 0 || wi.z == 0) return 0;
    const Seen<T> s = turned(wo, wi);
    const auto h = facet(s);
    if (!h) return 0;
    const T o = dot(s.o, *h), i = dot(s.i, *h), f = fresnel_dielectric(o, s.eta);
    const T lit = facets().ndf(*h) * facets().shadows(s.o, s.i) / std::abs(s.o.z * s.i.z);
    if (s.i.z > 0) return f * lit / 4;
    const T sum = o + s.eta * i, scale = 1 / (s.eta * s.eta);
    const T importance = (1 - f) * lit * s.eta * s.eta * std::abs(o * i) / (sum * sum);
    return fault == 5 ? importance / scale : fault == 6 ? importance : importance * scale;
  }
  std::optional<Sampled<T>> sample(const V3<T>& wo, const P3<T>& u) const {
    if (wo.z == 0) return std::nullopt;
    const Seen<T> from = turned(wo, wo);
    const V3<T> h = facets().seen_normal(from.o, u.y, u.z);
    const T c = dot(from.o, h), f = fresnel_dielectric(c, from.eta);
    if (!(c > 0)) return std::nullopt;
    const bool reflects = u.x < f;
    V3<T> wi = mirrored_at(from.o, h);
    if (!reflects) {
      const T cos_t = safe_sqrt(1 - (1 - c * c) / (from.eta * from.eta));
      wi = (-1 / from.eta) * from.o + (c / from.eta - cos_t) * h;
    }
    if (reflects ? !(wi.z > 0) : !(wi.z < 0)) return std::nullopt;
    const T q = density({from.o, wi, from.eta}, h);
    if (!(q > 0)) return std::nullopt;
    T weight = facets().shadows(from.o, wi) / facets().shadow(from.o);
    if (!reflects) weight /= from.eta * from.eta;
    const V3<T> out = wo.z > 0 ? wi : -wi;
    if (fault > 0 && fault != 5) weight = eval(wo, out) * std::abs(out.z) / q;
    return Sampled<T>{out, weight, q};
  }
};

template <class T>
Ground<T> ground(T alpha, T index, int fault) {
  return {alpha, index, put(fault)};
}

/// A polished pane: two atoms, the one reflected, the other refracted.
template <class T>
struct Polished {
  T index;
  int fault = 0;

  struct Record {
    V3<T> wi;
    T weight, pdf;
    bool is_delta;
  };
  std::optional<Record> sample(const V3<T>& wo, const P2<T>& u) const {
    if (wo.z == 0) return std::nullopt;
    const T eta = wo.z > 0 ? index : 1 / index, c = std::abs(wo.z);
    const T f = fresnel_dielectric(c, eta);
    const T stated = fault == 1 ? fresnel_dielectric(c, index) : f;
    if (u.x < f) return Record{{-wo.x, -wo.y, wo.z}, T(1), stated, true};
    const T cos_t = safe_sqrt(1 - (1 - c * c) / (eta * eta));
    const V3<T> wi{-wo.x / eta, -wo.y / eta, wo.z > 0 ? -cos_t : cos_t};
    if (fault == 2) return Record{wi, 1 / (eta * eta), T(1), false};
    return Record{wi, fault == 3 ? eta * eta : 1 / (eta * eta), 1 - stated, true};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    return fault == 2 && wo.z * wi.z < 0 ? T(1) : T(0);
  }
  T eval(const V3<T>&, const V3<T>&) const { return 0; }
};

BsdfOptions polished_options(double index) {
  BsdfOptions options = from_both_faces({20, 35}, index);
  options.albedo = [](const verify::Vec3&) { return 1.0; };
  return options;
}

}  // namespace
}  // namespace fifth

void add_sealed_glass_cases(std::vector<Case>& cases) {
  using namespace fifth;
  using F3 = V3<float>;
  using D3 = V3<double>;
  twin<D3>(cases, "fifth ground glass/alpha 0.3, 1.5/double", "index squared left out",
           because("the Jacobian of refraction in pdf lacks eta squared"),
           {CauseKind::refraction_jacobian, CauseKind::eta_squared}, ground(0.3, 1.5, 1),
           from_both_faces({10, 55}, 1.5));
  twin<D3>(cases, "fifth ground glass/alpha 0.4, 1.7/double", "wo.h above in the Jacobian",
           because("the Jacobian of refraction in pdf has wo.h where it is to have wi.h"),
           {CauseKind::refraction_jacobian}, ground(0.4, 1.7, 2), from_both_faces({30, 65}, 1.7));
  twin<D3>(cases, "fifth ground glass/alpha 0.25, 1.33/double", "F for 1 - F in pdf",
           because("pdf refracts with probability F and reflects with 1 - F"),
           {CauseKind::fresnel, CauseKind::lobe_probability}, ground(0.25, 1.33, 3),
           from_both_faces({20, 60}, 1.33));
  twin<D3>(cases, "fifth ground glass/alpha 0.5, 1.5/double", "F at the surface's normal in pdf",
           because("pdf has F at wo.n, sample chooses by F at wo.h"),
           {CauseKind::fresnel, CauseKind::lobe_probability}, ground(0.5, 1.5, 4),
           from_both_faces({55, 75}, 1.5));
  twin<F3>(cases, "fifth ground glass/alpha 0.35, 1.5/float", "eta squared upside down in f",
           because("f is multiplied by eta squared where radiance is divided by it"),
           {CauseKind::eta_squared}, ground(0.35F, 1.5F, 5), from_both_faces({15, 50}, 1.5));
  twin<D3>(cases, "fifth ground glass/alpha 0.45, 1.5/double", "f of importance",
           because("f and the weight lack 1/eta squared of radiance"), {CauseKind::eta_squared},
           ground(0.45, 1.5, 6), from_both_faces({25, 60}, 1.5));
  twin<D3>(cases, "fifth ground glass/alpha 0.2, 1.8/double", "F from outside always",
           because("pdf has F of light from outside on both faces"),
           {CauseKind::fresnel, CauseKind::lobe_probability}, ground(0.2, 1.8, 7),
           from_both_faces({20, 50}, 1.8));
  twin<D3>(cases, "fifth polished pane/1.5/double", "mass from the wrong side",
           because("the atoms' masses have F of light from outside on both faces"),
           {CauseKind::atom_as_density, CauseKind::fresnel}, Polished<double>{1.5, put(1)},
           polished_options(1.5));
  twin<F3>(cases, "fifth polished pane/1.3/float", "refraction as a density of 1",
           because("B19: what is refracted has the density 1 and is no atom"),
           {CauseKind::atom_as_density}, Polished<float>{1.3F, put(2)}, polished_options(1.3));
  twin<D3>(cases, "fifth polished pane/1.7/double", "eta squared upside down",
           because("the weight of refraction is eta squared where it is to be 1/eta squared"),
           {CauseKind::eta_squared, CauseKind::weight}, Polished<double>{1.7, put(3)},
           polished_options(1.7));
}

}  // namespace plumbline::tests::corpus
