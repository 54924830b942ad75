#include <plumbline/renderer/core/bsdf/ggx_dielectric.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace plumbline::renderer {

GgxDielectric::GgxDielectric(const Ggx& distribution, const BareInterface& bare)
    : ggx(distribution), interface(bare) {
  for (const bool outside : {false, true}) {
    for (std::size_t i = 0; i < kNodes; ++i) {
      const double guess = reflection_probability(static_cast<double>(i) / (kNodes - 1), outside);
      reflects_[outside ? 1 : 0][i] =
          std::clamp(static_cast<float>(guess), kLeastProbability, 1 - kLeastProbability);
    }
  }
}

/// Probability of reflection that lets the weights vary least: by the mean squares of both lobes'
/// own, over the azimuths of wo too.
double GgxDielectric::reflection_probability(double cosine, bool outside) const {
  constexpr int kAzimuths = 4, kGrid = 8;
  std::array<double, 2> squares{};
  for (int i = 0; i < kAzimuths * kGrid * kGrid; ++i) {
    const auto phi = sin_cos_turns((i % kAzimuths + 0.5) / (4 * kAzimuths));
    const double sine = safe_sqrt(1 - sqr(cosine)), z = std::max(cosine, 1e-6);
    const int cell = i / kAzimuths, column = cell % kGrid, row = cell / kGrid;
    const Vec2<double> u{(column + 0.5) / kGrid, (row + 0.5) / kGrid};
    for (const std::uint32_t lobe : {0u, 1u}) {
      const auto sample =
          sample_lobe(Vec3d{sine * phi.cos, sine * phi.sin, outside ? z : -z}, lobe, u);
      if (sample) squares[lobe] += sqr(sample->weight.g / sample->radiance_scale);
    }
  }
  return squares[0] > 0 ? 1 / (1 + std::sqrt(squares[1] / squares[0])) : 0;
}

}  // namespace plumbline::renderer
