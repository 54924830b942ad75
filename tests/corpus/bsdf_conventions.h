#pragma once

#include <array>

#include "bsdf_math.h"
#include "bsdf_mixture.h"

/// The same paint as five renderers would write it down.
namespace plumbline::tests::corpus {

/// Arrays for vectors, eval with the cosine, colours as arrays, a cosine without its name.
struct ArrayStyle {
  using Vec = std::array<float, 3>;
  PaintOfThree<float> paint{};
  Vec tint{1.0F, 0.8F, 0.5F};
  int fault = 0;

  struct Record {
    Vec wi, value;
    float pdf_w;
  };
  static V3<float> v(const Vec& a) { return {a[0], a[1], a[2]}; }
  std::optional<Record> sample(const Vec& wo, const P3<float>& u) const {
    const auto s = paint.sample(v(wo), u);
    if (!s) return std::nullopt;
    const Vec wi{s->wi.x, s->wi.y, s->wi.z};
    Vec value = eval(wo, wi);
    for (float& c : value) c /= fault == 2 ? s->pdf * s->wi.z : s->pdf;
    return Record{wi, value, s->pdf};
  }
  float pdf(const Vec& wo, const Vec& wi) const { return paint.pdf(v(wo), v(wi)); }
  Vec eval(const Vec& wo, const Vec& wi) const {
    const float f = paint.eval(v(wo), v(wi)) * (fault == 1 ? wi[2] * wi[2] : wi[2]);
    return {f * tint[0], f * tint[1], f * tint[2]};
  }
};

/// The given direction is that of the arriving ray; the sampled one comes first.
struct RayStyle {
  using V = V3<double>;
  PaintOfTwo<double> paint{};
  int fault = 0;

  struct Record {
    V dir;
    double f, pdf;
  };
  std::optional<Record> sample(const V& ray, double u, double v) const {
    const auto s = paint.sample(-ray, u, v);
    if (!s) return std::nullopt;
    return Record{s->wi, eval(s->wi, ray), s->pdf};
  }
  double pdf(const V& wi, const V& ray) const {
    return fault == 1 ? paint.pdf({ray.x, ray.y, -ray.z}, wi) : paint.pdf(-ray, wi);
  }
  double eval(const V& wi, const V& ray) const { return paint.eval(-ray, wi); }
};

/// y is the normal; anisotropic, so that the tangents count.
struct YUpStyle {
  using V = V3<double>;
  Conductor<double> metal{{0.1, 0.5}};
  int fault = 0;

  struct Record {
    V wi;
    double value, pdf;
  };
  static V to_z(const V& w) { return {w.x, -w.z, w.y}; }
  static V to_y(const V& w) { return {w.x, w.z, -w.y}; }
  std::optional<Record> sample(const V& wo, const P2<double>& u) const {
    const auto s = metal.sample(to_z(wo), u.x, u.y);
    if (!s) return std::nullopt;
    const V wi = to_y(s->wi);
    return Record{wi, eval(wo, wi) * wi.y, s->pdf};
  }
  double pdf(const V& wo, const V& wi) const {
    if (fault == 1) return metal.pdf(to_z(wo), {wi.x, wi.z, wi.y});
    return metal.pdf(to_z(wo), to_z(wi));
  }
  double eval(const V& wo, const V& wi) const { return metal.eval(to_z(wo), to_z(wi)); }
};

/// A vector class that is made first and filled in later.
class Indexed {
 public:
  double operator[](int i) const { return at_[static_cast<std::size_t>(i)]; }
  double& operator[](int i) { return at_[static_cast<std::size_t>(i)]; }
  V3<double> v() const { return {at_[0], at_[1], at_[2]}; }
  static Indexed of(const V3<double>& w) {
    Indexed a;
    a[0] = w.x, a[1] = w.y, a[2] = w.z;
    return a;
  }

 private:
  std::array<double, 3> at_{};
};

/// In world space, around a normal that the object holds. The record is a direction and no more.
struct WorldStyle {
  Frame<double> frame{V3<double>{0.48, 0.6, 0.64}};
  PaintOfTwo<double> paint{};
  int fault = 0;

  struct Record {
    Indexed direction;
  };
  std::optional<Record> sample(const Indexed& wo, const P2<double>& u) const {
    const auto s = paint.sample(frame.to_local(wo.v()), u.x, u.y);
    if (!s) return std::nullopt;
    if (fault == 1) {
      const V3<double> w = frame.to_local(s->wi);
      return Record{Indexed::of(w)};
    }
    return Record{Indexed::of(frame.to_world(s->wi))};
  }
  double pdf(const Indexed& wo, const Indexed& wi) const {
    return paint.pdf(frame.to_local(wo.v()), frame.to_local(wi.v()));
  }
  double eval(const Indexed& wo, const Indexed& wi) const {
    const double f = paint.eval(frame.to_local(wo.v()), frame.to_local(wi.v()));
    return fault == 2 ? f / pi_v<double> : f;
  }
};

/// Densities per projected solid angle.
struct ProjectedStyle {
  using V = V3<float>;
  PaintOfTwo<float> paint{};
  int fault = 0;

  struct Record {
    V wi;
    float weight, pdf;
  };
  Record sample(const V& wo, float u, float v) const {
    const auto s = paint.sample(wo, u, v);
    if (!s) return {wo, 0, 0};
    return {s->wi, s->weight, s->pdf / s->wi.z};
  }
  float pdf(const V& wo, const V& wi) const {
    if (!(wi.z > 0) || !(wo.z > 0)) return 0;
    return fault == 1 ? paint.pdf(wo, wi) : paint.pdf(wo, wi) / (fault == 2 ? wo.z : wi.z);
  }
  float eval(const V& wo, const V& wi) const { return paint.eval(wo, wi); }
};

}  // namespace plumbline::tests::corpus
