#pragma once

#include <array>
#include <optional>

#include <plumbline/renderer/bsdf/bsdf_sample.h>
#include <plumbline/renderer/bsdf/fresnel.h>
#include <plumbline/renderer/bsdf/ggx_conductor.h>
#include <plumbline/renderer/bsdf/lambertian.h>

namespace plumbline::renderer {

/// A rough dielectric coat over a diffuse base. Black from behind.
///
/// The base gets what the coat lets in from wo and wi, and is scaled so that at base albedo 1 all
/// that the coat does not reflect comes back out:
///
///   f = f_coat + albedo/π (1 − E(wo)) (1 − E(wi)) / (1 − E_mean),
///
/// E the directional albedo of the coat, E_mean its cosine-weighted mean. So f is reciprocal, and
/// its own albedo is E + albedo (1 − E) ≤ 1.
/// @source Kelemen, Szirmay-Kalos 2001, "A microfacet based coupled specular-matte BRDF model with
///         importance sampling", Section 2.2
class ClearCoat {
 public:
  /// Tabulates E, which takes some milliseconds.
  ///
  /// @param eta     index of the coat over the index outside, > 1
  /// @param alpha   roughness of the coat, 1e-4 … 1
  /// @param albedo  of the base, per channel, [0, 1]
  ClearCoat(float eta, float alpha, const Rgbf& albedo)
      : coat_{{alpha, alpha}, {}}, reflectance_{{eta}}, base_{albedo} {
    tabulate();
  }

  float eta() const { return reflectance_.interface.eta; }
  float alpha() const { return coat_.ggx.alpha_x; }
  const Rgbf& base_albedo() const { return base_.albedo; }

  static constexpr BsdfParts parts() { return {.density = true}; }

  /// @param wo, wi  unit vectors in the local frame, pointing away from the surface
  /// @return        f [1/sr], without the cosine; 0 unless both are above the horizon
  template <class T>
  Rgb<T> eval(const Vec3<T>& wo, const Vec3<T>& wi) const {
    return evaluate(wo, wi).f;
  }

  template <class T>
  BsdfValue<T> evaluate(const Vec3<T>& wo, const Vec3<T>& wi) const {
    if (!(wo.z > T(0) && wi.z > T(0))) return {};
    const T albedo = coat_albedo(wo.z), coat_share = coat_probability(albedo);
    const T share = (T(1) - albedo) * (T(1) - coat_albedo(wi.z)) / T(mean_let_in_);
    const BsdfValue<T> coat = coat_.evaluate_with(reflectance_, wo, wi);
    return {coat.f + base_.eval(wo, wi) * share,
            coat_share * coat.pdf_w + (T(1) - coat_share) * base_.pdf(wo, wi)};
  }

  /// @param u  in [0, 1)²; u.x chooses the lobe and is then rescaled
  template <class T>
  std::optional<BsdfSample<T>> sample(const Vec3<T>& wo, const Vec2<T>& u) const {
    if (!(wo.z > T(0))) return std::nullopt;
    const auto choice = choose_lobe(u.x, lobe_probability(wo, 0));
    auto result = sample_lobe(wo, choice.lobe, Vec2<T>{choice.u, u.y});
    if (!result) return std::nullopt;
    const BsdfValue<T> both = evaluate(wo, result->wi);
    result->pdf_w = both.pdf_w;
    result->weight = both.f * T(result->wi.z / both.pdf_w);
    return result;
  }

  /// @return pdf_w [1/sr] of `sample(wo, u)`: both lobes
  template <class T>
  T pdf(const Vec3<T>& wo, const Vec3<T>& wi) const {
    return evaluate(wo, wi).pdf_w;
  }

  /// Lobe 0 is the coat, lobe 1 the base.
  static constexpr std::uint32_t lobe_count() { return 2; }

  template <class T>
  T lobe_probability(const Vec3<T>& wo, std::uint32_t lobe) const {
    const T coat = coat_probability(coat_albedo(wo.z));
    return lobe == 0 ? coat : T(T(1) - coat);
  }

  template <class T>
  std::optional<BsdfSample<T>> sample_lobe(const Vec3<T>& wo, std::uint32_t lobe,
                                           const Vec2<T>& u) const {
    // The base gets the numbers the other way round: what was rescaled to choose a lobe turns the
    // azimuth. As the height it would lose the digits that wi next to the horizon needs.
    auto result =
        lobe == 0 ? coat_.sample_with(reflectance_, wo, u) : base_.sample(wo, Vec2<T>{u.y, u.x});
    if (result) result->lobe = lobe;
    return result;
  }

  template <class T>
  T pdf_lobe(const Vec3<T>& wo, const Vec3<T>& wi, std::uint32_t lobe) const {
    return lobe == 0 ? coat_.pdf(wo, wi) : base_.pdf(wo, wi);
  }

 private:
  static constexpr int kNodes = 65;

  /// The coat's reflectance from outside, in the place of ConductorFresnel.
  struct Reflectance {
    BareInterface interface;

    template <class T>
    Rgb<T> operator()(const T& cosine) const {
      return to_rgb(interface.template split<T>(static_cast<Wide<T>>(cosine), true).reflected);
    }
  };

  /// Probability of the coat, by the light that each lobe gives back.
  template <class T>
  T coat_probability(const T& coat_albedo) const {
    return coat_albedo / (coat_albedo + (T(1) - coat_albedo) * mean(rgb_cast<T>(base_.albedo)));
  }

  /// E at a cosine, between nodes that are equally spaced in its root: E is steep at grazing.
  template <class T>
  T coat_albedo(const T& cosine) const {
    const T place = safe_sqrt(cosine) * T(kNodes - 1);
    const int below = std::clamp(static_cast<int>(place), 0, kNodes - 2);
    const auto node = static_cast<std::size_t>(below);
    const T part = place - T(below);
    return T(table_[node]) * (T(1) - part) + T(table_[node + 1]) * part;
  }

  /// Mean weight of the coat's samples over a grid of u; by symmetry over half of the azimuths, and
  /// with heights u.y = 1 − (1 − v)², because what u.y → 1 reflects is lost below the horizon.
  double integrate_albedo(double cosine) const {
    constexpr int kAzimuths = 24, kHeights = 48;
    const Vec3d wo{safe_sqrt((1 - cosine) * (1 + cosine)), 0, cosine};
    double sum = 0;
    for (int i = 0; i < kAzimuths; ++i) {
      for (int j = 0; j < kHeights; ++j) {
        const double rest = 1 - (j + 0.5) / kHeights;
        const Vec2<double> u{(i + 0.5) / (2 * kAzimuths), 1 - sqr(rest)};
        const auto sample = coat_.sample_with(reflectance_, wo, u);
        if (sample) sum += 2 * rest * sample->weight.r;
      }
    }
    return sum / (kAzimuths * kHeights);
  }

  /// Nodes, and the mean of what passes. A node is raised by the most that E exceeds the table by
  /// in the intervals beside it, so that no more is given to the base than the coat leaves.
  void tabulate() {
    const auto albedo_at = [this](double node) {
      return integrate_albedo(std::max(sqr(node / (kNodes - 1)), 1e-6));
    };
    for (std::size_t i = 0; i < kNodes; ++i) {
      table_[i] = static_cast<float>(albedo_at(static_cast<double>(i)));
    }
    constexpr float kGridError = 2.5e-4f;
    std::array<float, kNodes> raised = table_;
    for (std::size_t i = 0; i + 1 < kNodes; ++i) {
      const auto middle = static_cast<float>(albedo_at(static_cast<double>(i) + 0.5));
      const float excess = std::max(middle - (table_[i] + table_[i + 1]) / 2, 0.0f) + kGridError;
      for (const std::size_t node : {i, i + 1}) {
        raised[node] = std::min(std::max(raised[node], table_[node] + excess), 1.0f);
      }
    }
    table_ = raised;

    constexpr int kSteps = 4096;
    double let_in = 0;
    for (int i = 0; i < kSteps; ++i) {
      const double cosine = (i + 0.5) / kSteps;
      let_in += 2 * cosine * (1 - coat_albedo(cosine)) / kSteps;
    }
    mean_let_in_ = static_cast<float>(let_in);
  }

  GgxConductor coat_;  // lends its lobe; what that reflects is up to `reflectance_`
  Reflectance reflectance_;
  Lambertian base_;
  std::array<float, kNodes> table_{};
  float mean_let_in_ = 1;
};

}  // namespace plumbline::renderer
