#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include <plumbline/verify/detail/stopwatch.h>

#include "dependent/point_sets.h"
#include "text.h"

namespace plumbline::verify {

namespace {

constexpr std::size_t kMostNetPoints = std::size_t{1} << 24;

/// Which of so many equal parts of [0, 1) a number lies in. Their edges are numbers in double for
/// powers of 2 only; else what lies a few roundings below an edge counts as on it.
std::uint64_t part_of(double x, std::uint64_t parts) {
  constexpr double kRounding = 0x1p-48;
  const double above = (parts & (parts - 1)) == 0 ? x : x + kRounding;
  return std::min(static_cast<std::uint64_t>(above * static_cast<double>(parts)), parts - 1);
}

std::string power_of(int base, int exponent) {
  return std::to_string(base) + "^-" + std::to_string(exponent);
}

/// Elementary intervals whose sides are b^-d_i, with Σ d_i given: all ways to share that out.
class Shapes {
 public:
  Shapes(std::size_t dimensions, int sum) : exponents_(dimensions) { exponents_[0] = sum; }

  const std::vector<int>& exponents() const { return exponents_; }

  /// The next one, in the order of what is left to the first; false after the last.
  bool next() {
    std::size_t i = 0;
    while (i < exponents_.size() && exponents_[i] == 0) ++i;
    if (i + 1 >= exponents_.size()) return false;
    const int given = exponents_[i];
    exponents_[i] = 0;
    exponents_[0] = given - 1;
    ++exponents_[i + 1];
    return true;
  }

 private:
  std::vector<int> exponents_;
};

/// Base and quality of a net, and which of a set's points and dimensions it is made of.
struct NetPart {
  int base = 2, t = 0, m = 0;
  std::size_t first_point = 0, first_dimension = 0, dimensions = 0;
};

class NetCounts {
 public:
  NetCounts(const PointSet& set, const NetPart& part) : set_(set), part_(part) {}

  /// What is wrong; empty if nothing is.
  std::string first_fault() {
    Shapes shapes(part_.dimensions, part_.m - part_.t);
    do {
      const std::string fault = fault_of(shapes.exponents());
      if (!fault.empty()) return fault;
    } while (shapes.next());
    return {};
  }

 private:
  std::uint64_t power(int exponent) const {
    std::uint64_t value = 1;
    for (int i = 0; i < exponent; ++i) value *= static_cast<std::uint64_t>(part_.base);
    return value;
  }

  std::string fault_of(const std::vector<int>& exponents) {
    counts_.assign(power(part_.m - part_.t), 0);
    for (std::size_t i = 0; i < power(part_.m); ++i) {
      std::uint64_t interval = 0;
      for (std::size_t d = 0; d < exponents.size(); ++d) {
        const std::uint64_t sides = power(exponents[d]);
        const double x = set_.at(part_.first_point + i, part_.first_dimension + d);
        interval = interval * sides + part_of(x, sides);
      }
      ++counts_[interval];
    }
    const std::uint64_t due = power(part_.t);
    for (const std::uint64_t count : counts_) {
      if (count != due) return named(exponents, count, due);
    }
    return {};
  }

  std::string named(const std::vector<int>& exponents, std::uint64_t count,
                    std::uint64_t due) const {
    std::string sides;
    for (const int e : exponents) sides += (sides.empty() ? "" : " × ") + power_of(part_.base, e);
    return "of the points from " + number(part_.first_point) + " on, in dimensions from " +
           number(part_.first_dimension) + " on, an interval of " + sides + " holds " +
           number(count) + " and not " + number(due);
  }

  const PointSet& set_;
  const NetPart& part_;
  std::vector<std::uint64_t> counts_;
};

std::string fault_of_net(const PointSet& set, const PointSets& sets, const NetOptions& o) {
  const std::size_t group = o.group == 0 ? sets.dimensions : o.group;
  for (std::size_t d = 0; d < sets.dimensions; d += group) {
    for (int k = o.sequence ? o.t : o.m; k <= o.m; ++k) {
      std::size_t block = 1;
      for (int i = 0; i < k; ++i) block *= static_cast<std::size_t>(o.base);
      for (std::size_t first = 0; first < set.size(); first += block) {
        const NetPart part{o.base, o.t, k, first, d, std::min(group, sets.dimensions - d)};
        const std::string fault = NetCounts(set, part).first_fault();
        if (!fault.empty()) return fault;
      }
    }
  }
  return {};
}

std::string fault_of_strata(const PointSet& set, std::size_t dimensions) {
  std::vector<bool> taken;
  for (std::size_t d = 0; d < dimensions; ++d) {
    taken.assign(set.size(), false);
    for (std::size_t i = 0; i < set.size(); ++i) {
      const std::uint64_t stratum = part_of(set.at(i, d), set.size());
      if (taken[stratum]) {
        return "in dimension " + number(d) + " stratum " + number(stratum) + " of " +
               number(set.size()) + " holds more than one point";
      }
      taken[stratum] = true;
    }
  }
  return {};
}

/// Looks at one replicate after the other until one is wrong.
///
/// @param fault  what is wrong with a set; empty if nothing is
template <class Fault>
CheckResult look_at_replicates(CheckKind kind, const PointSets& sets, const CheckSettings& settings,
                               std::size_t n, int replicates, const Fault& fault) {
  const Stopwatch watch;
  CheckResult r;
  r.kind = kind;
  r.subject = sets.name + "/" + std::string(to_string(kind));
  r.seed = settings.seed;
  r.leaned_on = "every point counted";
  r.verdict = Verdict::pass;
  const std::uint64_t first = first_replicate(settings.seed);
  for (int i = 0; i < replicates && r.verdict == Verdict::pass; ++i) {
    const std::uint64_t replicate = first + static_cast<std::uint64_t>(i);
    const PointSet set(sets, replicate, n);
    r.samples += n;
    std::string reason = set.outside();
    if (reason.empty()) reason = fault(set);
    if (reason.empty()) continue;
    r.verdict = Verdict::fail;
    r.reason = "replicate " + number(replicate) + ": " + reason;
  }
  r.seconds = watch.seconds();
  return r;
}

}  // namespace

CheckResult check_stratified(const PointSets& sets, const StratifiedOptions& options) {
  if (options.points == 0 || options.replicates < 1) {
    throw std::invalid_argument("strata '" + sets.name + "': need points and replicates");
  }
  return look_at_replicates(
      CheckKind::strata, sets, options, options.points, options.replicates,
      [&](const PointSet& set) { return fault_of_strata(set, sets.dimensions); });
}

CheckResult check_net(const PointSets& sets, const NetOptions& options) {
  if (options.base < 2 || options.t < 0 || options.t > options.m || options.replicates < 1) {
    throw std::invalid_argument("net '" + sets.name + "': needs a base ≥ 2 and 0 ≤ t ≤ m");
  }
  std::size_t n = 1;
  for (int i = 0; i < options.m; ++i) {
    n *= static_cast<std::size_t>(options.base);
    if (n > kMostNetPoints) throw std::invalid_argument("net '" + sets.name + "': too many points");
  }
  return look_at_replicates(CheckKind::net, sets, options, n, options.replicates,
                            [&](const PointSet& set) { return fault_of_net(set, sets, options); });
}

}  // namespace plumbline::verify
