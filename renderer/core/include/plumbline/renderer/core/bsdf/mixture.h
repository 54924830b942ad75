#pragma once

#include <array>
#include <optional>

#include <plumbline/renderer/core/bsdf/bsdf_sample.h>

namespace plumbline::renderer {

/// f = (1 − weight) f_first + weight f_second, like Mitsuba's `blendbsdf`. Samples the second with
/// probability `weight`.
struct Mixture {
  std::uint32_t first, second;  ///< indices
  float weight;                 ///< of the second, [0, 1]

  std::array<std::uint32_t, 2> children() const { return {first, second}; }

  template <class Set>
  BsdfParts parts(const Set& set) const {
    return set[first].parts() | set[second].parts();
  }

  template <class Set, class T>
  Rgb<T> eval(const Set& set, const Vec3<T>& wo, const Vec3<T>& wi) const {
    return set[first].eval(wo, wi) * share<T>(0) + set[second].eval(wo, wi) * share<T>(1);
  }

  template <class Set, class T>
  BsdfValue<T> evaluate(const Set& set, const Vec3<T>& wo, const Vec3<T>& wi) const {
    const BsdfValue<T> a = set[first].evaluate(wo, wi), b = set[second].evaluate(wo, wi);
    return {a.f * share<T>(0) + b.f * share<T>(1), a.pdf_w * share<T>(0) + b.pdf_w * share<T>(1)};
  }

  /// @param u  in [0, 1)²; u.x chooses and is then rescaled
  template <class Set, class T>
  std::optional<BsdfSample<T>> sample(const Set& set, const Vec3<T>& wo, const Vec2<T>& u) const {
    using std::abs;
    const auto choice = choose_lobe(u.x, share<T>(0));
    const bool chose_second = choice.lobe == 1;
    const T own = share<T>(choice.lobe), others = share<T>(1 - choice.lobe);
    auto result = set[chose_second ? second : first].sample(wo, Vec2<T>{choice.u, u.y});
    if (result && chose_second) result->lobe += set[first].lobe_count();
    if (result && result->is_atom()) {
      // It meets no density: its light and its probability shrink alike, and its weight stays.
      result->mass = result->mass * own;
    } else if (result) {
      // The other child could have made it too: the weight is Σ w_k f_k cosθi / pdf.
      const BsdfValue<T> other = set[chose_second ? first : second].evaluate(wo, result->wi);
      const T own_pdf = own * result->pdf_w;
      result->pdf_w = own_pdf + others * other.pdf_w;
      result->weight = (result->weight * own_pdf + other.f * T(others * abs(result->wi.z))) *
                       T(T(1) / result->pdf_w);
    }
    return result;
  }

  /// @return pdf_w [1/sr] of `sample(wo, u)`
  template <class Set, class T>
  T pdf(const Set& set, const Vec3<T>& wo, const Vec3<T>& wi) const {
    return set[first].pdf(wo, wi) * share<T>(0) + set[second].pdf(wo, wi) * share<T>(1);
  }

  template <class Set>
  std::uint32_t lobe_count(const Set& set) const {
    return set[first].lobe_count() + set[second].lobe_count();
  }

  template <class Set, class T>
  T lobe_probability(const Set& set, const Vec3<T>& wo, std::uint32_t lobe) const {
    const Child child = child_of(set, lobe);
    return share<T>(child.which) * set[child.bsdf].lobe_probability(wo, child.lobe);
  }

  template <class Set, class T>
  std::optional<BsdfSample<T>> sample_lobe(const Set& set, const Vec3<T>& wo, std::uint32_t lobe,
                                           const Vec2<T>& u) const {
    const Child child = child_of(set, lobe);
    auto result = set[child.bsdf].sample_lobe(wo, child.lobe, u);
    if (result) result->lobe = lobe;
    return result;
  }

  template <class Set, class T>
  T pdf_lobe(const Set& set, const Vec3<T>& wo, const Vec3<T>& wi, std::uint32_t lobe) const {
    const Child child = child_of(set, lobe);
    return set[child.bsdf].pdf_lobe(wo, wi, child.lobe);
  }

 private:
  struct Child {
    std::uint32_t which, bsdf, lobe;
  };

  template <class Set>
  Child child_of(const Set& set, std::uint32_t lobe) const {
    const std::uint32_t in_first = set[first].lobe_count();
    return lobe < in_first ? Child{0, first, lobe} : Child{1, second, lobe - in_first};
  }

  /// Share of the light and probability of a child: the same number.
  template <class T>
  T share(std::uint32_t which) const {
    return which == 0 ? T(1) - T(weight) : T(weight);
  }
};

}  // namespace plumbline::renderer
