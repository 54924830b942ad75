#include "joints/cube_mass.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "joints/cube_fit.h"
#include "pairs/batches.h"
#include "streams.h"

namespace plumbline::verify {

namespace {

constexpr double kPassLevel = 1e-3;
// Of the evaluations: cells and nodes of a first round, which shows where it is rough, and what is
// spent on cells until the second begins.
constexpr double kFirstCells = 0.1, kFirstNodes = 0.1, kCells = 0.45;
// Own nodes, at most so many and this share of the evaluations.
constexpr std::size_t kMostOwn = 1 << 18;
constexpr std::size_t kOwnShare = 8;
// Of the uniform nodes: the same number in each cell, and in proportion to its volume; the others
// go where the fits are off.
constexpr double kEven = 0.2, kByVolume = 0.15;
constexpr double kLeastNodes = 2;
// A standard normal exceeds that, on either side, once in a thousand times.
constexpr double kNormal = 3.3;
constexpr double kNarrowest = 1e-12;
// Cells, halved ones included, that lines may cut the bins into.
constexpr std::size_t kCellsPerBin = 8;
// Pilot samples that take up less than that of a cell's side are a crowd.
constexpr double kCrowd = 0.7;

struct CubeCell {
  CubeBox box;
  std::size_t bin = 0;
  std::size_t first = 0, last = 0;  // of the pilot samples inside
  CubeFit fit;
  double roughness = 0;  // volume · root mean square of what the fit leaves
  double nodes = 0;      // uniform ones
  double measured = 0;   // Σ of the squares of its terms
  std::size_t cut = 0;
  std::size_t halves = 0;  // index of the lower half, 0: a leaf
  double at = 0;
};

class CubeIntegrator {
 public:
  CubeIntegrator(const CubeQuestion& question, const CubeTree& tree, std::size_t dimension)
      : q_(question),
        tree_(tree),
        dimension_(dimension),
        fitter_(dimension),
        random_(random_for(question.seed, Stream::joint_nodes)),
        own_(std::min<std::size_t>(kMostOwn, question.max_evaluations / kOwnShare)) {
    begin();
  }

  CubeMass run() {
    const double all = static_cast<double>(q_.max_evaluations);
    refine(kFirstCells * all, kFirstNodes * all);
    CubeMass mass = correct(kFirstNodes * all);
    if (mass.integral.error(kPassLevel) > q_.target && mass.integral.finite) {
      learn();
      refine(kCells * all, (1 - kCells) * all);
      mass = correct(std::max(kFirstNodes * all, all - static_cast<double>(evaluations_)));
    }
    mass.integral.evaluations = evaluations_;
    return mass;
  }

 private:
  /// One cell for each bin, with its pilot samples in a row.
  void begin() {
    const std::vector<double> values = values_at(q_.pilot);
    std::vector<std::vector<std::size_t>> of_bin(tree_.bins());
    for (std::size_t i = 0; i < values.size(); ++i) {
      of_bin[tree_.locate(q_.pilot[i])].push_back(i);
    }
    std::vector<CubeCell> cells;
    root_of_bin_.assign(tree_.bins(), kNone);
    for (std::size_t bin = 0; bin < tree_.bins(); ++bin) {
      const std::size_t first = pilot_.size();
      for (const std::size_t i : of_bin[bin]) pilot_.push_back({q_.pilot[i], values[i]});
      if (!(tree_.box(bin).volume() > 0)) continue;
      root_of_bin_[bin] = cells.size();
      CubeCell& cell = cells.emplace_back();
      cell.box = tree_.box(bin);
      cell.bin = bin;
      cell.first = first, cell.last = pilot_.size();
    }
    add(std::move(cells));
    while (cut_at_lines()) {
    }
  }

  /// Cuts cells that a line runs through along which the density may jump, once each, as long as
  /// they do not become many times what bins there are: beyond that, nodes see the jumps.
  bool cut_at_lines() {
    std::vector<std::size_t> leaves;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      CubeCell& cell = cells_[i];
      for (std::size_t d = 0; d < dimension_ && cell.halves == 0; ++d) {
        const auto after = [&](double x) {
          return std::upper_bound(q_.breaks[d].begin(), q_.breaks[d].end(), x);
        };
        const auto first = after(cell.box.low[d]);
        const auto last = std::lower_bound(first, q_.breaks[d].end(), cell.box.high[d]);
        if (first == last || cell.box.size(d) < kNarrowest) continue;
        cell.cut = d;
        cell.at = *(first + (last - first) / 2);
        leaves.push_back(i);
        break;
      }
    }
    if (leaves.empty() || cells_.size() + 2 * leaves.size() > kCellsPerBin * tree_.bins()) {
      for (const std::size_t i : leaves) look_at(cells_[i]);
      return false;
    }
    halve(leaves);
    return true;
  }

  std::vector<double> values_at(const std::vector<CubePoint>& points) {
    evaluations_ += points.size();
    std::vector<double> values = ask(q_.density, points);
    for (double& value : values) {
      if (std::isfinite(value)) continue;
      finite_ = false;
      value = 0;
    }
    return values;
  }

  void add(std::vector<CubeCell> cells) {
    std::vector<CubePoint> points;
    points.reserve(cells.size() * fitter_.nodes());
    for (const CubeCell& cell : cells) fitter_.add_nodes(cell.box, points);
    const std::vector<double> values = values_at(points);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      CubeCell& cell = cells[i];
      cell.fit = fitter_.fit(std::span(values).subspan(i * fitter_.nodes(), fitter_.nodes()));
      look_at(cell);
      cells_.push_back(cell);
    }
  }

  /// How rough the density is in the cell, from the nodes of its fit and from the pilot samples in
  /// it: ∫(f − g)² is their mean of (f − g)²/f.
  void look_at(CubeCell& cell) const {
    const double at_nodes = cell.box.volume() * cell.fit.rest;
    double sum = 0;
    CubePoint low = cell.box.high, high = cell.box.low;
    for (std::size_t i = cell.first; i < cell.last; ++i) {
      const Pilot& s = pilot_[i];
      for (std::size_t d = 0; d < dimension_; ++d) {
        low[d] = std::min(low[d], s.p[d]);
        high[d] = std::max(high[d], s.p[d]);
      }
      if (!(s.value > 0)) continue;
      const double off = s.value - fitter_.at(cell.fit, cell.box, s.p);
      // Where the fit is far above the density a pilot sample is a coincidence.
      sum += off * off / std::max(s.value, std::abs(off));
    }
    const double at_points = std::sqrt(cell.box.volume() * sum / q_.pilots_drawn);
    cell.roughness = std::max(at_nodes, at_points);
    cell.cut = cell.fit.cut;
    if (at_points > at_nodes) {
      double least = kCrowd;
      for (std::size_t d = 0; d < dimension_; ++d) {
        const double share = (high[d] - low[d]) / cell.box.size(d);
        if (share < least) least = share, cell.cut = d;
      }
    }
    const double from = cell.box.low[cell.cut], to = cell.box.high[cell.cut];
    cell.at = (from + to) / 2;
    for (const double line : q_.breaks[cell.cut]) {
      // Where the density may jump there is no better place to cut, if both sides are of some size.
      if (line > from + 0.1 * (to - from) && line < to - 0.1 * (to - from)) cell.at = line;
    }
  }

  bool can_be_halved(const CubeCell& cell) const {
    return cell.box.size(cell.cut) > kNarrowest && cell.at > cell.box.low[cell.cut] &&
           cell.at < cell.box.high[cell.cut];
  }

  /// Halves the roughest cells until so many evaluations are spent, or until so many nodes would
  /// show the total well enough.
  void refine(double until, double nodes) {
    for (;;) {
      std::vector<std::size_t> leaves;
      double roughness = 0;
      for (std::size_t i = 0; i < cells_.size(); ++i) {
        const CubeCell& cell = cells_[i];
        if (cell.halves != 0) continue;
        roughness += cell.roughness;
        if (cell.roughness > 0 && can_be_halved(cell)) leaves.push_back(i);
      }
      const double hope = kNormal * roughness / std::sqrt(std::max(nodes, 1.0));
      const double left =
          (until - static_cast<double>(evaluations_)) / 2 / static_cast<double>(fitter_.nodes());
      if (leaves.empty() || hope <= q_.target / 2 || !(left >= 1)) return;
      const std::size_t most = std::max<std::size_t>(leaves.size() / 6, 16);
      const std::size_t now = std::min({leaves.size(), most, static_cast<std::size_t>(left)});
      const auto border = leaves.begin() + static_cast<std::ptrdiff_t>(now - 1);
      std::nth_element(leaves.begin(), border, leaves.end(), [&](std::size_t a, std::size_t b) {
        return cells_[a].roughness > cells_[b].roughness;
      });
      leaves.resize(now);
      halve(leaves);
    }
  }

  void halve(const std::vector<std::size_t>& leaves) {
    std::vector<CubeCell> halves;
    for (const std::size_t index : leaves) {
      CubeCell& cell = cells_[index];
      const auto at = [&](std::size_t i) {
        return pilot_.begin() + static_cast<std::ptrdiff_t>(i);
      };
      const auto middle = std::partition(at(cell.first), at(cell.last),
                                         [&](const Pilot& s) { return s.p[cell.cut] < cell.at; });
      cell.halves = cells_.size() + halves.size();
      CubeCell low, high;
      low.box = high.box = cell.box;
      low.bin = high.bin = cell.bin;
      low.box.high[cell.cut] = high.box.low[cell.cut] = cell.at;
      low.first = cell.first, high.last = cell.last;
      low.last = high.first = static_cast<std::size_t>(middle - pilot_.begin());
      halves.push_back(low);
      halves.push_back(high);
    }
    add(std::move(halves));
  }

  CubeCell* leaf_at(const CubePoint& p) {
    const std::size_t root = root_of_bin_[tree_.locate(p)];
    if (root == kNone) return nullptr;
    CubeCell* cell = &cells_[root];
    while (cell->halves != 0) cell = &cells_[cell->halves + (p[cell->cut] < cell->at ? 0 : 1)];
    return cell;
  }

  /// Random nodes on the cells as they are.
  CubeMass correct(double nodes) {
    result_ = {};
    MassIntegral& integral = result_.integral;
    integral.value.assign(tree_.bins(), 0.0);
    integral.variance.assign(tree_.bins(), 0.0);
    share_out(nodes);
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      if (cells_[i].halves == 0) add_cell(i);
    }
    ask_nodes();
    add_own_nodes();
    for (const CubeCell& cell : cells_) {
      if (cell.halves != 0) continue;
      // Few nodes may miss what the fit's own have seen: a mass that is too small by that would
      // look well known.
      const double expected = cell.roughness * cell.roughness / cell.nodes;
      integral.variance[cell.bin] += std::max(0.0, expected - cell.measured);
    }
    for (std::size_t b = 0; b < tree_.bins(); ++b) {
      integral.total += integral.value[b];
      integral.variance_of_total += integral.variance[b];
    }
    // No node adds more than one over the number of own ones, but by its fit.
    integral.largest_term = std::max(integral.largest_term, 1 / static_cast<double>(own_));
    integral.finite = finite_;
    integral.unseen = std::log(1 / kPassLevel) / std::max(1.0, kByVolume * nodes);
    return result_;
  }

  void share_out(double nodes) {
    double leaves = 0, roughness = 0;
    for (const CubeCell& cell : cells_) {
      if (cell.halves != 0) continue;
      leaves += 1;
      roughness += cell.roughness;
    }
    result_.integral.cells = static_cast<std::size_t>(leaves);
    for (CubeCell& cell : cells_) {
      if (cell.halves != 0) continue;
      double share = kEven / leaves + kByVolume * cell.box.volume();
      if (roughness > 0) share += (1 - kEven - kByVolume) * cell.roughness / roughness;
      cell.nodes = kLeastNodes + std::floor(nodes * share);
      cell.measured = 0;
    }
  }

  void add_cell(std::size_t index) {
    const CubeCell& cell = cells_[index];
    const double of_fit = cell.box.volume() * cell.fit.mean();
    result_.integral.value[cell.bin] += of_fit;
    result_.of_uniform.total += of_fit;
    for (double i = 0; i < cell.nodes; ++i) {
      CubePoint p = cell.box.center();
      for (std::size_t d = 0; d < dimension_; ++d) {
        p[d] = cell.box.low[d] + random_.uniform() * cell.box.size(d);
      }
      points_.push_back(p);
      cell_of_point_.push_back(index);
    }
    if (points_.size() >= q_.density.batch()) ask_nodes();
  }

  /// @return  share of the value that the pair's own samples account for
  double add_term(CubeCell& cell, const CubePoint& p, double value) {
    const double own = static_cast<double>(own_) * std::max(value, 0.0);
    const double off = value - fitter_.at(cell.fit, cell.box, p);
    const double term = off / (cell.nodes / cell.box.volume() + own);
    MassIntegral& integral = result_.integral;
    integral.value[cell.bin] += term;
    integral.variance[cell.bin] += term * term;
    integral.largest_term = std::max(integral.largest_term, std::abs(term));
    cell.measured += term * term;
    return term * static_cast<double>(own_);
  }

  void add_uniform_term(const CubeCell& cell, const CubePoint& p, double value) {
    const double off = value - fitter_.at(cell.fit, cell.box, p);
    const double term = off * cell.box.volume() / cell.nodes;
    MassIntegral& uniform = result_.of_uniform;
    uniform.total += term;
    uniform.variance_of_total += term * term;
    uniform.largest_term = std::max(uniform.largest_term, std::abs(term));
  }

  void ask_nodes() {
    const std::vector<double> values = values_at(points_);
    for (std::size_t i = 0; i < values.size(); ++i) {
      CubeCell& cell = cells_[cell_of_point_[i]];
      add_term(cell, points_[i], values[i]);
      add_uniform_term(cell, points_[i], values[i]);
    }
    points_.clear();
    cell_of_point_.clear();
  }

  void add_own_nodes() {
    const std::vector<CubePoint> points = q_.draw_own(own_);
    const std::vector<double> values = values_at(points);
    double resting = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      CubeCell* cell = leaf_at(points[i]);
      const double share = cell == nullptr ? 1 : add_term(*cell, points[i], values[i]);
      if (share > 0.5) resting += 1;
    }
    result_.rests_on_own = resting / std::max(1.0, static_cast<double>(own_));
  }

  /// What the nodes have shown of a cell replaces what was expected of it.
  void learn() {
    for (CubeCell& cell : cells_) {
      if (cell.halves != 0) continue;
      const double shown = std::sqrt(cell.measured * cell.nodes);
      cell.roughness = std::max(shown, cell.roughness / 2);
    }
  }

  struct Pilot {
    CubePoint p;
    double value;
  };
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

  const CubeQuestion& q_;
  const CubeTree& tree_;
  std::size_t dimension_;
  CubeFitter fitter_;
  Random random_;
  std::size_t own_;
  std::vector<Pilot> pilot_;
  std::vector<CubeCell> cells_;
  std::vector<std::size_t> root_of_bin_;
  std::vector<CubePoint> points_;
  std::vector<std::size_t> cell_of_point_;
  std::uint64_t evaluations_ = 0;
  bool finite_ = true;
  CubeMass result_;
};

}  // namespace

CubeMass integrate_cube(const CubeQuestion& question, const CubeTree& tree, std::size_t dimension) {
  return CubeIntegrator(question, tree, dimension).run();
}

}  // namespace plumbline::verify
