#include <gtest/gtest.h>
#include <plumbline_tests/directions.h>
#include <plumbline_tests/support.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>

#include <plumbline/analytic/bsdf_albedo.h>
#include <plumbline/analytic/fresnel.h>
#include "examples.h"

/// Lobes are chosen with the probability that lets samples vary least, or with their share of the
/// light: by value, from formulas of analytic/ or of this file. A probability that is only kept to
/// costs variance, and no test of means or densities sees it.
namespace plumbline::tests {
namespace {

using namespace renderer;

/// Probability of the first lobe, or of the first child of a mixture, within which it must be.
struct Range {
  double low, high;
};

Range around(double value, double tolerance) { return {value - tolerance, value + tolerance}; }

/// Smith's G1 of GGX. @source Heitz 2014 (JCGT 3:2), Eqs. 43 and 72
double masking_of(const Ggx& ggx, const Vec3d& w) {
  const double slope = (sqr(double{ggx.alpha_x} * w.x) + sqr(double{ggx.alpha_y} * w.y)) / sqr(w.z);
  return 2 / (1 + std::sqrt(1 + slope));
}

/// Mean squares of the weights F G1(wi) and (1 − F) G1(wi) over the normals that wo sees.
struct MeanSquares {
  double reflected = 0, refracted = 0, normals = 0;

  /// @param eta  of the other side over that of wo
  void add(const Ggx& ggx, const Vec3d& wo, const Vec3d& normal, double eta) {
    const double cosine = dot(wo, normal);
    if (!(cosine > 0)) return;
    const double seen = cosine / normal.z;
    normals += seen;
    const double f = analytic::interface_reflectance(cosine, 1, eta);
    const Vec3d mirrored = normal * (2 * cosine) - wo;
    if (mirrored.z > 0) reflected += seen * sqr(f * masking_of(ggx, mirrored));
    const double inside = 1 - (1 - sqr(cosine)) / sqr(eta);
    if (!(inside > 0)) return;
    const Vec3d bent = normal * (cosine / eta - std::sqrt(inside)) - wo / eta;
    if (bent.z < 0) refracted += seen * sqr((1 - f) * masking_of(ggx, bent));
  }
};

/// p m_1 + (1 − p) m_2 divided through by p and 1 − p is least where p : 1 − p = √m_1 : √m_2.
///
/// Normals are taken where their slopes are equally likely, not by what is seen of them, and each
/// counts as it is seen; over a quarter of the azimuths, as a table over cosθ knows no azimuth.
double best_reflection_probability(const GgxDielectric& b, double cosine, bool front) {
  constexpr int kGrid = 40, kAzimuths = 8;
  const double eta = front ? double{b.interface.eta} : 1 / double{b.interface.eta};
  MeanSquares squares;
  for (int azimuth = 0; azimuth < kAzimuths; ++azimuth) {
    const double phi = (azimuth + 0.5) / kAzimuths * pi<double>() / 2,
                 sine = safe_sqrt(1 - sqr(cosine));
    const Vec3d wo{sine * std::cos(phi), sine * std::sin(phi), cosine};
    for (int i = 0; i < kGrid * kGrid; ++i) {
      const double u = (i % kGrid + 0.5) / kGrid,
                   turn = 2 * pi<double>() * (i / kGrid + 0.5) / kGrid;
      const double slope = std::sqrt(u / (1 - u));
      squares.add(b.ggx, wo,
                  normalize(Vec3d{double{b.ggx.alpha_x} * slope * std::cos(turn),
                                  double{b.ggx.alpha_y} * slope * std::sin(turn), 1}),
                  eta);
    }
  }
  const double r = std::sqrt(squares.reflected), t = std::sqrt(squares.refracted);
  return r / (r + t);
}

/// The choice of each alternative of the variant that makes one.
struct StatedChoice {
  const BsdfSet& set;
  double cosine;  // |cosθ| of wo
  bool front;

  std::optional<Range> of(std::uint32_t index) const {
    return std::visit(*this, set.alternative(index));
  }

  std::optional<Range> operator()(const Lambertian&) const { return std::nullopt; }
  std::optional<Range> operator()(const ModifiedPhong&) const { return std::nullopt; }
  std::optional<Range> operator()(const GgxConductor&) const { return std::nullopt; }
  std::optional<Range> operator()(const SmoothConductor&) const { return std::nullopt; }
  /// Has the choices of its sides, and they are held there.
  std::optional<Range> operator()(const TwoSided&) const { return std::nullopt; }

  /// Neither lobe less than one sample in twenty: some normals reflect where next to none do. A
  /// probability p in the place of the best one, b, costs (p − b)²/(p (1 − p)) of the mean square:
  /// here up to 5.4 %, since 65 nodes of 64 normals each miss the kink at the critical angle. 10 %
  /// is the limit.
  std::optional<Range> operator()(const GgxDielectric& b) const {
    const double best = std::clamp(best_reflection_probability(b, cosine, front), 0.05, 0.95);
    const double most = 0.1, middle = best + most / 2;
    const double half = std::sqrt(sqr(middle) - (1 + most) * sqr(best));
    return Range{(middle - half) / (1 + most), (middle + half) / (1 + most)};
  }

  std::optional<Range> operator()(const SmoothDielectric& b) const {
    const double eta = double{b.interface.eta};
    return around(front ? analytic::interface_reflectance(cosine, 1, eta)
                        : analytic::interface_reflectance(cosine, eta, 1),
                  1e-6);
  }

  /// The coat's table lies above its albedo by up to 3e-3, so that base and coat give no more than
  /// they get.
  std::optional<Range> operator()(const ClearCoat& b) const {
    if (!front) return std::nullopt;
    const auto share = [&](double coat) {
      return coat / (coat + (1 - coat) * double{mean(b.base_albedo())});
    };
    const double coat = analytic::clear_coat_albedo(double{b.eta()}, double{b.alpha()}, 0, cosine);
    return Range{share(coat) - 1e-6, share(coat + 3e-3) + 1e-6};
  }

  /// Polished glass by what the film makes of it, channels alike; rough glass as without the film.
  std::optional<Range> operator()(const ThinFilm& b) const {
    if (const auto* rough = std::get_if<GgxDielectric>(&b.base())) return (*this)(*rough);
    const auto* glass = std::get_if<SmoothDielectric>(&b.base());
    if (glass == nullptr) return std::nullopt;
    constexpr std::array<double, 4> kEdges{700, 590, 490, 400};  // [nm]
    const double eta = double{glass->interface.eta};
    double sum = 0;
    for (std::size_t channel = 0; channel < 3; ++channel) {
      sum += analytic::film_band_reflectance(cosine, front ? 1 : eta, double{b.film().eta},
                                             front ? eta : 1, double{b.film().thickness},
                                             kEdges[channel + 1], kEdges[channel]);
    }
    return around(sum / 3, 2e-5);  // tables in float are good to 1e-5 each way
  }

  std::optional<Range> operator()(const Mixture& b) const {
    return around(1 - double{b.weight}, 1e-6);
  }
};

/// How many lobes the choice gives to its first side.
std::uint32_t lobes_of_first(const Example& example) {
  const auto& bsdf = example.set->alternative(static_cast<std::uint32_t>(example.set->size()) - 1);
  const auto* mixture = std::get_if<Mixture>(&bsdf);
  return mixture == nullptr ? 1 : (*example.set)[mixture->first].lobe_count();
}

/// How many samples with u.x are of the first side, and of the other.
std::array<int, 2> chosen(const Example& example, const Vec3f& wo, float x) {
  std::array<int, 2> counts{};
  for (int i = 0; i < 32; ++i) {
    const auto s = example.bsdf.sample(wo, Vec2f{x, (static_cast<float>(i) + 0.5f) / 32});
    if (s) ++counts[s->lobe < lobes_of_first(example) ? 0 : 1];
  }
  return counts;
}

template <class B>
class LobeChoice : public testing::Test {};

TYPED_TEST_SUITE(LobeChoice, BsdfTypes, );

TYPED_TEST(LobeChoice, IsMadeWithItsStatedProbability) {
  for (const Example& example : examples_of<TypeParam>()) {
    const auto last = static_cast<std::uint32_t>(example.set->size() - 1);
    for (const double cosine : {0.07, 0.2, 0.37, 0.55, 0.72, 0.9, 0.99}) {
      for (const bool front : {true, false}) {
        const auto stated = StatedChoice{*example.set, cosine, front}.of(last);
        if (!stated || example.gives.of(front) == Gives::nothing) continue;
        const Vec3f wo =
            vec_cast<float>(Vec3d{std::sqrt(1 - sqr(cosine)), 0, front ? cosine : -cosine});
        float p = 0;
        for (std::uint32_t lobe = 0; lobe < lobes_of_first(example); ++lobe) {
          p += example.bsdf.template lobe_probability<float>(wo, lobe);
        }
        const std::string place =
            example.name + (front ? " front " : " back ") + std::to_string(cosine);
        EXPECT_GE(double{p}, stated->low) << place;
        EXPECT_LE(double{p}, stated->high) << place;
        EXPECT_TRUE(p <= 0 || chosen(example, wo, p * (1 - 1e-5f))[1] == 0) << place;
        EXPECT_TRUE(p >= 1 || chosen(example, wo, p + (1 - p) * 1e-5f)[0] == 0) << place;
      }
    }
  }
}

TYPED_TEST(LobeChoice, ProbabilitiesOfAllLobesSumToOne) {
  for (const Example& example : examples_of<TypeParam>()) {
    for (const float z : {-1.0f, -0.9f, -0.4f, -0.01f, 0.01f, 0.4f, 0.9f, 1.0f}) {
      if (example.gives.of(z > 0) == Gives::nothing) continue;
      const Vec3f wo{std::sqrt((1 - z) * (1 + z)), 0, z};
      float sum = 0;
      for (std::uint32_t lobe = 0; lobe < example.bsdf.lobe_count(); ++lobe) {
        sum += example.bsdf.template lobe_probability<float>(wo, lobe);
      }
      EXPECT_NEAR(sum, 1, 4e-7f) << example.name << " cosθo " << z;
    }
  }
}

}  // namespace
}  // namespace plumbline::tests
