#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <utility>

#include <plumbline/verify/bsdf.h>

#include "diagnosis/constant_diagnosis.h"
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
  return std::any_of(results.begin(), results.end(),
                     [](const CheckResult& r) { return r.figure(Figure::atoms).value_or(0) > 0; });
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
  r.kind = CheckKind::samples;
  r.subject = name + "/samples";
  r.seed = options.contract.seed;
  r.reason =
      "no direction gives any sample: are the frame and the side that the given direction points "
      "to as the conventions say?";
  return r;
}

}  // namespace

Report check_bsdf(const std::string& name, const ErasedBsdf& bsdf, const BsdfOptions& options) {
  Report all;
  ConstantByView constants;
  const std::vector<View> views = views_of(options);
  bool black = true;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const View& view = views[i];
    const BsdfOptions here = for_view(options, i);
    const std::string subject = name + "/" + view.name;
    const SamplingPair pair = bsdf_pair(subject, bsdf, view.wo, here);
    black = black && !gives_samples(pair, here.contract.seed);
    PairOutcome outcome = judge_pair(pair, here.contract);
    constants.add(view.wo, outcome.cause);
    std::vector<CheckResult>& results = outcome.results;
    if (options.conserves_energy || options.albedo) {
      results.push_back(check_energy(subject, bsdf, view.wo, here));
    }
    if (saw_atoms(results)) results.push_back(check_atoms(subject, bsdf, view.wo, here));
    for (CheckResult& r : results) {
      if (!r.as_expected()) r.reason += "; wo = " + place(view.wo) + ", z the normal";
      all.results.push_back(std::move(r));
    }
  }
  if (options.reciprocal) all.results.push_back(check_reciprocity(name, bsdf, options));
  if (black) all.results.push_back(black_everywhere(name, options));
  const std::string of_view = constants.diagnosis();
  for (CheckResult& r : all) {
    if (!of_view.empty() && !r.diagnosis.empty()) r.diagnosis = of_view;
  }
  return all;
}

}  // namespace plumbline::verify
