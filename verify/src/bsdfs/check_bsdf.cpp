#include <algorithm>
#include <cmath>
#include <cstdio>
#include <deque>
#include <numbers>
#include <string>
#include <utility>

#include <plumbline/verify/bsdf.h>

#include "bsdfs/bsdf_checks.h"
#include "diagnosis/diagnosis.h"
#include "pairs/battery.h"
#include "pairs/chi_square_look.h"

namespace plumbline::verify {

namespace {

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
  Random random(options.contract.seed, 9);
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

bool saw_atoms(const std::vector<CheckResult>& results) {
  for (const CheckResult& r : results) {
    for (const auto& [name, value] : r.figures) {
      if (name == "atoms" && value > 0) return true;
    }
  }
  return false;
}

bool gives_samples(const SamplingPair& pair, std::uint64_t seed) {
  constexpr int kTries = 1'000;
  Random random(seed, 10);
  for (int i = 0; i < kTries; ++i) {
    if (pair.next(random)) return true;
  }
  return false;
}

/// Nothing is wrong with black, and every check of it passes: but more often than not it stands for
/// a convention that was not stated.
CheckResult black_everywhere(const std::string& name, const BsdfOptions& options) {
  CheckResult r;
  r.check = "samples";
  r.subject = name + "/samples";
  r.seed = options.contract.seed;
  r.reason =
      "no direction gives any sample: are the frame and the side that the given direction points "
      "to as the conventions say?";
  return r;
}

}  // namespace

std::vector<CheckResult> check_bsdf(const std::string& name, const ErasedBsdf& bsdf,
                                    const BsdfOptions& options) {
  std::vector<CheckResult> all;
  ReportEvidence evidence;
  std::deque<SamplingPair> pairs;  // what the evidence points to
  const std::vector<View> views = views_of(options);
  bool black = true;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const View& view = views[i];
    const BsdfOptions here = for_view(options, i);
    const std::string subject = name + "/" + view.name;
    const SamplingPair& pair = pairs.emplace_back(bsdf_pair(subject, bsdf, view.wo, here));
    black = black && !gives_samples(pair, here.contract.seed);
    PairOutcome outcome = judge_pair(pair, here.contract);
    outcome.view.wo = view.wo;
    outcome.view.bsdf = &bsdf;
    outcome.view.eta = options.eta;
    evidence.views.push_back(std::move(outcome.view));
    std::vector<CheckResult>& results = outcome.results;
    if (options.conserves_energy || options.albedo) {
      results.push_back(check_energy(subject, bsdf, view.wo, here));
      evidence.albedos.push_back(albedo_seen(results.back(), view.wo, options));
    }
    if (saw_atoms(results)) results.push_back(check_atoms(subject, bsdf, view.wo, here));
    for (CheckResult& r : results) {
      if (!r.as_expected()) r.reason += "; wo = " + place(view.wo) + ", z the normal";
      all.push_back(std::move(r));
    }
  }
  if (options.reciprocal) {
    ReciprocityOutcome outcome = judge_reciprocity(name, bsdf, options);
    evidence.reciprocity = std::move(outcome.pairs);
    all.push_back(std::move(outcome.result));
  }
  if (black) all.push_back(black_everywhere(name, options));
  const bool failed = std::any_of(all.begin(), all.end(),
                                  [](const CheckResult& r) { return r.verdict == Verdict::fail; });
  if (failed) name_cause(diagnose(evidence), all);
  return all;
}

}  // namespace plumbline::verify
