#pragma once

#include <array>
#include <optional>
#include <utility>
#include <variant>

#include <plumbline/renderer/core/bsdf/ggx_conductor.h>
#include <plumbline/renderer/core/bsdf/ggx_dielectric.h>
#include <plumbline/renderer/core/bsdf/smooth_conductor.h>
#include <plumbline/renderer/core/bsdf/smooth_dielectric.h>
#include <plumbline/renderer/layered_bsdfs/film_fresnel.h>

namespace plumbline::renderer {

/// A transparent film on metal or glass: the lobes of the base with the reflectance of film and
/// base together. Without thickness it is the bare base.
class ThinFilm {
 public:
  using Base = std::variant<SmoothConductor, GgxConductor, SmoothDielectric, GgxDielectric>;

  ThinFilm(Base base, const FilmLayer& film)
      : base_(std::move(base)),
        film_(film),
        coating_(std::visit([&](const auto& b) { return coating_of(b, film); }, base_)) {}

  const Base& base() const { return base_; }
  const FilmLayer& film() const { return film_; }

  BsdfParts parts() const {
    return std::visit([](const auto& b) { return b.parts(); }, base_);
  }

  /// @param wo, wi  unit vectors in the local frame, pointing away from the surface
  /// @return        f [1/sr], without the cosine, for radiance
  template <class T>
  Rgb<T> eval(const Vec3<T>& wo, const Vec3<T>& wi) const {
    return evaluate(wo, wi).f;
  }

  template <class T>
  BsdfValue<T> evaluate(const Vec3<T>& wo, const Vec3<T>& wi) const {
    return visit<BsdfValue<T>>([&](const auto& b) {
      if constexpr (requires { b.evaluate_with(coated(b), wo, wi); }) {
        return b.evaluate_with(coated(b), wo, wi);
      } else {
        return BsdfValue<T>{};  // atoms do not show
      }
    });
  }

  template <class T>
  std::optional<BsdfSample<T>> sample(const Vec3<T>& wo, const Vec2<T>& u) const {
    return visit<std::optional<BsdfSample<T>>>(
        [&](const auto& b) { return b.sample_with(coated(b), wo, u); });
  }

  /// @return pdf_w [1/sr] of `sample(wo, u)`: a film leaves the directions alone
  template <class T>
  T pdf(const Vec3<T>& wo, const Vec3<T>& wi) const {
    return visit<T>([&](const auto& b) { return b.pdf(wo, wi); });
  }

  std::uint32_t lobe_count() const { return parts().transmission ? 2 : 1; }

  template <class T>
  T lobe_probability(const Vec3<T>& wo, std::uint32_t lobe) const {
    return visit<T>([&](const auto& b) {
      if constexpr (requires { b.lobe_probability_with(coated(b), wo, lobe); }) {
        return b.lobe_probability_with(coated(b), wo, lobe);
      } else if constexpr (requires { b.lobe_count(); }) {
        return b.lobe_probability(wo, lobe);
      } else {
        return T(1);
      }
    });
  }

  template <class T>
  std::optional<BsdfSample<T>> sample_lobe(const Vec3<T>& wo, std::uint32_t lobe,
                                           const Vec2<T>& u) const {
    return visit<std::optional<BsdfSample<T>>>([&](const auto& b) {
      if constexpr (requires { b.lobe_count(); }) {
        return b.sample_lobe_with(coated(b), wo, lobe, u);
      } else {
        return b.sample_with(coated(b), wo, u);
      }
    });
  }

  template <class T>
  T pdf_lobe(const Vec3<T>& wo, const Vec3<T>& wi, std::uint32_t lobe) const {
    return visit<T>([&](const auto& b) {
      if constexpr (requires { b.lobe_count(); }) {
        return b.pdf_lobe(wo, wi, lobe);
      } else {
        return b.pdf(wo, wi);
      }
    });
  }

 private:
  template <class Result, class Function>
  Result visit(const Function& function) const {
    return std::visit([&](const auto& b) -> Result { return function(b); }, base_);
  }

  using Coating = std::variant<FilmOnConductor, FilmOnDielectric>;

  template <class B>
  static Coating coating_of(const B& base, const FilmLayer& film) {
    if constexpr (requires { base.fresnel; }) {
      return FilmOnConductor(film, base.fresnel);
    } else {
      return FilmOnDielectric{film, base.interface.eta};
    }
  }

  /// What takes the place of the base's own reflectance.
  template <class B>
  const auto& coated(const B&) const {
    if constexpr (requires(const B& b) { b.fresnel; }) {
      return *std::get_if<FilmOnConductor>(&coating_);
    } else {
      return *std::get_if<FilmOnDielectric>(&coating_);
    }
  }

  Base base_;
  FilmLayer film_;
  Coating coating_;
};

}  // namespace plumbline::renderer
