#include "pairs/mass_integral.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "bernstein.h"
#include "pairs/batches.h"
#include "pairs/halves_ahead.h"
#include "pairs/tree_cell.h"
#include "streams.h"

namespace plumbline::verify {
namespace {

constexpr int kMaxRounds = 6;
constexpr double kWorthwhile = 0.9;
constexpr int kMostWithoutGain = 2;
// The highest degree of a fit is several times what a smooth function leaves; nodes need no hope.
constexpr double kHope = 4;
// At which it is decided whether the target is reached.
constexpr double kPassLevel = 1e-3;
// Nodes that add more than this share of the target show something that the cells have missed.
constexpr double kSurprise = 0.02;
constexpr std::size_t kMostSurprises = 20'000;

/// A random node, whose value is not known yet.
struct NodeToAsk {
  std::size_t cell;
  Point2 p;
};

class Integrator {
 public:
  Integrator(const MassQuestion& question, const std::vector<Cell>& cells)
      : q_(question),
        own_(question.own),
        nodes_(question.spread),
        random_(random_for(question.seed, Stream::nodes)),
        roots_of_bin_(question.bins),
        ahead_(question.integrand, question.dimension) {
    const PilotsOfBins pilot = draw_pilot();
    std::vector<std::vector<Box>> boxes_of_bin(q_.bins);
    for (const Cell& cell : cells) {
      if (cell.box.area() > 0) boxes_of_bin[cell.bin].push_back(cell.box);
    }
    std::vector<CellPlan> plans;
    for (std::size_t bin = 0; bin < q_.bins; ++bin) {
      for (const Box& box : boxes_of_bin[bin]) {
        const std::size_t first = pilot_.size();
        for (const PilotPoint& s : pilot.of(bin)) {
          if (contains(box, s.p)) pilot_.push_back(s);
        }
        roots_of_bin_[bin].push_back(plans.size());
        plans.push_back({box, bin, first, pilot_.size()});
      }
    }
    std::vector<Point2> points;
    for (const CellPlan& plan : plans) CellFit::add_points(plan.box, q_.dimension, points);
    add(plans, ask(q_.integrand, points));
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
      // Where what is good enough is not reached, all that may be spent is. Beyond it, cells that
      // no longer show what they are off by would cost more rounds than they are worth, as would a
      // target that four times the nodes in each round do not reach.
      const int hopeful_rounds = std::min(2, kMaxRounds - 1 - round);
      const bool within_reach = std::ldexp(error, -hopeful_rounds) <= q_.target;
      without_gain = error < kWorthwhile * before ? 0 : without_gain + 1;
      const bool worthwhile =
          error > q_.target &&
          (error > q_.good_enough || (within_reach && without_gain < kMostWithoutGain));
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

  std::vector<std::size_t> bins_of(std::span<const Point2> points) const {
    std::vector<std::size_t> bins(points.size());
    if (q_.bins_at) q_.bins_at(points, bins);
    return bins;
  }

  std::vector<double> values_at(const std::vector<Point2>& points) {
    evaluations_ += points.size();
    std::vector<double> values = ask(q_.integrand, points);
    for (double& value : values) {
      if (std::isfinite(value)) continue;
      finite_ = false;
      value = 0;
    }
    return values;
  }

  /// Of own samples.
  ///
  /// @param values  of the integrand
  std::vector<double> densities_at(const std::vector<Point2>& points,
                                   const std::vector<double>& values) const {
    if (!q_.draw_own) return std::vector<double>(points.size(), 0.0);
    std::vector<double> densities = q_.density ? ask(q_.density, points) : values;
    for (double& d : densities) d = std::isfinite(d) && d > 0 ? d : 0;
    return densities;
  }

  PilotsOfBins draw_pilot() {
    std::vector<PilotPoint> pilot;
    const OwnSamples points = q_.draw_own ? q_.draw_own(q_.own) : OwnSamples();
    const std::vector<double> values = values_at(points), densities = densities_at(points, values);
    for (std::size_t i = 0; i < points.size(); ++i) {
      pilot.push_back({points[i], densities[i], values[i]});
    }
    return {pilot, bins_of(points), q_.bins};
  }

  /// @param values  at the points of their fits
  void add(std::span<const CellPlan> plans, const std::vector<double>& values) {
    const std::size_t each = CellFit::points(q_.dimension);
    evaluations_ += values.size();
    for (std::size_t i = 0; i < plans.size(); ++i) {
      const CellPlan& plan = plans[i];
      const CellFit fit(plan.box, q_.dimension, std::span(values).subspan(i * each, each));
      TreeCell cell{plan.box, plan.bin, fit, plan.first, plan.last};
      finite_ = finite_ && cell.fit.finite();
      choose_cut(cell);
      cells_.push_back(cell);
      enqueue(cells_.size() - 1);
    }
  }

  void choose_cut(TreeCell& cell) const {
    const std::span<const PilotPoint> inside(pilot_);
    cell.choose_cut(inside.subspan(cell.first, cell.last - cell.first), q_.dimension,
                    nodes_in_round());
  }

  NodesInRound nodes_in_round() const {
    return {static_cast<double>(q_.spread), static_cast<double>(own_)};
  }

  void enqueue(std::size_t index) {
    const TreeCell& cell = cells_[index];
    sum_of_squares_ += cell.key * cell.key;
    if (cell.can_be_halved() && cell.key > 0) queue_.push({cell.key, index});
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
    const auto [low, high] = halves_of(cell);
    const auto at = [&](std::size_t i) { return pilot_.begin() + static_cast<std::ptrdiff_t>(i); };
    const auto middle = std::partition(at(cell.first), at(cell.last), [&](const PilotPoint& s) {
      return s.p[cell.cut] < cell.at;
    });
    const auto border = static_cast<std::size_t>(middle - pilot_.begin());
    cells_[index].halves = cells_.size();
    const std::vector<double> values = ahead_.take(index, cells_, queue_);
    add(std::array{CellPlan{low, cell.bin, cell.first, border},
                   CellPlan{high, cell.bin, border, cell.last}},
        values);
  }

  /// The leaf that holds a point of a bin; none where rounding put it beside all.
  const TreeCell* leaf_at(const Point2& p, std::size_t bin) const {
    for (const std::size_t root : roots_of_bin_[bin]) {
      if (!contains(cells_[root].box, p)) continue;
      const TreeCell* cell = &cells_[root];
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
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      if (cells_[i].halves == 0) add_fit_and_nodes(i);
    }
    add_spread_nodes();
    if (q_.draw_own) add_nodes(q_.draw_own(own_));
    add_terms();
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
    const double term = (value - cell.fit.at(p)) * nodes_in_round().weight(of_cell, own_density);
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

  void add_fit_and_nodes(std::size_t index) {
    const TreeCell& cell = cells_[index];
    result_.value[cell.bin] += cell.fit.integral();
    const auto count = static_cast<int>(nodes_of(cell));
    for (int i = 0; i < count; ++i) {
      Point2 p;
      for (std::size_t d = 0; d < 2; ++d) {
        p[d] = cell.box.low[d] + random_.uniform() * (cell.box.high[d] - cell.box.low[d]);
      }
      add_node(index, p);
    }
  }

  /// A node whose term enters with others that are asked for at once.
  void add_node(std::size_t cell, const Point2& p) {
    nodes_to_ask_.push_back({cell, p});
    if (nodes_to_ask_.size() >= q_.integrand.batch()) add_terms();
  }

  void add_terms() {
    std::vector<Point2> points(nodes_to_ask_.size());
    for (std::size_t i = 0; i < points.size(); ++i) points[i] = nodes_to_ask_[i].p;
    const std::vector<double> values = values_at(points), densities = densities_at(points, values);
    for (std::size_t i = 0; i < points.size(); ++i) {
      add_term(cells_[nodes_to_ask_[i].cell], points[i], values[i], densities[i]);
    }
    nodes_to_ask_.clear();
  }

  void add_nodes(const std::vector<Point2>& points) {
    const std::vector<std::size_t> bins = bins_of(points);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const TreeCell* cell = leaf_at(points[i], bins[i]);
      if (cell) add_node(static_cast<std::size_t>(cell - cells_.data()), points[i]);
    }
  }

  /// One node in each of equal squares, or strips.
  void add_spread_nodes() {
    const auto rows = q_.dimension == 1
                          ? std::size_t{1}
                          : static_cast<std::size_t>(std::sqrt(static_cast<double>(q_.spread)));
    const std::size_t columns = q_.spread / rows;
    std::vector<Point2> points;
    for (std::size_t i = 0; i < columns * rows; ++i) {
      const std::size_t column = i % columns, row = i / columns;
      points.push_back(
          {(static_cast<double>(column) + random_.uniform()) / static_cast<double>(columns),
           (static_cast<double>(row) + random_.uniform()) / static_cast<double>(rows)});
    }
    add_nodes(points);
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
  std::vector<NodeToAsk> nodes_to_ask_;
  std::vector<std::vector<std::size_t>> roots_of_bin_;
  HalvesAhead ahead_;
  CellQueue queue_;
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
