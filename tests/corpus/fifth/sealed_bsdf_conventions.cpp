#include <array>

#include "bsdf_case.h"
#include "bsdf_families.h"
#include "sealed_facets.h"
#include "sealed_switch.h"

namespace plumbline::tests::corpus {
namespace fifth {
namespace {

using Conventions = verify::BsdfConventions;

/// What the renderers below write down in their own ways: half matte, half gloss.
template <class T>
struct Satin {
  T alpha = T(0.35), matte = T(0.4), gloss = T(0.4);

  Ggx<T> facets() const { return {alpha, alpha * T(0.6)}; }
  std::optional<V3<T>> direction(const V3<T>& wo, const P3<T>& u) const {
    if (!(wo.z > 0)) return std::nullopt;
    const V3<T> wi = u.x < T(0.5) ? lambert_direction(u.y, u.z)
                                  : mirrored_at(wo, facets().seen_normal(wo, u.y, u.z));
    return wi.z > 0 ? std::optional<V3<T>>(wi) : std::nullopt;
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    if (!both_above(wo, wi)) return 0;
    const V3<T> h = halfway(wo, wi);
    return (wi.z / pi_v<T> + facets().seen(wo, h) / (4 * dot(wo, h))) / 2;
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    if (!both_above(wo, wi)) return 0;
    const T d = facets().ndf(halfway(wo, wi)) * facets().shadows(wo, wi);
    return matte / pi_v<T> + gloss * d / (4 * wo.z * wi.z);
  }
};

/// A game's: arrays with y up, the sampled direction first, eval with the cosine.
struct Arcade {
  using Vec = std::array<float, 3>;
  Satin<float> satin{};
  int fault = 0;

  struct Record {
    Vec dir;
    float throughput, pdf;
  };
  static V3<float> in(const Vec& w) { return {w[2], w[0], w[1]}; }
  std::optional<Record> sample(const Vec& wo, const P3<float>& u) const {
    const auto wi = satin.direction(in(wo), u);
    if (!wi) return std::nullopt;
    const float q = satin.pdf(in(wo), *wi);
    return Record{{wi->y, wi->z, wi->x}, satin.eval(in(wo), *wi) * wi->z / q, q};
  }
  float pdf(const Vec& wi, const Vec& wo) const { return satin.pdf(in(wo), in(wi)); }
  float eval(const Vec& wi, const Vec& wo) const {
    return satin.eval(in(wo), in(wi)) * (fault == 1 ? wo[1] : wi[1]);
  }
};

/// A path tracer's in world space, whose record has f beside the pdf.
struct Studio {
  using V = V3<double>;
  Frame<double> shading{V{0.36, -0.48, 0.8}};
  Satin<double> satin{};
  int fault = 0;

  struct Record {
    V wi;
    double f, pdf;
  };
  std::optional<Record> sample(const V& wo, const P3<double>& u) const {
    const V o = shading.to_local(wo);
    const auto wi = satin.direction(o, u);
    if (!wi) return std::nullopt;
    const double f = satin.eval(o, *wi);
    return Record{shading.to_world(*wi), fault == 2 ? f / pi_v<double> : f, satin.pdf(o, *wi)};
  }
  double pdf(const V& wo, const V& wi) const {
    // The right normal, and tangents that are turned by a quarter: of use to isotropic gloss alone.
    const V o = shading.to_local(wo), i = shading.to_local(wi);
    if (fault == 1) return satin.pdf({-o.y, o.x, o.z}, {-i.y, i.x, i.z});
    return satin.pdf(o, i);
  }
  double eval(const V& wo, const V& wi) const {
    return satin.eval(shading.to_local(wo), shading.to_local(wi));
  }
};

/// A light tracer's: the given direction arrives, densities are per projected solid angle.
struct Tracer {
  using V = V3<double>;
  Satin<double> satin{};
  int fault = 0;

  struct Record {
    V w;
    double value, pdf;
  };
  std::optional<Record> sample(const V& ray, const P3<double>& u) const {
    const V wo = -ray;
    const auto wi = satin.direction(wo, u);
    if (!wi) return std::nullopt;
    const double q = satin.pdf(wo, *wi);
    const double projected = q / wi->z;
    return Record{*wi, satin.eval(wo, *wi) / projected, fault == 1 ? q : projected};
  }
  double pdf(const V& ray, const V& wi) const {
    if (!(wi.z > 0)) return 0;
    const double q = satin.pdf(-ray, wi);
    return fault == 2 ? q * wi.z : q / wi.z;
  }
  double eval(const V& ray, const V& wi) const { return satin.eval(-ray, wi); }
};

BsdfOptions arcade_options() {
  BsdfOptions options = seen_from({20, 60});
  options.conventions.frame = Conventions::Frame::local_y_up;
  options.conventions.sampled_direction_first = true;
  options.conventions.cosine_in_eval = true;
  return options;
}

BsdfOptions studio_options() {
  BsdfOptions options = seen_from({30, 65});
  options.conventions.frame = Conventions::Frame::world;
  options.conventions.normal = {0.36, -0.48, 0.8};
  options.conventions.weight = Conventions::Weight::f;
  return options;
}

BsdfOptions tracer_options() {
  BsdfOptions options = seen_from({15, 55});
  options.conventions.given_points_in = true;
  options.conventions.projected_pdf = true;
  return options;
}

template <class Renderer>
Renderer written_by(int fault) {
  Renderer renderer;
  renderer.fault = put(fault);
  return renderer;
}

}  // namespace
}  // namespace fifth

void add_sealed_conventions_cases(std::vector<Case>& cases) {
  using namespace fifth;
  using D3 = V3<double>;
  twin<Arcade::Vec>(cases, "fifth arcade/float", "the other cosine in eval",
                    because("eval has the cosine of wo, the weight that of wi"),
                    {CauseKind::value_cosine, CauseKind::directions_swapped}, written_by<Arcade>(1),
                    arcade_options());
  twin<D3>(cases, "fifth studio/double", "tangents turned in pdf",
           because("pdf has tangents that are turned by a quarter against those of sample"),
           {CauseKind::tangent_frame, CauseKind::mirrored}, written_by<Studio>(1),
           studio_options());
  twin<D3>(cases, "fifth studio/f in the record/double", "1/pi twice in the record",
           because("the f of the record is divided by pi once more"),
           {CauseKind::value_constant, CauseKind::weight}, written_by<Studio>(2), studio_options());
  twin<D3>(cases, "fifth tracer/double", "record not projected",
           because("the record states the pdf per solid angle, pdf() is per projected one"),
           {CauseKind::record_pdf, CauseKind::cosine}, written_by<Tracer>(1), tracer_options());
  twin<D3>(cases, "fifth tracer/projected pdf/double", "times the cosine",
           because("pdf is multiplied by cos wi where it is to be divided"), {CauseKind::cosine},
           written_by<Tracer>(2), tracer_options());
}

}  // namespace plumbline::tests::corpus
