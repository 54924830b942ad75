#include "pairs/mass_integral.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include "bernstein.h"
#include "streams.h"

namespace plumbline::verify {
namespace {

// What a cell's uniform nodes are at least, and as if while cells are made.
constexpr double kNodesPerCell = 1;
constexpr int kMaxRounds = 6;
constexpr double kWorthwhile = 0.9;
constexpr int kMostWithoutGain = 2;
// The highest degree of a fit is several times what a smooth function leaves beyond it. What nodes
// have measured needs no hope.
constexpr double kHope = 4;
// At which it is decided whether the target is reached.
constexpr double kPassLevel = 1e-3;
// Nodes that add more than this share of the target show something that the cells have missed.
constexpr double kSurprise = 0.02;
constexpr std::size_t kMostSurprises = 20'000;

struct PilotPoint {
  Point2 p{};
  double density = 0, value = 0;
};

/// A cell, halved or not.
struct TreeCell {
  Box box;
  std::size_t bin;
  CellFit fit;
  std::size_t first = 0, last = 0;  // of the pilot points inside
  double key = 0;                   // standard deviation that it is expected to add
  double measured = 0;              // the same, squared, as nodes have shown it
  std::size_t halves = 0;           // index of the lower half, 0: a leaf
  std::size_t cut = 0;              // dimension, and where
  double at = 0;
};

class Integrator {
 public:
  Integrator(const MassQuestion& question, const std::vector<Cell>& cells)
      : q_(question),
        own_(question.own),
        nodes_(question.spread),
        random_(random_for(question.seed, Stream::nodes)),
        roots_of_bin_(question.bins) {
    std::vector<std::vector<PilotPoint>> of_bin(q_.bins);
    for (const PilotPoint& s : draw_pilot()) of_bin[bin_at(s.p)].push_back(s);
    std::vector<std::vector<Box>> boxes_of_bin(q_.bins);
    for (const Cell& cell : cells) {
      if (cell.box.area() > 0) boxes_of_bin[cell.bin].push_back(cell.box);
    }
    for (std::size_t bin = 0; bin < q_.bins; ++bin) {
      for (const Box& box : boxes_of_bin[bin]) {
        const std::size_t first = pilot_.size();
        for (const PilotPoint& s : of_bin[bin]) {
          if (contains(box, s.p)) pilot_.push_back(s);
        }
        roots_of_bin_[bin].push_back(cells_.size());
        add(box, bin, first, pilot_.size());
      }
    }
  }

  MassIntegral run() {
    MassIntegral result;
    double before = std::numeric_limits<double>::infinity();
    int without_gain = 0;
    for (int round = 0; round < kMaxRounds; ++round) {
      // What no cells resolve has to be averaged out: a lobe along a thin curve by own samples, a
      // jump along a curve by nodes in its cells.
      if (round > 0) {
        const double of_own = own_variance_ / result.variance_of_total;
        if (of_own > 0.25) own_ = std::min<std::size_t>(4 * own_, q_.max_evaluations / 4);
        if (of_own < 0.75) nodes_ = std::min<std::size_t>(4 * nodes_, q_.max_evaluations / 4);
      }
      // The last rounds may spend what the first have left.
      refine(q_.max_evaluations * static_cast<std::uint64_t>(round + 2) / (kMaxRounds + 1),
             round == 0 ? kHope : 1);
      result = correct();
      const double error = result.error(kPassLevel);
      // Cells that no longer show what they are off by would cost more rounds than they are worth,
      // as would a target that four times the nodes in each round do not reach.
      const int hopeful_rounds = std::min(2, kMaxRounds - 1 - round);
      const bool within_reach = std::ldexp(error, -hopeful_rounds) <= q_.target;
      without_gain = error < kWorthwhile * before ? 0 : without_gain + 1;
      const bool worthwhile = error > q_.target && without_gain < kMostWithoutGain &&
                              (within_reach || error > q_.good_enough);
      if (!worthwhile || !result.finite || evaluations_ >= q_.max_evaluations) break;
      before = error;
      learn();
    }
    result.evaluations = evaluations_;
    return result;
  }

 private:
  static bool contains(const Box& box, const Point2& p) {
    const auto within = [&](std::size_t d) {
      return p[d] >= box.low[d] && (p[d] < box.high[d] || box.high[d] == 1);
    };
    return within(0) && within(1);
  }

  std::size_t bin_at(const Point2& p) const { return q_.bin_at ? q_.bin_at(p) : 0; }

  double value_at(const Point2& p) {
    ++evaluations_;
    const double value = q_.integrand(p);
    if (std::isfinite(value)) return value;
    finite_ = false;
    return 0;
  }

  double density_at(const Point2& p, double value) const {
    if (!q_.draw_own) return 0;
    const double density = q_.density ? q_.density(p) : value;
    return std::isfinite(density) && density > 0 ? density : 0;
  }

  std::vector<PilotPoint> draw_pilot() {
    std::vector<PilotPoint> pilot;
    if (!q_.draw_own) return pilot;
    for (const Point2& p : q_.draw_own(q_.own)) {
      PilotPoint s{p, 0, value_at(p)};
      s.density = density_at(p, s.value);
      pilot.push_back(s);
    }
    return pilot;
  }

  void add(const Box& box, std::size_t bin, std::size_t first, std::size_t last) {
    TreeCell cell{box, bin, CellFit(q_.integrand, box, q_.dimension), first, last};
    evaluations_ += static_cast<std::uint64_t>(CellFit::kEvaluations[q_.dimension - 1]);
    finite_ = finite_ && cell.fit.finite();
    choose_cut(cell);
    cells_.push_back(cell);
    enqueue(cells_.size() - 1);
  }

  double weight(double node_density, double own_density) const {
    return 1 / (node_density + static_cast<double>(q_.spread) +
                static_cast<double>(own_) * own_density);
  }

  /// What the cell is expected to add to the error, from the nodes of its fit and from the pilot
  /// points in it, and how to halve it.
  void choose_cut(TreeCell& cell) const {
    const double area = cell.box.area();
    const double at_nodes = area * cell.fit.tail();
    double at_points = 0;
    Point2 low = cell.box.high, high = cell.box.low;
    for (std::size_t i = cell.first; i < cell.last; ++i) {
      const PilotPoint& s = pilot_[i];
      const double off = (s.value - cell.fit.at(s.p)) * weight(kNodesPerCell / area, s.density);
      at_points += off * off;
      for (std::size_t d = 0; d < 2; ++d) {
        low[d] = std::min(low[d], s.p[d]);
        high[d] = std::max(high[d], s.p[d]);
      }
    }
    cell.key = std::max(at_nodes, std::sqrt(at_points));
    cell.cut = cell.fit.rough_dimension();
    if (std::sqrt(at_points) > at_nodes) {
      // What the nodes do not see lies where the points are: halve where they crowd.
      const auto crowding = [&](std::size_t d) {
        return (high[d] - low[d]) / (cell.box.high[d] - cell.box.low[d]);
      };
      if (std::abs(crowding(0) - crowding(1)) > 0.1) cell.cut = crowding(0) < crowding(1) ? 0 : 1;
    }
    if (q_.dimension == 1) cell.cut = 0;
    cell.at = (cell.box.low[cell.cut] + cell.box.high[cell.cut]) / 2;
    const double size = cell.box.high[cell.cut] - cell.box.low[cell.cut];
    const double least = 0x1p-48 * std::max(std::abs(cell.at), 0x1p-200);
    if (!(size > least)) cell.at = cell.box.low[cell.cut];  // too narrow to halve
  }

  static bool can_be_halved(const TreeCell& cell) {
    return cell.at > cell.box.low[cell.cut] && cell.at < cell.box.high[cell.cut];
  }

  void enqueue(std::size_t index) {
    const TreeCell& cell = cells_[index];
    sum_of_squares_ += cell.key * cell.key;
    if (can_be_halved(cell) && cell.key > 0) queue_.push({cell.key, index});
  }

  void refine(std::uint64_t until, double hope) {
    const double reserved = static_cast<double>(own_ + nodes_ + q_.spread);
    const auto spent = [&] { return static_cast<double>(evaluations_) + reserved; };
    while (!queue_.empty() && spent() < static_cast<double>(until)) {
      const auto [key, index] = queue_.top();
      const double expected = bernstein(std::max(0.0, sum_of_squares_), key, kPassLevel);
      if (!(expected > hope * q_.target)) break;
      queue_.pop();
      if (cells_[index].halves != 0 || key != cells_[index].key) continue;  // not of this state
      halve(index);
    }
    sum_of_squares_ = 0;  // again, without the rounding of all the updates
    for (const TreeCell& cell : cells_) {
      if (cell.halves == 0) sum_of_squares_ += cell.key * cell.key;
    }
  }

  void halve(std::size_t index) {
    const TreeCell cell = cells_[index];
    sum_of_squares_ -= cell.key * cell.key;
    Box low = cell.box, high = cell.box;
    low.high[cell.cut] = high.low[cell.cut] = cell.at;
    const auto at = [&](std::size_t i) { return pilot_.begin() + static_cast<std::ptrdiff_t>(i); };
    const auto middle = std::partition(at(cell.first), at(cell.last), [&](const PilotPoint& s) {
      return s.p[cell.cut] < cell.at;
    });
    const auto border = static_cast<std::size_t>(middle - pilot_.begin());
    cells_[index].halves = cells_.size();
    add(low, cell.bin, cell.first, border);
    add(high, cell.bin, border, cell.last);
  }

  /// The leaf that holds a point; none where rounding put it beside all.
  TreeCell* leaf_at(const Point2& p) {
    for (const std::size_t root : roots_of_bin_[bin_at(p)]) {
      if (!contains(cells_[root].box, p)) continue;
      TreeCell* cell = &cells_[root];
      while (cell->halves != 0) cell = &cells_[cell->halves + (p[cell->cut] < cell->at ? 0 : 1)];
      return cell;
    }
    return nullptr;
  }

  /// One round of random nodes on the cells as they are.
  MassIntegral correct() {
    result_ = {};
    own_variance_ = 0;
    surprises_.clear();
    result_.value.assign(q_.bins, 0.0);
    result_.variance.assign(q_.bins, 0.0);
    keys_ = 0;
    for (TreeCell& cell : cells_) {
      cell.measured = 0;
      if (cell.halves != 0) continue;
      keys_ += cell.key;
      ++result_.cells;
    }
    const auto cells = static_cast<double>(result_.cells);
    nodes_to_share_ = std::max(static_cast<double>(nodes_) / 2, cells);
    nodes_everywhere_ =
        std::max(kNodesPerCell, std::floor(static_cast<double>(nodes_) / 2 / cells));
    for (TreeCell& cell : cells_) {
      if (cell.halves == 0) add_fit_and_nodes(cell);
    }
    add_spread_nodes();
    add_own_nodes();
    for (std::size_t b = 0; b < q_.bins; ++b) {
      result_.total += result_.value[b];
      result_.variance_of_total += result_.variance[b];
    }
    // The few nodes of a single bin may miss a jump that those of all bins together show.
    for (const TreeCell& cell : cells_) {
      if (cell.halves != 0) continue;
      result_.variance[cell.bin] += std::max(0.0, std::pow(cell.key / kHope, 2) - cell.measured);
    }
    result_.finite = finite_;
    result_.unseen = std::log(1 / kPassLevel) / static_cast<double>(q_.spread);
    return result_;
  }

  /// Uniform nodes of a cell: some in any case, the others in proportion to what it is expected to
  /// add to the error, which may be more than has been seen.
  double nodes_of(const TreeCell& cell) const {
    const double share = keys_ > 0 ? cell.key / keys_ : 0;
    return nodes_everywhere_ + std::floor(nodes_to_share_ * share);
  }

  void add_term(TreeCell& cell, const Point2& p, double value, double own_density) {
    const double of_cell = nodes_of(cell) / cell.box.area();
    const double term = (value - cell.fit.at(p)) * weight(of_cell, own_density);
    result_.value[cell.bin] += term;
    result_.variance[cell.bin] += term * term;
    const double others = of_cell + static_cast<double>(q_.spread);
    if (static_cast<double>(own_) * own_density > others) own_variance_ += term * term;
    result_.largest_term = std::max(result_.largest_term, std::abs(term));
    cell.measured += term * term;
    if (std::abs(term) > kSurprise * q_.target && surprises_.size() < kMostSurprises) {
      surprises_.emplace_back(static_cast<std::size_t>(&cell - cells_.data()),
                              PilotPoint{p, own_density, value});
    }
  }

  void add_fit_and_nodes(TreeCell& cell) {
    result_.value[cell.bin] += cell.fit.integral();
    const auto count = static_cast<int>(nodes_of(cell));
    for (int i = 0; i < count; ++i) {
      Point2 p;
      for (std::size_t d = 0; d < 2; ++d) {
        p[d] = cell.box.low[d] + random_.uniform() * (cell.box.high[d] - cell.box.low[d]);
      }
      const double value = value_at(p);
      add_term(cell, p, value, density_at(p, value));
    }
  }

  /// One node in each of equal squares, or strips.
  void add_spread_nodes() {
    const auto rows = q_.dimension == 1
                          ? std::size_t{1}
                          : static_cast<std::size_t>(std::sqrt(static_cast<double>(q_.spread)));
    const std::size_t columns = q_.spread / rows;
    for (std::size_t i = 0; i < columns * rows; ++i) {
      const std::size_t column = i % columns, row = i / columns;
      const Point2 p{
          (static_cast<double>(column) + random_.uniform()) / static_cast<double>(columns),
          (static_cast<double>(row) + random_.uniform()) / static_cast<double>(rows)};
      TreeCell* cell = leaf_at(p);
      if (cell == nullptr) continue;
      const double value = value_at(p);
      add_term(*cell, p, value, density_at(p, value));
    }
  }

  void add_own_nodes() {
    if (!q_.draw_own) return;
    for (const Point2& p : q_.draw_own(own_)) {
      TreeCell* cell = leaf_at(p);
      if (cell == nullptr) continue;
      const double value = value_at(p);
      add_term(*cell, p, value, density_at(p, value));
    }
  }

  /// What the nodes have shown of a cell replaces what was expected of it. Few nodes may show less
  /// than there is: an expectation falls by no more than a quarter in one round.
  void learn() {
    queue_ = {};
    sum_of_squares_ = 0;
    take_in_surprises();
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      TreeCell& cell = cells_[i];
      if (cell.halves != 0) continue;
      const double measured = std::sqrt(cell.measured), before = cell.key;
      choose_cut(cell);
      cell.key = std::max(measured, before / 4);
      enqueue(i);
    }
  }

  /// Nodes that contradict the fit of their cell become pilot points, which show its halves where
  /// to look. The next round draws new nodes.
  void take_in_surprises() {
    std::vector<std::vector<PilotPoint>> more(cells_.size());
    for (const auto& [cell, point] : surprises_) more[cell].push_back(point);
    surprises_.clear();
    std::vector<PilotPoint> points;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      TreeCell& cell = cells_[i];
      if (cell.halves != 0) continue;
      const std::size_t first = points.size();
      points.insert(points.end(), pilot_.begin() + static_cast<std::ptrdiff_t>(cell.first),
                    pilot_.begin() + static_cast<std::ptrdiff_t>(cell.last));
      points.insert(points.end(), more[i].begin(), more[i].end());
      cell.first = first;
      cell.last = points.size();
    }
    pilot_ = std::move(points);
  }

  const MassQuestion& q_;
  std::size_t own_, nodes_;  // in a round: of the pair's own, and shared out among the cells
  Random random_;
  std::vector<PilotPoint> pilot_;
  std::vector<std::pair<std::size_t, PilotPoint>> surprises_;  // with their cells
  std::vector<TreeCell> cells_;
  std::vector<std::vector<std::size_t>> roots_of_bin_;
  std::priority_queue<std::pair<double, std::size_t>> queue_;
  double sum_of_squares_ = 0, keys_ = 0, nodes_to_share_ = 0, nodes_everywhere_ = 0;
  double own_variance_ = 0;  // of terms where most nodes are own samples
  std::uint64_t evaluations_ = 0;
  bool finite_ = true;
  MassIntegral result_;
};

}  // namespace

double MassIntegral::error(double level) const {
  constexpr double kRounding = 1e-13;  // of thousands of cells that are added up
  return bernstein(variance_of_total, largest_term, level) + kRounding * std::abs(total);
}

MassIntegral integrate_mass(const MassQuestion& question, const std::vector<Cell>& cells) {
  return Integrator(question, cells).run();
}

}  // namespace plumbline::verify
