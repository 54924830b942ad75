#include <plumbline/renderer/adaptive/sample_counts.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <map>

namespace plumbline::renderer {
namespace {

constexpr int kPerOctave = 1024;
constexpr std::uint32_t kMostSamples = 1u << 30;

/// Standard deviation of a sample's luminance, where the channels of a path go together.
double deviation(const PixelMoments& pixel) {
  const Rgbd v = pixel.variance();
  return luminance(Rgbd{std::sqrt(v.r), std::sqrt(v.g), std::sqrt(v.b)});
}

/// A pixel beside another.
struct Neighbour {
  int dx, dy;
  double weight;  ///< exp(−d²/(2·0.8²)) at d pixels
};

std::vector<Neighbour> neighbours() {
  constexpr int kRadius = 2;
  constexpr double kWidth = 0.8;
  std::vector<Neighbour> all;
  for (int dy = -kRadius; dy <= kRadius; ++dy) {
    for (int dx = -kRadius; dx <= kRadius; ++dx) {
      if (dx == 0 && dy == 0) continue;
      all.push_back({dx, dy, std::exp(-(dx * dx + dy * dy) / (2 * kWidth * kWidth))});
    }
  }
  return all;
}

/// What the pixels around one have, weighted.
class Neighbourhood {
 public:
  void add(double weight, double deviation, double mean) {
    weights_ += weight;
    deviations_ += weight * deviation;
    means_ += weight * mean;
    squares_ += weight * mean * mean;
  }

  /// (σ² + variance of the means)/(m² + 0.01); 0 without pixels.
  double relative_variance() const {
    if (!(weights_ > 0)) return 0;
    const double deviation = deviations_ / weights_, mean = means_ / weights_;
    const double between = std::max(squares_ / weights_ - mean * mean, 0.0);
    return (deviation * deviation + between) / (mean * mean + 0.01);
  }

 private:
  double weights_ = 0, deviations_ = 0, means_ = 0, squares_ = 0;
};

SampleNeed need_of(double relative_variance) {
  constexpr double kLimit = std::numeric_limits<SampleNeed>::max();
  // n ∝ σ, the root of the variance. Of 0 it is −∞; numbers beyond a double's are NaN here.
  const double need = std::round(kPerOctave * 0.5 * std::log2(relative_variance));
  return static_cast<SampleNeed>(need < kLimit ? std::max(need, -kLimit) : kLimit);
}

}  // namespace

std::vector<SampleNeed> needs_from_neighbours(const Film& pilot) {
  const std::vector<Neighbour> beside = neighbours();
  std::vector<double> deviations, means;
  for (const PixelMoments& pixel : pilot.pixels()) {
    deviations.push_back(deviation(pixel));
    means.push_back(luminance(pixel.mean));
  }
  std::vector<SampleNeed> needs;
  needs.reserve(means.size());
  for (int y = 0; y < pilot.height(); ++y) {
    for (int x = 0; x < pilot.width(); ++x) {
      Neighbourhood around;
      for (const Neighbour& n : beside) {
        const int u = x + n.dx, v = y + n.dy;
        if (u < 0 || u >= pilot.width() || v < 0 || v >= pilot.height()) continue;
        const std::size_t i = pilot.index(u, v);
        around.add(n.weight, deviations[i], means[i]);
      }
      needs.push_back(need_of(around.relative_variance()));
    }
  }
  return needs;
}

SampleCounts::SampleCounts(std::vector<SampleNeed> needs, std::uint32_t pilot)
    : needs_(std::move(needs)), pilot_(pilot) {
  std::map<SampleNeed, std::uint64_t> pixels_of;
  for (const SampleNeed need : needs_) ++pixels_of[need];
  pixels_of_.assign(pixels_of.begin(), pixels_of.end());
}

std::uint32_t SampleCounts::of_need(SampleNeed need) const {
  const int most = std::countr_zero(std::bit_floor(std::max(kMostSamples / pilot_, 1u)));
  const int octaves = std::clamp((scale_ + need) / kPerOctave, 0, most);
  return pilot_ << octaves;
}

std::uint64_t SampleCounts::total() const {
  std::uint64_t sum = 0;
  for (const auto& [need, pixels] : pixels_of_) sum += pixels * of_need(need);
  return sum;
}

void SampleCounts::set_level(std::uint32_t level) {
  level_ = level;
  const std::uint64_t most = std::uint64_t{level} * needs_.size();
  // The largest scale at which they are not too many; at the lower end all have the pilot, at the
  // upper one the most.
  int low = -std::numeric_limits<SampleNeed>::max();
  int high = std::numeric_limits<SampleNeed>::max() + 32 * kPerOctave;
  while (high - low > 1) {
    scale_ = low + (high - low) / 2;
    (total() <= most ? low : high) = scale_;
  }
  scale_ = low;
}

}  // namespace plumbline::renderer
