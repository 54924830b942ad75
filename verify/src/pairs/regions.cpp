#include "pairs/regions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace plumbline::verify {

namespace {

// Samples of a cell that say whether they lie to one side.
constexpr std::size_t kEnoughToHalve = 12;
// Unevenness that counts, in standard deviations of the difference of two even halves.
constexpr double kUneven = 2;
// Samples in one place would be halved for ever.
constexpr int kMostHalvings = 40;
// Of points that are even over the square, wherever samples lie: a sampler that misses a part is to
// be seen there.
constexpr double kEvenShare = 0.2;

bool lies_within(const Box& box, const Point2& p) {
  return p[0] >= box.low[0] && p[0] <= box.high[0] && p[1] >= box.low[1] && p[1] <= box.high[1];
}

double middle_of(const Box& box, std::size_t d) { return (box.low[d] + box.high[d]) / 2; }

}  // namespace

Regions::Regions(const Domain& domain, const std::vector<Vec3>& pilot, int depth)
    : domain_(domain),
      pilot_(in_square(domain, pilot)),
      tree_(pilot_, kFineDepth, domain.dimension(), 0x1p-53),
      depth_(std::min(depth, kFineDepth)),
      first_piece_(tree_.bins() + 1) {
  for (const Cell& cell : tree_.cells(domain.breaks())) {
    pieces_.push_back({cell.box, cell.bin});
    ++first_piece_[cell.bin + 1];
  }
  for (std::size_t bin = 0; bin < tree_.bins(); ++bin) first_piece_[bin + 1] += first_piece_[bin];
  std::vector<std::vector<Point2>> samples(pieces_.size());
  for (const Point2& p : pilot_) samples[root_of(p)].push_back(p);
  for (std::size_t i = 0; i < samples.size(); ++i) halve(i, samples[i], 0);
  choose_probabilities();
}

void Regions::halve(std::size_t at, const std::vector<Point2>& samples, int depth) {
  const auto n = static_cast<double>(samples.size());
  pieces_[at].samples = n;
  std::array<double, 2> uneven{};
  for (const Point2& p : samples) {
    for (std::size_t d = 0; d < 2; ++d) {
      uneven[d] += p[d] < middle_of(pieces_[at].box, d) ? -1 : 1;
    }
  }
  const std::size_t cut =
      domain_.dimension() == 2 && std::abs(uneven[1]) > std::abs(uneven[0]) ? 1 : 0;
  if (samples.size() < kEnoughToHalve || depth == kMostHalvings ||
      std::abs(uneven[cut]) < kUneven * std::sqrt(n)) {
    return;
  }
  Piece low{pieces_[at].box, pieces_[at].bin}, high = low;
  const double middle = middle_of(low.box, cut);
  low.box.high[cut] = high.box.low[cut] = middle;
  std::vector<Point2> below, above;
  for (const Point2& p : samples) (p[cut] < middle ? below : above).push_back(p);
  const std::size_t halves = pieces_.size();
  pieces_[at].cut = cut;
  pieces_[at].halves = halves;
  pieces_.push_back(low);
  pieces_.push_back(high);
  halve(halves, below, depth + 1);
  halve(halves + 1, above, depth + 1);
}

void Regions::choose_probabilities() {
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    if (pieces_[i].halves == 0) leaves_.push_back(i);
  }
  // Half a sample more in each: where none was seen may be some.
  const double all = static_cast<double>(pilot_.size()) + 0.5 * static_cast<double>(leaves_.size());
  double sum = 0;
  for (const std::size_t leaf : leaves_) {
    Piece& piece = pieces_[leaf];
    piece.probability =
        (1 - kEvenShare) * (piece.samples + 0.5) / all + kEvenShare * piece.box.area();
    piece.up_to = sum += piece.probability;
  }
}

std::vector<Point2> Regions::in_square(const Domain& domain, const std::vector<Vec3>& pilot) {
  if (domain.size() > 0) throw std::invalid_argument("a discrete domain has no regions");
  std::vector<Point2> points;
  points.reserve(pilot.size());
  for (const Vec3& x : pilot) points.push_back(domain.chart().to_square(x));
  return points;
}

std::size_t Regions::root_of(const Point2& p) const {
  const std::size_t bin = tree_.locate(p);
  std::size_t piece = first_piece_[bin];
  while (piece + 1 < first_piece_[bin + 1] && !lies_within(pieces_[piece].box, p)) ++piece;
  return piece;
}

std::size_t Regions::leaf_of(const Point2& p) const {
  std::size_t piece = root_of(p);
  while (pieces_[piece].halves != 0) {
    const std::size_t cut = pieces_[piece].cut;
    const bool low = p[cut] < middle_of(pieces_[piece].box, cut);
    piece = pieces_[piece].halves + (low ? 0 : 1);
  }
  return piece;
}

std::size_t Regions::locate(const Vec3& x) const {
  return tree_.locate(domain_.chart().to_square(x)) >> (kFineDepth - depth_);
}

Vec3 Regions::center(std::size_t region) const {
  const std::size_t first = region << (kFineDepth - depth_);
  const std::size_t last = first + (std::size_t{1} << (kFineDepth - depth_)) - 1;
  Point2 middle{};
  for (std::size_t d = 0; d < 2; ++d) {
    middle[d] = (tree_.box(first).low[d] + tree_.box(last).high[d]) / 2;
  }
  return domain_.chart().from_square(middle);
}

Regions::Point Regions::draw(Random& random) const {
  const auto chosen =
      std::upper_bound(leaves_.begin(), leaves_.end() - 1, random.uniform(),
                       [this](double u, std::size_t leaf) { return u < pieces_[leaf].up_to; });
  const Piece& piece = pieces_[*chosen];
  Point2 p{};
  for (std::size_t d = 0; d < 2; ++d) {
    p[d] = piece.box.low[d] + (piece.box.high[d] - piece.box.low[d]) * random.uniform();
  }
  return {domain_.chart().from_square(p),
          piece.box.area() * domain_.chart().element(p) / piece.probability,
          piece.bin >> (kFineDepth - depth_)};
}

double Regions::inverse_density(const Vec3& x) const {
  const Point2 p = domain_.chart().to_square(x);
  const Piece& piece = pieces_[leaf_of(p)];
  return piece.box.area() * domain_.chart().element(p) / piece.probability;
}

}  // namespace plumbline::verify
