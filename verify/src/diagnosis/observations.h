#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "diagnosis/ask.h"
#include "diagnosis/evidence.h"

namespace plumbline::verify {

/// Of a hypothesis: what stands over the base of a place (the true density, the record's pdf,
/// weight · pdf()), given its free numbers; kNothingSaid where it does not know.
using Prediction = std::function<double(const Place&, std::span<const double>)>;

inline constexpr double kNothingSaid = -1;

/// That what is stated is right.
inline double as_stated(const Place& p, std::span<const double>) { return p.base; }

/// A ratio that is known up to rounding or differences.
struct ExactPoint {
  Place place;
  double ratio = 1, error = 0;
};

/// A bin that samples were counted in.
struct CountedBin {
  std::vector<Place> nodes;
  std::vector<double> shares, measures;
  double samples = 0;
  double observed = 0, expected = 0, expected_error = 0;
  bool judged = true;  ///< false: strays lie in it as well, it counts for the mass only
  bool edge = false;   ///< the pdf is 0 in a part of it: nodes say little of a ratio that varies
};

/// How well a prediction does: the largest residual in units of what is allowed for it.
struct Fit {
  bool admissible = false;
  double worst = 0;
  std::size_t tested = 0;
};

/// All that one quantity was seen to be, in one view.
struct ViewObservations {
  const ViewEvidence* view = nullptr;
  std::vector<ExactPoint> exact;
  std::vector<CountedBin> bins;
  std::vector<std::size_t> edges_last;  ///< the bins, those with a border at the end
  double missed = 0;        ///< share of the exact ratios that may be those of half a way
  bool judge_mass = false;  ///< ∫prediction + atoms + rejected = 1
  bool judge_strays = false;
};

/// Exact ratios of one view.
struct ExactOfView {
  const ViewEvidence* view = nullptr;
  std::vector<ExactPoint> points;
};

/// All that one quantity was seen to be in a whole report.
class Observations {
 public:
  /// 1/|∂x/∂u|, counts, mass and samples where the pdf is 0, all of them over pdf().
  static Observations of_density(const ReportEvidence& evidence);

  /// One of the series of points alone.
  static Observations of_series(const ReportEvidence& evidence, RatioKind kind, int lobe = -1);

  /// Points alone, of a few of the views.
  static Observations of_points(const ReportEvidence& evidence,
                                const std::vector<ExactOfView>& exact, double missed);

  /// The same with more exact ratios, found by a search that misses a few ways to a point.
  Observations with_points(const std::vector<ExactOfView>& exact, double missed) const;

  /// The same where samples fall where the pdf is positive; and without the balance of mass.
  Observations without_strays() const;
  Observations without_mass() const;

  /// The exact ratios upside down: what was above is what a factor is missing from.
  Observations inverted() const;

  const std::vector<ViewObservations>& views() const { return views_; }
  bool empty() const { return exact_ + bins_ == 0; }
  std::size_t exact() const { return exact_; }
  std::size_t bins() const { return bins_; }

  /// Whether every residual lies within its own error, at a level that accounts for their number.
  ///
  Fit judge(const Prediction& prediction, std::span<const double> parameters = {}) const;

  /// The same of one view.
  Fit judge_view(std::size_t view, const Prediction& prediction,
                 std::span<const double> parameters) const;

  /// Views, those that contradict what is stated most first: most hypotheses die there.
  const std::vector<std::size_t>& order() const { return order_; }

  /// Residuals in units of their errors, of every other point: what free numbers are fitted on.
  ///
  /// @param view     one view, or −1: all of them
  /// @param flatten  all exact ratios as if known to a percent, for the first steps of a fit
  std::vector<double> residuals(const Prediction& prediction, std::span<const double> parameters,
                                int view, bool flatten) const;

 private:
  void prepare();

  std::vector<ViewObservations> views_;
  std::vector<std::size_t> order_;
  std::size_t exact_ = 0, bins_ = 0;
};

}  // namespace plumbline::verify
