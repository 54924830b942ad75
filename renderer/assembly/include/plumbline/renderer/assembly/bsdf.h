#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include <plumbline/renderer/core/bsdf/bsdf_table.h>
#include <plumbline/renderer/core/bsdf/ggx_conductor.h>
#include <plumbline/renderer/core/bsdf/ggx_dielectric.h>
#include <plumbline/renderer/core/bsdf/lambertian.h>
#include <plumbline/renderer/core/bsdf/mixture.h>
#include <plumbline/renderer/core/bsdf/modified_phong.h>
#include <plumbline/renderer/core/bsdf/smooth_conductor.h>
#include <plumbline/renderer/core/bsdf/smooth_dielectric.h>
#include <plumbline/renderer/core/bsdf/two_sided.h>
#include <plumbline/renderer/layered_bsdfs/clear_coat.h>
#include <plumbline/renderer/layered_bsdfs/thin_film.h>

namespace plumbline::renderer {

/// Every BSDF of the renderer. The tests walk this list: an alternative without examples does not
/// compile there (tests/bsdf/examples.h).
using Bsdf = std::variant<Lambertian, ModifiedPhong, GgxConductor, GgxDielectric, SmoothConductor,
                          SmoothDielectric, ClearCoat, ThinFilm, TwoSided, Mixture>;

/// A BSDF that refers to others, by their index in the set that it is in.
template <class B>
concept NestedBsdf = requires(const B& bsdf) {
  { bsdf.children() } -> std::convertible_to<std::array<std::uint32_t, 2>>;
};

class BsdfSet;

/// One BSDF of a set: what shading code and checks ask, in any scalar. Directions are unit vectors
/// in the local frame, pointing away from the surface. A nested BSDF gets the set as its first
/// argument.
class BsdfRef {
 public:
  BsdfRef(const BsdfSet& set, std::uint32_t index) : set_(&set), index_(index) {}

  const BsdfParts& parts() const;

  /// @return f [1/sr], without the cosine, for radiance: across a refraction it holds (η_o/η_i)².
  ///         Atoms do not show
  template <class T>
  Rgb<T> eval(const Vec3<T>& wo, const Vec3<T>& wi) const;

  /// @param u  in [0, 1)²
  /// @return   nullopt where there is nothing to sample from wo, or u leads below the horizon
  template <class T>
  std::optional<BsdfSample<T>> sample(const Vec3<T>& wo, const Vec2<T>& u) const;

  /// @return pdf_w [1/sr] with which `sample(wo, u)` gives wi, atoms excluded; finite, ≥ 0
  template <class T>
  T pdf(const Vec3<T>& wo, const Vec3<T>& wi) const;

  /// eval(wo, wi) and pdf(wo, wi) at the cost of little more than one of them.
  template <class T>
  BsdfValue<T> evaluate(const Vec3<T>& wo, const Vec3<T>& wi) const;

  /// A BSDF is a mixture of lobes: with probability P_k(wo) it samples lobe k, so that
  /// pdf = Σ P_k pdf_k, and each lobe's map of u to wi is smooth.
  std::uint32_t lobe_count() const {
    return call<std::uint32_t>([](const auto& b, const auto&... set) {
      if constexpr (requires { b.lobe_count(set...); }) {
        return b.lobe_count(set...);
      } else {
        return std::uint32_t{1};
      }
    });
  }

  /// @return P_k [1]; they sum to 1
  template <class T>
  T lobe_probability(const Vec3<T>& wo, std::uint32_t lobe) const;

  /// The lobe as if it were all of the BSDF: pdf_w and mass without P_k, weight of its own f.
  template <class T>
  std::optional<BsdfSample<T>> sample_lobe(const Vec3<T>& wo, std::uint32_t lobe,
                                           const Vec2<T>& u) const;

  /// @return pdf_w [1/sr] of `sample_lobe`
  template <class T>
  T pdf_lobe(const Vec3<T>& wo, const Vec3<T>& wi, std::uint32_t lobe) const;

 private:
  /// function(bsdf), or function(bsdf, set) for a nested one.
  template <class Result, class Function>
  Result call(const Function& function) const;

  const BsdfSet* set_;
  std::uint32_t index_;
};

/// The BSDFs of a scene.
class BsdfSet final : public BsdfTable {
 public:
  BsdfSet() = default;

  /// @throws std::invalid_argument where a nested BSDF refers to itself or to a later one: children
  ///         come first, so that no chain of references can close
  explicit BsdfSet(std::vector<Bsdf> bsdfs);

  /// Adds a BSDF, whose children are there already.
  /// @return its index
  std::uint32_t add(Bsdf bsdf);

  BsdfRef operator[](std::uint32_t i) const { return {*this, i}; }
  const Bsdf& alternative(std::uint32_t i) const { return bsdfs_[i]; }

  std::size_t size() const override { return bsdfs_.size(); }
  const BsdfParts& parts(std::uint32_t i) const override { return parts_[i]; }
  BsdfValue<float> evaluate(std::uint32_t i, const Vec3f& wo, const Vec3f& wi) const override;
  std::optional<BsdfSample<float>> sample(std::uint32_t i, const Vec3f& wo,
                                          const Vec2f& u) const override;

 private:
  std::vector<Bsdf> bsdfs_;
  std::vector<BsdfParts> parts_;
};

/// A table for SceneDescription::bsdfs.
std::shared_ptr<const BsdfSet> make_bsdfs(std::vector<Bsdf> bsdfs);

inline const BsdfParts& BsdfRef::parts() const { return set_->parts(index_); }

template <class Result, class Function>
Result BsdfRef::call(const Function& function) const {
  return std::visit(
      [&]<class B>(const B& bsdf) -> Result {
        if constexpr (NestedBsdf<B>) {
          return function(bsdf, *set_);
        } else {
          return function(bsdf);
        }
      },
      set_->alternative(index_));
}

template <class T>
Rgb<T> BsdfRef::eval(const Vec3<T>& wo, const Vec3<T>& wi) const {
  return call<Rgb<T>>([&](const auto& b, const auto&... set) { return b.eval(set..., wo, wi); });
}

template <class T>
std::optional<BsdfSample<T>> BsdfRef::sample(const Vec3<T>& wo, const Vec2<T>& u) const {
  return call<std::optional<BsdfSample<T>>>(
      [&](const auto& b, const auto&... set) { return b.sample(set..., wo, u); });
}

template <class T>
T BsdfRef::pdf(const Vec3<T>& wo, const Vec3<T>& wi) const {
  return call<T>([&](const auto& b, const auto&... set) { return b.pdf(set..., wo, wi); });
}

template <class T>
BsdfValue<T> BsdfRef::evaluate(const Vec3<T>& wo, const Vec3<T>& wi) const {
  return call<BsdfValue<T>>(
      [&](const auto& b, const auto&... set) { return evaluate_bsdf(wo, wi, b, set...); });
}

template <class T>
T BsdfRef::lobe_probability(const Vec3<T>& wo, std::uint32_t lobe) const {
  return call<T>([&](const auto& b, const auto&... set) {
    if constexpr (requires { b.lobe_count(set...); }) {
      return b.lobe_probability(set..., wo, lobe);
    } else {
      return T(1);
    }
  });
}

template <class T>
std::optional<BsdfSample<T>> BsdfRef::sample_lobe(const Vec3<T>& wo, std::uint32_t lobe,
                                                  const Vec2<T>& u) const {
  return call<std::optional<BsdfSample<T>>>([&](const auto& b, const auto&... set) {
    if constexpr (requires { b.lobe_count(set...); }) {
      return b.sample_lobe(set..., wo, lobe, u);
    } else {
      return b.sample(set..., wo, u);
    }
  });
}

template <class T>
T BsdfRef::pdf_lobe(const Vec3<T>& wo, const Vec3<T>& wi, std::uint32_t lobe) const {
  return call<T>([&](const auto& b, const auto&... set) {
    if constexpr (requires { b.lobe_count(set...); }) {
      return b.pdf_lobe(set..., wo, wi, lobe);
    } else {
      return b.pdf(set..., wo, wi);
    }
  });
}

// NOLINTBEGIN(bugprone-macro-parentheses): a type cannot stand in parentheses
/// Every member for one scalar, as `extern template` declares it and `template` compiles it.
#define PLUMBLINE_BSDF_REF(KEYWORDS, T)                                                        \
  KEYWORDS Rgb<T> BsdfRef::eval(const Vec3<T>&, const Vec3<T>&) const;                         \
  KEYWORDS std::optional<BsdfSample<T>> BsdfRef::sample(const Vec3<T>&, const Vec2<T>&) const; \
  KEYWORDS T BsdfRef::pdf(const Vec3<T>&, const Vec3<T>&) const;                               \
  KEYWORDS BsdfValue<T> BsdfRef::evaluate(const Vec3<T>&, const Vec3<T>&) const;               \
  KEYWORDS T BsdfRef::lobe_probability(const Vec3<T>&, std::uint32_t) const;                   \
  KEYWORDS std::optional<BsdfSample<T>> BsdfRef::sample_lobe(const Vec3<T>&, std::uint32_t,    \
                                                             const Vec2<T>&) const;            \
  KEYWORDS T BsdfRef::pdf_lobe(const Vec3<T>&, const Vec3<T>&, std::uint32_t) const;
// NOLINTEND(bugprone-macro-parentheses)

// Compiled once, in bsdf.cpp: every type for a scalar costs seconds.
PLUMBLINE_BSDF_REF(extern template, float)
PLUMBLINE_BSDF_REF(extern template, double)

}  // namespace plumbline::renderer
