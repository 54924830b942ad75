#include "pairs/regions.h"

#include <algorithm>
#include <stdexcept>

namespace plumbline::verify {

namespace {

bool lies_within(const Box& box, const Point2& p) {
  return p[0] >= box.low[0] && p[0] <= box.high[0] && p[1] >= box.low[1] && p[1] <= box.high[1];
}

}  // namespace

Regions::Regions(const Domain& domain, const std::vector<Vec3>& pilot, int depth)
    : domain_(domain),
      pilot_(in_square(domain, pilot)),
      tree_(pilot_, kFineDepth, domain.dimension()),
      depth_(std::min(depth, kFineDepth)),
      first_piece_(tree_.bins() + 1) {
  for (const Cell& cell : tree_.cells(domain.breaks())) {
    pieces_.push_back({cell.box, cell.bin});
    ++first_piece_[cell.bin + 1];
  }
  for (std::size_t bin = 0; bin < tree_.bins(); ++bin) first_piece_[bin + 1] += first_piece_[bin];
  // One more than have been seen in each: no piece is never looked at.
  const double all = static_cast<double>(pilot_.size() + pieces_.size());
  for (Piece& piece : pieces_) piece.probability = 1 / all;
  for (const Point2& p : pilot_) pieces_[piece_of(p)].probability += 1 / all;
  double sum = 0;
  for (Piece& piece : pieces_) piece.up_to = sum += piece.probability;
}

std::vector<Point2> Regions::in_square(const Domain& domain, const std::vector<Vec3>& pilot) {
  if (domain.size() > 0) throw std::invalid_argument("a discrete domain has no regions");
  std::vector<Point2> points;
  points.reserve(pilot.size());
  for (const Vec3& x : pilot) points.push_back(domain.chart().to_square(x));
  return points;
}

std::size_t Regions::piece_of(const Point2& p) const {
  const std::size_t bin = tree_.locate(p);
  std::size_t piece = first_piece_[bin];
  while (piece + 1 < first_piece_[bin + 1] && !lies_within(pieces_[piece].box, p)) ++piece;
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
      std::upper_bound(pieces_.begin(), pieces_.end() - 1, random.uniform(),
                       [](double u, const Piece& piece) { return u < piece.up_to; });
  const Box& box = chosen->box;
  Point2 p{};
  for (std::size_t d = 0; d < 2; ++d) {
    p[d] = box.low[d] + (box.high[d] - box.low[d]) * random.uniform();
  }
  return {domain_.chart().from_square(p),
          box.area() * domain_.chart().element(p) / chosen->probability,
          chosen->bin >> (kFineDepth - depth_)};
}

double Regions::inverse_density(const Vec3& x) const {
  const Point2 p = domain_.chart().to_square(x);
  const Piece& piece = pieces_[piece_of(p)];
  return piece.box.area() * domain_.chart().element(p) / piece.probability;
}

}  // namespace plumbline::verify
