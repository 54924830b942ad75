#pragma once

#include <array>
#include <optional>

#include <plumbline/renderer/core/bsdf/bsdf_sample.h>

namespace plumbline::renderer {

/// Gives each side of a surface a one-sided BSDF, like Mitsuba's `twosided`. Seen from behind the
/// local frame is mirrored at the surface: only z changes its sign.
struct TwoSided {
  std::uint32_t front, back;  ///< indices of BSDFs without transmission

  std::array<std::uint32_t, 2> children() const { return {front, back}; }

  template <class Set>
  BsdfParts parts(const Set& set) const {
    return set[front].parts() | set[back].parts();
  }

  /// @return f [1/sr], without the cosine; 0 unless wo and wi are on the same side
  template <class Set, class T>
  Rgb<T> eval(const Set& set, const Vec3<T>& wo, const Vec3<T>& wi) const {
    return set[side(wo)].eval(to_front(wo, wo), to_front(wo, wi));
  }

  template <class Set, class T>
  BsdfValue<T> evaluate(const Set& set, const Vec3<T>& wo, const Vec3<T>& wi) const {
    return set[side(wo)].evaluate(to_front(wo, wo), to_front(wo, wi));
  }

  template <class Set, class T>
  std::optional<BsdfSample<T>> sample(const Set& set, const Vec3<T>& wo, const Vec2<T>& u) const {
    auto result = set[side(wo)].sample(to_front(wo, wo), u);
    if (result) result->wi = to_front(wo, result->wi);
    return result;
  }

  /// @return pdf_w [1/sr] of `sample(wo, u)`
  template <class Set, class T>
  T pdf(const Set& set, const Vec3<T>& wo, const Vec3<T>& wi) const {
    return set[side(wo)].pdf(to_front(wo, wo), to_front(wo, wi));
  }

  /// The larger of both sides: a lobe that one of them lacks has probability 0 there.
  template <class Set>
  std::uint32_t lobe_count(const Set& set) const {
    return std::max(set[front].lobe_count(), set[back].lobe_count());
  }

  template <class Set, class T>
  T lobe_probability(const Set& set, const Vec3<T>& wo, std::uint32_t lobe) const {
    if (lobe >= set[side(wo)].lobe_count()) return T(0);
    return set[side(wo)].lobe_probability(to_front(wo, wo), lobe);
  }

  template <class Set, class T>
  std::optional<BsdfSample<T>> sample_lobe(const Set& set, const Vec3<T>& wo, std::uint32_t lobe,
                                           const Vec2<T>& u) const {
    if (lobe >= set[side(wo)].lobe_count()) return std::nullopt;
    auto result = set[side(wo)].sample_lobe(to_front(wo, wo), lobe, u);
    if (result) result->wi = to_front(wo, result->wi);
    return result;
  }

  template <class Set, class T>
  T pdf_lobe(const Set& set, const Vec3<T>& wo, const Vec3<T>& wi, std::uint32_t lobe) const {
    if (lobe >= set[side(wo)].lobe_count()) return T(0);
    return set[side(wo)].pdf_lobe(to_front(wo, wo), to_front(wo, wi), lobe);
  }

 private:
  template <class T>
  std::uint32_t side(const Vec3<T>& wo) const {
    return wo.z < T(0) ? back : front;
  }

  template <class T>
  static Vec3<T> to_front(const Vec3<T>& wo, const Vec3<T>& w) {
    return wo.z < T(0) ? Vec3<T>{w.x, w.y, T(-w.z)} : w;
  }
};

}  // namespace plumbline::renderer
