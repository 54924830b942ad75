#include "pairs/jacobian.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include <plumbline/verify/detail/stopwatch.h>

#include "diagnosis/diagnosis.h"
#include "pairs/batches.h"
#include "pairs/branches.h"
#include "pairs/differences.h"
#include "pairs/seams.h"
#include "pairs/uniforms.h"
#include "streams.h"
#include "text.h"

namespace plumbline::verify {

namespace {

// Points at which other branches of the map are looked for, and the share of them that have one in
// a map that counts as many-to-one.
constexpr std::size_t kBranchPoints = 200;
constexpr double kManyToOne = 0.02;
// Share of the points at which the branches found must add up to the pdf.
constexpr double kBranchesComplete = 0.9;

class Jacobian {
 public:
  Jacobian(const SamplingPair& pair, const ContractOptions& options)
      : pair_(pair),
        random_(random_for(options.seed, Stream::jacobian)),
        tolerance_(tolerance_of_differences(pair.epsilon)) {
    CheckResult& r = outcome_.result;
    r.kind = CheckKind::jacobian;
    r.subject = pair.name + "/jacobian";
    r.reference = 0;
    r.tolerance = tolerance_;
    r.seed = options.seed;
    r.leaned_on = "convergence of the differences";
  }

  JacobianOutcome run(int points) {
    if (pair_.lobes.empty()) {
      visit(pair_.sample, pair_.pdf, points);
    } else {
      for (std::size_t i = 0; i < pair_.lobes.size(); ++i) {
        const PairLobe& lobe = pair_.lobes[i];
        lobe_ = static_cast<int>(i);
        if (lobe.probability > 0 && lobe.sample) visit(lobe.sample, lobe.pdf, points);
      }
      lobe_ = -1;
      check_mixture();
    }
    const bool one_map = pair_.lobes.empty() && !pair_.preimages;
    outcome_.below_everywhere =
        one_map && failing_ > 0 && !more_than_seams(failing_ - failing_below_, usable_);
    if (one_map && too_many_fail() && outcome_.below_everywhere) look_for_branches();
    if (one_map && too_many_fail() && !branches_) add_up_branches();
    for (RatioSeries* s : {&of_lobes_, &of_whole_}) {
      if (!s->points.empty()) outcome_.ratios.push_back(std::move(*s));
    }
    finish();
    return std::move(outcome_);
  }

  JacobianOutcome skip(const char* reason) {
    outcome_.result.expected = Verdict::inconclusive;
    outcome_.result.reason = reason;
    outcome_.result.seconds = watch_.seconds();
    return std::move(outcome_);
  }

 private:
  void visit(const Map& map, const Many<double(Vec3)>& pdf, int points) {
    std::vector<Uniforms> tried(static_cast<std::size_t>(points));
    for (Uniforms& u : tried) {
      for (int d = 0; d < pair_.numbers; ++d) {
        u[static_cast<std::size_t>(d)] = draw_for_differences(random_);
      }
    }
    std::vector<Uniforms> from;
    std::vector<Vec3> to;
    const std::vector<Record> samples = ask(map, tried);
    for (std::size_t i = 0; i < tried.size(); ++i) {
      if (!samples[i] || samples[i]->mass > 0) continue;
      from.push_back(tried[i]);
      to.push_back(samples[i]->x);
    }
    const auto densities = pair_.preimages
                               ? sums_at(to, map)
                               : densities_by_differences(map, from, dimension(), pair_.epsilon);
    const std::vector<double> pdfs = ask(pdf, to);
    const auto known = [&](std::size_t i) {
      return densities[i] && densities[i]->relative_error <= tolerance_ / 4;
    };
    std::vector<Differing> differing;
    for (std::size_t i = 0; i < from.size() && !pair_.preimages; ++i) {
      if (known(i) && !agrees(pdfs[i], *densities[i])) {
        differing.push_back({from[i], pdfs[i], *densities[i]});
      }
    }
    const std::vector<Closely> looks =
        look_closely(map, differing, dimension(), pair_.epsilon, tolerance_);
    auto look = looks.begin();
    for (std::size_t i = 0; i < from.size(); ++i) {
      ++tried_;
      if (!known(i)) {
        ++folds_;
        continue;
      }
      const bool differs = !agrees(pdfs[i], *densities[i]) && !pair_.preimages;
      count(from[i], to[i], pdfs[i], *densities[i], differs ? *look++ : Closely{});
    }
  }

  std::vector<std::optional<DensityAt>> sums_at(const std::vector<Vec3>& points,
                                                const Map& map) const {
    std::vector<std::vector<Uniforms>> preimages;
    for (const Vec3& x : points) preimages.push_back(pair_.preimages(x));
    return sums_over(preimages, map);
  }

  int dimension() const { return pair_.domain.dimension(); }

  /// Densities at points that several random numbers lead to.
  std::vector<std::optional<DensityAt>> sums_over(
      const std::vector<std::vector<Uniforms>>& preimages, const Map& map) const {
    std::vector<Uniforms> all;
    for (const auto& of_point : preimages) all.insert(all.end(), of_point.begin(), of_point.end());
    const auto densities = densities_by_differences(map, all, dimension(), pair_.epsilon);
    std::vector<std::optional<DensityAt>> sums;
    auto next = densities.begin();
    for (const auto& of_point : preimages) {
      std::optional<DensityAt>& sum = sums.emplace_back(DensityAt{});
      for (std::size_t i = 0; i < of_point.size(); ++i, ++next) {
        if (!*next) sum.reset();
        if (!sum) continue;
        sum->value += (*next)->value;
        sum->relative_error = std::max(sum->relative_error, (*next)->relative_error);
      }
    }
    return sums;
  }

  bool agrees(double pdf, const DensityAt& density) const {
    return agree(pdf, density, tolerance_);
  }

  void count(const Uniforms& u, const Vec3& x, double pdf, const DensityAt& density,
             const Closely& closely) {
    if (closely.agrees) {
      ++seams_;
      return;
    }
    const std::size_t before = static_cast<std::size_t>(failing_);
    see(x, pdf, density, pair_.preimages ? std::nullopt : std::optional(u), closely.contradicts);
    if (static_cast<std::size_t>(failing_) == before) return;
    if (density.value < pdf) {
      if (below_.size() < kBranchPoints) below_.push_back({u, x, pdf});
      ++failing_below_;
    }
  }

  /// @param u       the numbers that lead there, if they are the only ones
  /// @param at_seam counts as failing, but is no evidence of what the density is
  void see(const Vec3& x, double pdf, const DensityAt& density, std::optional<Uniforms> u = {},
           bool at_seam = false) {
    ++usable_;
    const double error = std::abs(pdf / density.value - 1);
    RatioSeries& ratios = lobe_ >= 0 ? of_lobes_ : of_whole_;
    // A sum of densities is known as well as they are rounded.
    const double known = std::max(density.relative_error, 256 * pair_.epsilon);
    if (!at_seam) ratios.points.push_back({x, density.value / pdf, known, lobe_, u});
    if (!(error <= worst_)) {
      worst_ = error;
      worst_at_ = x;
    }
    if (!agrees(pdf, density)) ++failing_;
  }

  /// A map that reaches its points on several ways is less dense on each than the pdf of all. Where
  /// others are found, their sum is held against the pdf in the place of one branch.
  void look_for_branches() {
    const BranchSearch search(pair_.sample, dimension(), pair_.epsilon);
    double several = 0, looked_at = 0, complete = 0, beyond = 0;
    RatioSeries sums{RatioKind::density_over_pdf, {}};
    double worst = 0;
    std::vector<BranchSearch::Target> targets;
    for (const Below& b : below_) targets.push_back({b.x, b.u});
    const auto all_preimages = search.preimages(targets);
    const auto densities = sums_over(all_preimages, pair_.sample);
    for (std::size_t i = 0; i < below_.size(); ++i) {
      const Below& b = below_[i];
      const std::vector<Uniforms>& preimages = all_preimages[i];
      const auto& density = densities[i];
      if (!density || !(density->relative_error <= tolerance_ / 4)) continue;
      ++looked_at;
      several += preimages.size() > 1 ? 1 : 0;
      const bool sum_agrees = agrees(b.pdf, *density);
      complete += sum_agrees ? 1 : 0;
      beyond += !sum_agrees && density->value > b.pdf ? 1 : 0;
      if (sum_agrees) {
        worst = std::max(worst, std::abs(b.pdf / density->value - 1));
        sums.points.push_back({b.x, density->value / b.pdf, density->relative_error, -1, {}});
      }
    }
    if (!(several > kManyToOne * looked_at)) return;
    CheckResult& r = outcome_.result;
    if (more_than_seams(beyond, looked_at)) {
      r.reason = "the densities of the branches add up to more than the pdf at " + number(beyond) +
                 " of " + number(looked_at) + " points";
      return;
    }
    of_whole_ = std::move(sums);  // single branches say nothing of the whole
    failing_ = 0;
    worst_ = worst;
    branches_ = true;
    if (complete >= kBranchesComplete * looked_at) {
      r.leaned_on = "convergence of the differences, branches found by a search";
    } else {
      r.expected = Verdict::inconclusive;
      r.reason =
          "skipped: several random numbers lead to one point, and a search does not find all of "
          "them; with lobes exposed (lobe_count, lobe_probability, sample_lobe, pdf_lobe) they are "
          "checked one by one";
    }
  }

  /// Of a map that fails and is many-to-one, a diagnosis needs the density of all ways to a point.
  void add_up_branches() {
    const BranchSearch search(pair_.sample, dimension(), pair_.epsilon);
    RatioSeries sums{RatioKind::density_over_pdf, {}};
    double several = 0;
    std::vector<Uniforms> tried(kBranchPoints);
    for (Uniforms& u : tried) u = {random_.uniform(), dimension() == 1 ? 0 : random_.uniform(), 0};
    const std::vector<Record> samples = ask(pair_.sample, tried);
    std::vector<BranchSearch::Target> targets;
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < tried.size(); ++i) {
      if (!samples[i] || samples[i]->mass > 0) continue;
      targets.push_back({samples[i]->x, tried[i]});
      points.push_back(samples[i]->x);
    }
    const std::vector<double> pdfs = ask(pair_.pdf, points);
    const auto preimages = search.preimages(targets);
    const auto densities = sums_over(preimages, pair_.sample);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto& density = densities[i];
      if (!(pdfs[i] > 0) || !density || !(density->relative_error <= tolerance_ / 4)) continue;
      several += preimages[i].size() > 1 ? 1 : 0;
      sums.points.push_back({points[i],
                             density->value / pdfs[i],
                             std::max(density->relative_error, 256 * pair_.epsilon),
                             -1,
                             {}});
    }
    if (several > kManyToOne * static_cast<double>(sums.points.size())) of_whole_ = std::move(sums);
  }

  /// pdf = Σ probability · lobe pdf, at points of every lobe.
  void check_mixture() {
    constexpr std::size_t kPoints = 200;
    for (const PairLobe& lobe : pair_.lobes) {
      if (!(lobe.probability > 0)) continue;
      std::vector<Vec3> points;
      for (const Record& sample : samples_of(lobe, kPoints)) {
        if (sample && !(sample->mass > 0)) points.push_back(sample->x);
      }
      std::vector<double> sums(points.size());
      for (const PairLobe& l : pair_.lobes) {
        const std::vector<double> pdfs = ask(l.pdf, points);
        for (std::size_t i = 0; i < points.size(); ++i) sums[i] += l.probability * pdfs[i];
      }
      const std::vector<double> pdfs = ask(pair_.pdf, points);
      for (std::size_t i = 0; i < points.size(); ++i) {
        ++tried_;
        see(points[i], pdfs[i], {sums[i], 0});
      }
    }
  }

  std::vector<Record> samples_of(const PairLobe& lobe, std::size_t count) {
    if (lobe.sample) {
      std::vector<Uniforms> u(count);
      for (Uniforms& numbers : u)
        numbers = {draw_for_differences(random_), draw_for_differences(random_), 0};
      return ask(lobe.sample, u);
    }
    std::vector<Record> samples(count);
    for (Record& sample : samples) sample = lobe.draw(random_);
    return samples;
  }

  bool too_many_fail() const { return more_than_seams(failing_, usable_); }

  void finish() {
    CheckResult& r = outcome_.result;
    r.samples = static_cast<std::uint64_t>(usable_);
    r.seconds = watch_.seconds();
    r.estimate = r.bound = worst_;
    r.detectable = tolerance_ * 2;
    r.figures = {{"points tried", tried_},
                 {"folds, seams, rounding", folds_ + seams_},
                 {"failing", failing_}};
    if (tried_ == 0) {
      r.expected = Verdict::inconclusive;
      r.reason = "the map gave no point of a density";
    } else if (too_many_fail()) {
      r.verdict = Verdict::fail;
      if (!r.reason.empty()) r.reason += "; ";
      r.reason += "pdf · |dx/du| is off by " + number(worst_) + " at " + place(worst_at_) +
                  ", at " + number(failing_) + " of " + number(usable_) + " points";
    } else if (branches_ && r.expected == Verdict::inconclusive) {
      return;  // skipped, and said why
    } else if (folds_ > kMostFolds * tried_) {
      // In float that is rounding, which says nothing against the code: skipped, and said so.
      if (pair_.epsilon > 0x1p-40) r.expected = Verdict::inconclusive;
      r.reason =
          "differences do not converge at " + number(folds_) + " of " + number(tried_) + " points";
    } else {
      r.verdict = Verdict::pass;
    }
  }

  const SamplingPair& pair_;
  const Stopwatch watch_;
  Random random_;
  double tolerance_;
  JacobianOutcome outcome_;
  /// A point that is less dense than the pdf says, as one branch of several would be.
  struct Below {
    Uniforms u{};
    Vec3 x{};
    double pdf = 0;
  };

  double tried_ = 0, usable_ = 0, folds_ = 0, seams_ = 0, failing_ = 0, failing_below_ = 0;
  std::vector<Below> below_;
  bool branches_ = false;
  double worst_ = 0;
  Vec3 worst_at_{};
  int lobe_ = -1;  // that points are counted for
  RatioSeries of_whole_{RatioKind::density_over_pdf, {}};
  RatioSeries of_lobes_{RatioKind::lobe_density_over_pdf, {}};
};

}  // namespace

JacobianOutcome judge_jacobian(const SamplingPair& pair, const ContractOptions& options) {
  Jacobian jacobian(pair, options);
  if (pair.domain.dimension() == 0) return jacobian.skip("skipped: the domain is discrete");
  const bool lobes = !pair.lobes.empty();
  if (pair.draw && !lobes)
    return jacobian.skip("skipped: the sampler takes a generator, not numbers");
  if (pair.numbers != pair.domain.dimension() && !lobes) {
    return jacobian.skip("skipped: the map uses more numbers than the domain has dimensions");
  }
  if (pair.many_to_one && !pair.preimages && !lobes) {
    return jacobian.skip(
        "skipped: the map is many-to-one and neither lobes nor preimages are given");
  }
  return jacobian.run(options.jacobian_points);
}

CheckResult check_jacobian(const SamplingPair& pair, const ContractOptions& options) {
  JacobianOutcome outcome = judge_jacobian(pair, options);
  if (outcome.result.verdict == Verdict::fail) {
    ViewEvidence view;
    view.pair = &pair;
    view.ratios = std::move(outcome.ratios);
    view.failed = true;
    outcome.result.diagnosis = diagnose({{std::move(view)}, {}, {}}).headline;
  }
  return outcome.result;
}

}  // namespace plumbline::verify
