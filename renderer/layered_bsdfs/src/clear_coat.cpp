#include <plumbline/renderer/layered_bsdfs/clear_coat.h>

#include <algorithm>
#include <array>

namespace plumbline::renderer {

/// Mean weight of the coat's samples over a grid of u; by symmetry over half of the azimuths, and
/// with heights u.y = 1 − (1 − v)², because what u.y → 1 reflects is lost below the horizon.
double ClearCoat::integrate_albedo(double cosine) const {
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
void ClearCoat::tabulate() {
  const auto albedo_at = [this](double node) {
    return integrate_albedo(std::max(sqr(sqr(node / (kNodes - 1))), 1e-6));
  };
  std::array<float, kNodes> nodes{};
  for (std::size_t i = 0; i < kNodes; ++i) {
    nodes[i] = static_cast<float>(albedo_at(static_cast<double>(i)));
  }
  constexpr float kGridError = 2.5e-4f;
  std::array<float, kNodes> raised = nodes;
  for (std::size_t i = 0; i + 1 < kNodes; ++i) {
    const auto middle = static_cast<float>(albedo_at(static_cast<double>(i) + 0.5));
    const float excess = std::max(middle - (nodes[i] + nodes[i + 1]) / 2, 0.0f) + kGridError;
    for (const std::size_t node : {i, i + 1}) {
      raised[node] = std::min(std::max(raised[node], nodes[node] + excess), 1.0f);
    }
  }
  for (std::size_t i = 0; i < kNodes; ++i) {
    const float coat = raised[i], base = (1 - coat) * mean(base_.albedo);
    table_[i] = {coat, coat / (coat + base)};
  }

  constexpr int kSteps = 4096;
  double let_in = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double cosine = (i + 0.5) / kSteps;
    let_in += 2 * cosine * (1 - coat_at(cosine).albedo) / kSteps;
  }
  share_scale_ = static_cast<float>(1 / let_in);
}

}  // namespace plumbline::renderer
