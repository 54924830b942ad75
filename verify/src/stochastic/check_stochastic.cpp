#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <plumbline/verify/stochastic.h>

#include "means/joint_agreement.h"
#include "pairs/battery.h"
#include "pairs/uniforms.h"
#include "stochastic/views.h"
#include "streams.h"
#include "text.h"

namespace plumbline::verify {

namespace {

constexpr int kPilotOfView = 1 << 15;
constexpr int kDepthOfViewRegions = 3;

/// One for each angle and side, at a random azimuth.
std::vector<std::pair<Vec3, std::string>> stochastic_views(const StochasticOptions& options) {
  Random random = random_for(options.seed, Stream::stochastic_views);
  std::vector<std::pair<Vec3, std::string>> views;
  for (const bool front : {true, false}) {
    if (!(front ? options.front : options.back)) continue;
    for (const double degrees : options.angles) {
      const double theta = degrees * std::numbers::pi / 180;
      const double phi = 2 * std::numbers::pi * random.uniform();
      char name[48];
      std::snprintf(name, sizeof name, "%s %.4g°", front ? "front" : "back", degrees);
      views.emplace_back(Vec3{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                              (front ? 1 : -1) * std::cos(theta)},
                         name);
    }
  }
  return views;
}

void refuse_senseless_views(const StochasticBsdf& bsdf, const StochasticOptions& options) {
  if (!bsdf.sample || !bsdf.eval) {
    throw std::invalid_argument("BSDF '" + bsdf.name + "': needs `sample` and `eval`");
  }
  for (const double degrees : options.angles) {
    if (!(degrees >= 0 && degrees < 90)) {
      throw std::invalid_argument("BSDF '" + bsdf.name + "': angles are from 0 to below 90");
    }
  }
}

}  // namespace

StochasticView::StochasticView(const StochasticBsdf& of, const StochasticOptions& how,
                               const Vec3& from, std::string name, std::uint64_t seed_of_its_own)
    : bsdf(of),
      options(how),
      wo(from),
      subject(std::move(name)),
      seed(seed_of_its_own),
      pilot(draw_pilot()),
      regions(Domain::sphere(), pilot, kDepthOfViewRegions) {}

std::vector<Vec3> StochasticView::draw_pilot() {
  Random random = random_for(seed, Stream::stochastic_pilot);
  channels = bsdf.eval(wo, wo, random).count;
  std::vector<Vec3> directions;
  for (int i = 0; i < kPilotOfView; ++i) {
    const std::optional<SampleRecord> s = bsdf.sample(wo, random);
    if (!s) continue;
    black = false;
    if (!is_atom(*s)) directions.push_back(s->x);
  }
  return directions;
}

MeanOptions mean_options(const StochasticView& view, const std::string& check) {
  MeanOptions o;
  o.subject = view.subject + "/" + check;
  o.seed = view.options.seed;
  o.budget = view.options.budget;
  o.tolerance = view.options.tolerance;
  o.n0 = kFirstJointLook;
  o.max_samples = view.options.max_samples;
  return o;
}

double pdf_or_nan(double pdf) { return pdf >= 0 ? pdf : std::numeric_limits<double>::quiet_NaN(); }

Report check_stochastic_bsdf(const StochasticBsdf& bsdf, const StochasticOptions& options) {
  refuse_senseless_views(bsdf, options);
  Report all;
  bool black = !options.angles.empty();
  std::uint64_t seed = options.seed;
  for (const auto& [wo, name] : stochastic_views(options)) {
    seed += 0x9e3779b97f4a7c15u;  // each view draws numbers of its own
    const StochasticView view(bsdf, options, wo, bsdf.name + "/" + name, seed);
    black = black && view.black;
    std::vector<CheckResult> results{check_eval_mean(view)};
    if (bsdf.pdf && options.unbiased_pdf) results.push_back(check_pdf_mean(view));
    if (bsdf.pdf && options.mis) results.push_back(check_mis_mean(view));
    if (options.albedo) results.push_back(check_known_albedo(view));
    for (CheckResult& r : results) {
      if (!r.as_expected()) r.reason += "; wo = " + place(wo) + ", z the normal";
      all.results.push_back(std::move(r));
    }
  }
  if (options.reciprocal && (options.front || options.back)) {
    all.results.push_back(check_stochastic_reciprocity(bsdf, options));
  }
  if (black) {
    ContractOptions contract;
    contract.seed = options.seed;
    all.results.push_back(nothing_sampled(
        bsdf.name, contract, "no direction gives any sample, so that nothing was tested",
        "look from a side that it scatters on"));
  }
  return all;
}

StochasticBsdf stochastic_bsdf(std::string name, const ErasedBsdf& bsdf) {
  StochasticBsdf s;
  s.name = std::move(name);
  s.sample = [bsdf](const Vec3& wo, Random& random) {
    return bsdf.draw ? bsdf.draw(wo, random)
                     : bsdf.sample(wo, draw_uniforms(random, bsdf.numbers, bsdf.epsilon));
  };
  s.eval = [bsdf](const Vec3& wo, const Vec3& wi, Random&) { return bsdf.eval(wo, wi); };
  s.pdf = [bsdf](const Vec3& wo, const Vec3& wi, Random&) { return bsdf.pdf(wo, wi); };
  return s;
}

}  // namespace plumbline::verify
