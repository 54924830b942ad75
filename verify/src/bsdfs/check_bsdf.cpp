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
#include "streams.h"
#include "text.h"

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

}  // namespace

Report check_bsdf(const std::string& name, const ErasedBsdf& bsdf, const BsdfOptions& options) {
  Report all;
  ReportEvidence evidence;
  std::deque<SamplingPair> pairs;  // what the evidence points to
  const std::vector<View> views = views_of(options);
  bool black = true;  // which from some directions may be right, from all is most likely not
  for (std::size_t i = 0; i < views.size(); ++i) {
    const View& view = views[i];
    const BsdfOptions here = for_view(options, i);
    const std::string subject = name + "/" + view.name;
    const SamplingPair& pair = pairs.emplace_back(bsdf_pair(subject, bsdf, view.wo, here));
    PairOutcome outcome = judge_pair(pair, here.contract);
    black = black && outcome.nothing;
    outcome.view.wo = view.wo;
    outcome.view.bsdf = &bsdf;
    outcome.view.eta = options.eta;
    evidence.views.push_back(std::move(outcome.view));
    std::vector<CheckResult>& results = outcome.results;
    if (options.conserves_energy || options.albedo) {
      results.push_back(check_energy(subject, bsdf, view.wo, here));
      evidence.albedos.push_back(albedo_seen(results.back(), view.wo, options));
    }
    if (outcome.atoms) results.push_back(check_atoms(subject, bsdf, view.wo, here));
    for (CheckResult& r : results) {
      if (!r.as_expected()) r.reason += "; wo = " + place(view.wo) + ", z the normal";
      all.results.push_back(std::move(r));
    }
  }
  if (options.reciprocal) {
    ReciprocityOutcome outcome = judge_reciprocity(name, bsdf, options);
    evidence.reciprocity = std::move(outcome.pairs);
    all.results.push_back(std::move(outcome.result));
  }
  if (black)
    all.results.push_back(nothing_sampled(name, options.contract, kBlackEverywhere, kWhyBlack));
  const bool failed = std::any_of(all.begin(), all.end(),
                                  [](const CheckResult& r) { return r.verdict == Verdict::fail; });
  if (failed) name_cause(diagnose(evidence), all);
  return all;
}

}  // namespace plumbline::verify
