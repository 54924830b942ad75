#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <deque>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <plumbline/verify/bsdf.h>

#include "bsdfs/bsdf_checks.h"
#include "bsdfs/purity.h"
#include "diagnosis/diagnosis.h"
#include "pairs/battery.h"
#include "progress.h"
#include "streams.h"
#include "text.h"
#include "threads.h"

namespace plumbline::verify {

namespace {

constexpr const char* kBlackEverywhere =
    "no direction gives any sample, so that nothing was tested";
constexpr const char* kWhyBlack =
    "see that the frame and the side that the given direction points to are as the conventions "
    "say, and that it is looked at from a side that it scatters on";

/// A direction to look from, with the name that results carry.
struct View {
  Vec3 wo;
  std::string name;
};

std::string view_name(const Vec3& wo, const char* face) {
  char text[48];
  std::snprintf(text, sizeof text, "%s %.4g°", face,
                std::acos(std::min(1.0, std::abs(wo[2]))) * 180 / std::numbers::pi);
  return text;
}

std::vector<View> views_of(const BsdfOptions& options) {
  Random random = random_for(options.contract.seed, Stream::views);
  std::vector<View> views;
  for (const bool front : {true, false}) {
    if (!(front ? options.front : options.back)) continue;
    const double side = front ? 1 : -1;
    const char* face = front ? "front" : "back";
    const auto add = [&](double cosine, double sine) {
      const double phi = 2 * std::numbers::pi * random.uniform();
      // + 0: no −0 in what a person reads.
      const Vec3 wo{sine * std::cos(phi) + 0.0, sine * std::sin(phi) + 0.0, side * cosine};
      views.push_back({wo, view_name(wo, face)});
    };
    for (const double degrees : options.angles) {
      const double theta = degrees * std::numbers::pi / 180;
      add(std::cos(theta), std::sin(theta));
    }
    for (int i = 0; i < options.random_directions; ++i) {
      const double z = random.uniform();
      add(z, std::sqrt(1 - z * z));
    }
  }
  return views;
}

/// Each view draws numbers of its own.
BsdfOptions for_view(BsdfOptions options, std::size_t view) {
  options.contract.seed += view * 0x9e3779b97f4a7c15u;
  return options;
}

/// What is looked at from one direction.
class Looking {
 public:
  /// @param bsdf, progress  kept by the caller
  Looking(const std::string& name, const ErasedBsdf& bsdf, const View& from,
          const BsdfOptions& options, Progress& progress)
      : view_(from),
        options_(options),
        bsdf_(bsdf),
        progress_(progress),
        pair_(bsdf_pair(name + "/" + from.name, bsdf, from.wo, options)),
        battery_(pair_, options_.contract, progress) {}

  void judge_points() { battery_.judge_points(); }

  void judge_samples() {
    battery_.judge_samples();
    if (options_.conserves_energy || options_.albedo) {
      add(check_energy(pair_.name, bsdf_, view_.wo, options_));
      albedo_ = albedo_seen(more_.back(), view_.wo, options_);
    }
    if (battery_.has_atoms()) add(check_atoms(pair_.name, bsdf_, view_.wo, options_));
  }

  /// All results, with the evidence but for its bins. Once.
  PairOutcome outcome() {
    PairOutcome outcome = battery_.outcome();
    outcome.view.wo = view_.wo;
    outcome.view.bsdf = &bsdf_;
    outcome.view.eta = options_.eta;
    for (CheckResult& r : more_) outcome.results.push_back(std::move(r));
    for (CheckResult& r : outcome.results) {
      if (!r.as_expected()) r.reason += "; wo = " + place(view_.wo) + ", z the normal";
    }
    return outcome;
  }

  const std::optional<AlbedoAt>& albedo() const { return albedo_; }
  std::vector<BinSeen> bins_seen() const { return battery_.bins_seen(); }

 private:
  void add(CheckResult result) {
    progress_.decided(result);
    more_.push_back(std::move(result));
  }

  View view_;
  BsdfOptions options_;
  const ErasedBsdf& bsdf_;
  Progress& progress_;
  SamplingPair pair_;
  PairBattery battery_;
  std::vector<CheckResult> more_;  // of a BSDF: energy, atoms
  std::optional<AlbedoAt> albedo_;
};

class BsdfBattery {
 public:
  BsdfBattery(const std::string& name, const ErasedBsdf& bsdf, const BsdfOptions& options)
      : name_(name), bsdf_(bsdf), options_(options), progress_(name, options.contract) {
    const std::vector<View> views = views_of(options);
    for (std::size_t i = 0; i < views.size(); ++i) {
      looking_.emplace_back(name, bsdf, views[i], for_view(options, i), progress_);
    }
  }

  /// What needs no statistics comes first, from all directions.
  Report run() {
    const int threads = options_.contract.threads;
    if (threads > 1) require_pure(name_, bsdf_, options_.contract.seed);
    const auto each = [&](auto judge) {
      on_threads(threads, looking_.size(), [&](std::size_t i) { (looking_[i].*judge)(); });
    };
    each(&Looking::judge_points);
    ReciprocityOutcome reciprocity;
    if (options_.reciprocal) {
      reciprocity = judge_reciprocity(name_, bsdf_, options_);
      progress_.decided(reciprocity.result);
    }
    each(&Looking::judge_samples);
    for (Looking& from : looking_) take(from);
    if (options_.reciprocal) {
      evidence_.reciprocity = std::move(reciprocity.pairs);
      all_.results.push_back(std::move(reciprocity.result));
    }
    if (black_) {
      all_.results.push_back(
          nothing_sampled(name_, options_.contract, kBlackEverywhere, kWhyBlack));
      progress_.decided(all_.results.back());
    }
    find_cause();
    return std::move(all_);
  }

 private:
  void take(Looking& from) {
    PairOutcome outcome = from.outcome();
    black_ = black_ && outcome.nothing;
    for (CheckResult& r : outcome.results) all_.results.push_back(std::move(r));
    evidence_.views.push_back(std::move(outcome.view));
    if (from.albedo()) evidence_.albedos.push_back(*from.albedo());
  }

  void find_cause() {
    const bool failed = std::any_of(
        all_.begin(), all_.end(), [](const CheckResult& r) { return r.verdict == Verdict::fail; });
    if (!failed) return;
    progress_.looks_at("the cause");
    for (std::size_t i = 0; i < looking_.size(); ++i) {
      evidence_.views[i].bins = looking_[i].bins_seen();
    }
    name_cause(diagnose(evidence_), all_);
  }

  const std::string& name_;
  const ErasedBsdf& bsdf_;
  const BsdfOptions& options_;
  Progress progress_;
  std::deque<Looking> looking_;  // what the evidence points to
  ReportEvidence evidence_;
  Report all_;
  bool black_ = true;  // which from some directions may be right, from all is most likely not
};

}  // namespace

Report check_bsdf(const std::string& name, const ErasedBsdf& bsdf, const BsdfOptions& options) {
  return BsdfBattery(name, bsdf, options).run();
}

}  // namespace plumbline::verify
