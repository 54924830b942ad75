#include "diagnosis/hypothesis.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "diagnosis/fit.h"

namespace plumbline::verify {

namespace {

std::optional<Explanation> try_one(const Observations& observations, const Hypothesis& h) {
  Explanation e;
  e.hypothesis = &h;
  const std::size_t views = observations.views().size();
  e.numbers.resize(views);
  double free = 0, tested = 0;
  const bool fitted = !h.starts.empty();
  std::vector<double> of_all;
  if (fitted && !h.per_view) of_all = fit_parameters(observations, h.prediction, h.starts, -1);
  for (const std::size_t v : observations.order()) {
    e.numbers[v] = of_all;
    const ViewObservations& view = observations.views()[v];
    if (view.exact.empty() && view.bins.empty()) continue;
    if (fitted && h.per_view) {
      e.numbers[v] = fit_parameters(observations, h.prediction, h.starts, static_cast<int>(v));
      free += static_cast<double>(h.starts.front().size());
    }
    const Fit fit = observations.judge_view(v, h.prediction, e.numbers[v]);
    if (!fit.admissible) return std::nullopt;
    tested += static_cast<double>(fit.tested);
    e.worst = std::max(e.worst, fit.worst);
  }
  if (tested == 0) return std::nullopt;
  if (fitted && !h.per_view) free = static_cast<double>(h.starts.front().size());
  // Views that show nothing have no numbers of their own: they take those of one that does.
  for (auto& numbers : e.numbers) {
    if (numbers.empty()) numbers = e.numbers[observations.order().front()];
  }
  const std::optional<double> charge = h.charge ? h.charge(e.numbers) : 0.0;
  if (!charge) return std::nullopt;
  e.cost = kPerNumber * free + h.complexity + *charge;
  return e;
}

/// Whether an explanation says what the blamed function says, and elsewhere nothing: it leaves out
/// what it should explain.
bool says_the_same(const Observations& seen, const Explanation& e) {
  constexpr double kSame = 1e-6;
  for (std::size_t v = 0; v < seen.views().size(); ++v) {
    const auto differs = [&](const Place& p) {
      const double predicted = e.hypothesis->prediction(p, e.numbers[v]);
      return predicted != kNothingSaid && !(std::abs(predicted - p.base) <= kSame * p.base);
    };
    for (const CountedBin& bin : seen.views()[v].bins) {
      if (std::any_of(bin.nodes.begin(), bin.nodes.end(), differs)) return false;
    }
    for (const ExactPoint& point : seen.views()[v].exact) {
      if (differs(point.place)) return false;
    }
  }
  return true;
}

}  // namespace

std::vector<Explanation> explain(const Observations& observations,
                                 const std::vector<Hypothesis>& hypotheses) {
  std::vector<Explanation> admissible;
  constexpr std::size_t kFewestExact = 40;
  for (const Hypothesis& h : hypotheses) {
    if (h.needs_exact && observations.exact() < kFewestExact) continue;
    auto e = try_one(observations, h);
    if (e && !says_the_same(observations, *e)) admissible.push_back(std::move(*e));
  }
  std::stable_sort(admissible.begin(), admissible.end(),
                   [](const Explanation& a, const Explanation& b) { return a.cost < b.cost; });
  return admissible;
}

double error_of_constant(const Observations& observations) {
  constexpr double kPulls = 4;
  std::vector<double> errors;
  double counts = 0, bins = 0;
  for (const ViewObservations& v : observations.views()) {
    for (const ExactPoint& p : v.exact) errors.push_back(p.error);
    for (const CountedBin& b : v.bins) counts += b.observed;
    bins += static_cast<double>(v.bins.size());
  }
  // A fit looks at so many of the bins.
  constexpr double kFitted = 240;
  if (bins > kFitted) counts *= kFitted / bins;
  double error = counts > 0 ? kPulls / std::sqrt(counts) : 0.5;
  if (errors.size() >= 8) {
    const auto middle = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2);
    std::nth_element(errors.begin(), middle, errors.end());
    error = std::min(error, kPulls * *middle + 1e-8);
  }
  return error;
}

namespace {

struct Usual {
  double value;
  const char* name;
};
using std::numbers::pi;
constexpr Usual kUsual[] = {{2, "2"},
                            {3, "3"},
                            {4, "4"},
                            {5, "5"},
                            {6, "6"},
                            {8, "8"},
                            {9, "9"},
                            {10, "10"},
                            {12, "12"},
                            {16, "16"},
                            {pi, "π"},
                            {2 * pi, "2π"},
                            {4 * pi, "4π"},
                            {8 * pi, "8π"},
                            {pi / 2, "π/2"},
                            {pi / 3, "π/3"},
                            {pi / 4, "π/4"},
                            {pi * pi, "π²"},
                            {2 * pi * pi, "2π²"},
                            {1.5, "3/2"},
                            {4.0 / 3, "4/3"},
                            {pi / 6, "π/6"},
                            {4 * pi / 3, "4π/3"},
                            {std::numbers::sqrt2, "√2"}};

}  // namespace

double nearest_usual_constant(double value) {
  double best = 1, distance = std::abs(std::log(value));
  for (const Usual& u : kUsual) {
    for (const double c : {u.value, 1 / u.value}) {
      if (std::abs(std::log(value / c)) >= distance) continue;
      distance = std::abs(std::log(value / c));
      best = c;
    }
  }
  return best;
}

std::string usual_constant(double value, double error) {
  std::string name;
  int found = 0;
  for (const Usual& u : kUsual) {
    const bool direct = std::abs(std::log(value / u.value)) <= error;
    const bool inverse = std::abs(std::log(value * u.value)) <= error;
    if (!direct && !inverse) continue;
    ++found;
    const std::string text = u.name;
    if (direct) {
      name = text;
    } else if (const auto slash = text.find('/'); slash != std::string::npos) {
      name = text.substr(slash + 1) + "/" + text.substr(0, slash);
    } else {
      name = "1/" + (text.size() > 2 && text.substr(0, 2) != "1" ? "(" + text + ")" : text);
    }
  }
  return found == 1 ? name : std::string();
}

std::vector<Hypothesis> all_hypotheses(const ReportEvidence& evidence, const Blame& blame,
                                       const Observations& observations, bool of_value) {
  std::vector<Hypothesis> all;
  const auto add = [&all](std::vector<Hypothesis> more) {
    std::move(more.begin(), more.end(), std::back_inserter(all));
  };
  add(constant_hypotheses(evidence, blame, observations));
  add(factor_hypotheses(evidence, blame, observations));
  add(argument_hypotheses(evidence, blame, of_value));
  add(parametric_hypotheses(evidence, blame, observations));
  add(light_hypotheses(evidence, blame));
  if (!of_value) add(number_hypotheses(evidence, blame));
  if (!of_value) add(mixture_hypotheses(evidence, blame, observations));
  return all;
}

}  // namespace plumbline::verify
