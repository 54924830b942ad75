#pragma once

#include <concepts>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <utility>
#include <variant>
#include <vector>

#include <plumbline/renderer/bsdf/bsdf_sample.h>
#include <plumbline/renderer/bsdf/clear_coat.h>
#include <plumbline/renderer/bsdf/ggx_conductor.h>
#include <plumbline/renderer/bsdf/ggx_dielectric.h>
#include <plumbline/renderer/bsdf/lambertian.h>
#include <plumbline/renderer/bsdf/mixture.h>
#include <plumbline/renderer/bsdf/modified_phong.h>
#include <plumbline/renderer/bsdf/smooth_conductor.h>
#include <plumbline/renderer/bsdf/smooth_dielectric.h>
#include <plumbline/renderer/bsdf/thin_film.h>
#include <plumbline/renderer/bsdf/two_sided.h>

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

/// The BSDFs of a scene, and the one way to ask them anything. What a BSDF offers is described at
/// `BsdfRef`; nested ones get the set as their first argument.
class BsdfSet {
 public:
  BsdfSet() = default;

  /// @throws std::invalid_argument where a nested BSDF refers to itself or to a later one: children
  ///         come first, so that no chain of references can close
  explicit BsdfSet(std::vector<Bsdf> bsdfs) : bsdfs_(std::move(bsdfs)) {
    for (std::uint32_t i = 0; i < bsdfs_.size(); ++i) {
      check_children(i);
      parts_.push_back(
          call<BsdfParts>(i, [](const auto& b, const auto&... set) { return b.parts(set...); }));
    }
  }

  std::size_t size() const { return bsdfs_.size(); }
  const Bsdf& operator[](std::uint32_t i) const { return bsdfs_[i]; }
  const BsdfParts& parts(std::uint32_t i) const { return parts_[i]; }

  template <class T>
  Rgb<T> eval(std::uint32_t i, const Vec3<T>& wo, const Vec3<T>& wi) const {
    return call<Rgb<T>>(i,
                        [&](const auto& b, const auto&... set) { return b.eval(set..., wo, wi); });
  }

  /// Not inlined: then the BSDF writes its answer where the caller wants it, without a copy.
  template <class T>
  [[gnu::noinline]] BsdfValue<T> evaluate(std::uint32_t i, const Vec3<T>& wo,
                                          const Vec3<T>& wi) const {
    return call<BsdfValue<T>>(i, [&](const auto& b, const auto&... set) {
      if constexpr (requires { b.evaluate(set..., wo, wi); }) {
        return b.evaluate(set..., wo, wi);
      } else {
        return BsdfValue<T>{b.eval(set..., wo, wi), b.pdf(set..., wo, wi)};
      }
    });
  }

  template <class T>
  std::optional<BsdfSample<T>> sample(std::uint32_t i, const Vec3<T>& wo, const Vec2<T>& u) const {
    return call<std::optional<BsdfSample<T>>>(
        i, [&](const auto& b, const auto&... set) { return b.sample(set..., wo, u); });
  }

  template <class T>
  T pdf(std::uint32_t i, const Vec3<T>& wo, const Vec3<T>& wi) const {
    return call<T>(i, [&](const auto& b, const auto&... set) { return b.pdf(set..., wo, wi); });
  }

  std::uint32_t lobe_count(std::uint32_t i) const {
    return call<std::uint32_t>(i, [](const auto& b, const auto&... set) {
      if constexpr (requires { b.lobe_count(set...); }) {
        return b.lobe_count(set...);
      } else {
        return std::uint32_t{1};
      }
    });
  }

  template <class T>
  T lobe_probability(std::uint32_t i, const Vec3<T>& wo, std::uint32_t lobe) const {
    return call<T>(i, [&](const auto& b, const auto&... set) {
      if constexpr (requires { b.lobe_count(set...); }) {
        return b.lobe_probability(set..., wo, lobe);
      } else {
        return T(1);
      }
    });
  }

  template <class T>
  std::optional<BsdfSample<T>> sample_lobe(std::uint32_t i, const Vec3<T>& wo, std::uint32_t lobe,
                                           const Vec2<T>& u) const {
    return call<std::optional<BsdfSample<T>>>(i, [&](const auto& b, const auto&... set) {
      if constexpr (requires { b.lobe_count(set...); }) {
        return b.sample_lobe(set..., wo, lobe, u);
      } else {
        return b.sample(set..., wo, u);
      }
    });
  }

  template <class T>
  T pdf_lobe(std::uint32_t i, const Vec3<T>& wo, const Vec3<T>& wi, std::uint32_t lobe) const {
    return call<T>(i, [&](const auto& b, const auto&... set) {
      if constexpr (requires { b.lobe_count(set...); }) {
        return b.pdf_lobe(set..., wo, wi, lobe);
      } else {
        return b.pdf(set..., wo, wi);
      }
    });
  }

  /// function(bsdf) with the alternative itself, or function(bsdf, set) for a nested one: for loops
  /// over many points of one BSDF, which then choose once.
  template <class Function>
  void visit(std::uint32_t i, const Function& function) const {
    call<void>(i, function);
  }

 private:
  template <class Result, class Function>
  Result call(std::uint32_t i, const Function& function) const {
    return std::visit(
        [&](const auto& bsdf) -> Result {
          if constexpr (NestedBsdf<std::remove_cvref_t<decltype(bsdf)>>) {
            return function(bsdf, *this);
          } else {
            return function(bsdf);
          }
        },
        bsdfs_[i]);
  }

  void check_children(std::uint32_t i) const {
    std::visit(
        [&](const auto& bsdf) {
          if constexpr (NestedBsdf<std::remove_cvref_t<decltype(bsdf)>>) {
            for (const std::uint32_t child : bsdf.children()) {
              if (child >= i) throw std::invalid_argument("a nested BSDF must follow its children");
            }
          }
        },
        bsdfs_[i]);
  }

  std::vector<Bsdf> bsdfs_;
  std::vector<BsdfParts> parts_;
};

/// One BSDF of a set: what shading code and checks hold in their hands.
class BsdfRef {
 public:
  BsdfRef(const BsdfSet& set, std::uint32_t index) : set_(&set), index_(index) {}

  const BsdfParts& parts() const { return set_->parts(index_); }

  /// @param wo, wi  unit vectors in the local frame, pointing away from the surface
  /// @return        f [1/sr], without the cosine, for radiance: across a refraction it holds
  ///                (η_o/η_i)². Atoms do not show
  template <class T>
  Rgb<T> eval(const Vec3<T>& wo, const Vec3<T>& wi) const {
    return set_->eval(index_, wo, wi);
  }

  /// @param u  in [0, 1)²
  /// @return   nullopt where there is nothing to sample from wo, or u leads below the horizon
  template <class T>
  std::optional<BsdfSample<T>> sample(const Vec3<T>& wo, const Vec2<T>& u) const {
    return set_->sample(index_, wo, u);
  }

  /// @return pdf_w [1/sr] with which `sample(wo, u)` gives wi, atoms excluded; finite, ≥ 0
  template <class T>
  T pdf(const Vec3<T>& wo, const Vec3<T>& wi) const {
    return set_->pdf(index_, wo, wi);
  }

  /// @return eval(wo, wi) and pdf(wo, wi) at the cost of little more than one of them
  template <class T>
  BsdfValue<T> evaluate(const Vec3<T>& wo, const Vec3<T>& wi) const {
    return set_->evaluate(index_, wo, wi);
  }

  /// A BSDF is a mixture of lobes: with probability P_k(wo) it samples lobe k, so that
  /// pdf = Σ P_k pdf_k, and each lobe's map of u to wi is smooth.
  std::uint32_t lobe_count() const { return set_->lobe_count(index_); }

  /// @return P_k [1]; they sum to 1
  template <class T>
  T lobe_probability(const Vec3<T>& wo, std::uint32_t lobe) const {
    return set_->lobe_probability(index_, wo, lobe);
  }

  /// The lobe as if it were all of the BSDF: pdf_w and mass without P_k, weight of its own f.
  template <class T>
  std::optional<BsdfSample<T>> sample_lobe(const Vec3<T>& wo, std::uint32_t lobe,
                                           const Vec2<T>& u) const {
    return set_->sample_lobe(index_, wo, lobe, u);
  }

  /// @return pdf_w [1/sr] of `sample_lobe`
  template <class T>
  T pdf_lobe(const Vec3<T>& wo, const Vec3<T>& wi, std::uint32_t lobe) const {
    return set_->pdf_lobe(index_, wo, wi, lobe);
  }

 private:
  const BsdfSet* set_;
  std::uint32_t index_;
};

}  // namespace plumbline::renderer
