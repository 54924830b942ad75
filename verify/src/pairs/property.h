#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "pairs/pointwise.h"
#include "text.h"

namespace plumbline::verify {

/// Counts the points where one property holds and where not.
class Property {
 public:
  Property(const SamplingPair& pair, const ContractOptions& options, CheckKind kind) {
    outcome_.result.kind = kind;
    outcome_.result.subject = pair.name + "/" + std::string(to_string(kind));
    outcome_.result.seed = options.seed;
    outcome_.result.reference = 0;
  }

  void seen_as(RatioKind kind) { outcome_.ratios.kind = kind; }

  /// @param reason  only built where it failed
  template <class Reason>
  void hold(bool holds, const Reason& reason) {
    ++tested_;
    if (holds) return;
    if (failed_++ == 0) outcome_.result.reason = reason();
  }

  /// @param channel  that it is one of, where it is of a colour
  void ratio(const Vec3& x, double value, std::size_t channel = 0) {
    if (outcome_.ratios.points.size() >= kMostRatios) return;
    outcome_.ratios.points.push_back({x, value, 0});
    channels_.push_back(channel);
  }

  const std::vector<RatioAt>& ratios() const { return outcome_.ratios.points; }
  const std::vector<std::size_t>& channels() const { return channels_; }

  /// @param errors  of the ratios, relative
  void add_errors(const std::vector<double>& errors) {
    for (std::size_t i = 0; i < errors.size(); ++i) {
      outcome_.ratios.points[i].error += errors[i];
    }
  }

  void deviation(double relative) {
    if (!(relative <= worst_)) worst_ = relative;
  }

  bool tested() const { return tested_ > 0; }

  PointwiseOutcome finish() {
    CheckResult& r = outcome_.result;
    r.samples = tested_;
    r.verdict = failed_ == 0 ? Verdict::pass : Verdict::fail;
    if (failed_ > 0) {
      r.reason += " (" + number(failed_) + " of " + number(tested_) + " points fail)";
    }
    r.estimate = r.bound = worst_;
    r.leaned_on = "points tested";
    return std::move(outcome_);
  }

 private:
  static constexpr std::size_t kMostRatios = 2'000;

  PointwiseOutcome outcome_;
  std::vector<std::size_t> channels_;  // of the ratios
  std::uint64_t tested_ = 0, failed_ = 0;
  double worst_ = 0;
};

}  // namespace plumbline::verify
