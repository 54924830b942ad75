#include "pairs/tree_cell.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace plumbline::verify {

PilotsOfBins::PilotsOfBins(const std::vector<PilotPoint>& points,
                           const std::vector<std::size_t>& bins, std::size_t count_of_bins)
    : points_(points.size()), first_(count_of_bins + 1) {
  for (const std::size_t bin : bins) ++first_[bin + 1];
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
  for (std::size_t i = 0; i < points.size(); ++i) points_[next[bins[i]]++] = points[i];
}

void TreeCell::choose_cut(std::span<const PilotPoint> inside, int dimension,
                          const NodesInRound& nodes) {
  const double area = box.area();
  const double at_nodes = area * fit.tail();
  double squares = 0;
  Point2 low = box.high, high = box.low;
  for (const PilotPoint& s : inside) {
    const double off = (s.value - fit.at(s.p)) * nodes.weight(kNodesPerCell / area, s.density);
    squares += off * off;
    for (std::size_t d = 0; d < 2; ++d) {
      low[d] = std::min(low[d], s.p[d]);
      high[d] = std::max(high[d], s.p[d]);
    }
  }
  const double at_points = std::sqrt(squares);
  key = std::max(at_nodes, at_points);
  cut = fit.rough_dimension();
  if (at_points > at_nodes) {
    // What the nodes do not see lies where the points are: halve where they crowd.
    const auto crowding = [&](std::size_t d) {
      return (high[d] - low[d]) / (box.high[d] - box.low[d]);
    };
    if (std::abs(crowding(0) - crowding(1)) > 0.1) cut = crowding(0) < crowding(1) ? 0 : 1;
  }
  if (dimension == 1) cut = 0;
  at = (box.low[cut] + box.high[cut]) / 2;
  const double size = box.high[cut] - box.low[cut];
  const double least = 0x1p-48 * std::max(std::abs(at), 0x1p-200);
  if (!(size > least)) at = box.low[cut];  // too narrow to halve
}

}  // namespace plumbline::verify
