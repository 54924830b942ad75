#include "diagnosis/diagnosis.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>

#include "text.h"

namespace plumbline::verify {

namespace {

// Below this nothing is named: better no guess than a wrong one.
constexpr double kGoodFit = 0.9;
// A factor on top of a suspect must earn itself.
constexpr double kFreeFactorPenalty = 0.02;
constexpr double kUnnamedPenalty = 0.002;
// Of fits as good as each other the first stands.
constexpr double kTie = 1e-4;
// From this share on, samples where the pdf is 0 say more than the ratio elsewhere.
constexpr double kManyStrays = 0.2;
constexpr std::size_t kEnoughPoints = 8;

constexpr double kPi = std::numbers::pi;

/// One way in which a ratio can come about.
struct Hypothesis {
  std::string formula;  // of the ratio
  std::string remark;
  std::function<double(const Vec3&)> ratio;
  /// If any: which of these comes closest is the ratio at a point.
  std::vector<std::function<double(const Vec3&)>> either = {};
};

struct Constant {
  double value;
  const char* formula;
};
constexpr Constant kConstants[] = {{2, "2"},          {0.5, "1/2"},
                                   {3, "3"},          {1.0 / 3, "1/3"},
                                   {4, "4"},          {0.25, "1/4"},
                                   {8, "8"},          {0.125, "1/8"},
                                   {kPi, "π"},        {1 / kPi, "1/π"},
                                   {2 * kPi, "2π"},   {1 / (2 * kPi), "1/(2π)"},
                                   {4 * kPi, "4π"},   {1 / (4 * kPi), "1/(4π)"},
                                   {kPi / 2, "π/2"},  {2 / kPi, "2/π"},
                                   {kPi * kPi, "π²"}, {1 / (kPi * kPi), "1/π²"}};

/// Weighted fit of log ratio by log hypothesis, with or without a free factor.
struct Fit {
  double r_squared = 0;
  double log_factor = 0;
};

class Fitter {
 public:
  Fitter(const RatioEvidence& evidence, std::vector<RatioPoint> points)
      : noise2_(evidence.noise * evidence.noise), points_(std::move(points)) {
    for (const RatioPoint& p : points_) {
      total_ += p.weight * std::pow(std::log(p.ratio), 2);
      weights_ += p.weight;
    }
  }

  std::size_t size() const { return points_.size(); }

  /// Noise expected in the sum of squares, per free number fitted.
  double explainable() const { return total_ - noise2_ * static_cast<double>(points_.size()); }

  std::optional<Fit> fit(const Hypothesis& hypothesis, bool free_factor) const {
    std::vector<double> rest;
    rest.reserve(points_.size());
    double mean = 0;
    for (const RatioPoint& p : points_) {
      const double model = closest(hypothesis, p);
      if (!(model > 0) || !std::isfinite(model)) return std::nullopt;
      rest.push_back(std::log(p.ratio) - std::log(model));
      mean += p.weight * rest.back() / weights_;
    }
    Fit fit;
    fit.log_factor = free_factor ? mean : 0;
    double left = 0;
    for (std::size_t i = 0; i < rest.size(); ++i) {
      left += points_[i].weight * std::pow(rest[i] - fit.log_factor, 2);
    }
    left = std::max(0.0, left - noise2_ * static_cast<double>(points_.size()));
    fit.r_squared = explainable() > 0 ? 1 - left / explainable() : 0;
    return fit;
  }

 private:
  static double closest(const Hypothesis& hypothesis, const RatioPoint& p) {
    if (hypothesis.either.empty()) return hypothesis.ratio(p.x);
    double best = 0, distance = std::numeric_limits<double>::infinity();
    for (const auto& ratio : hypothesis.either) {
      const double value = ratio(p.x);
      const double d = std::abs(std::log(value / p.ratio));
      if (d < distance) {
        best = value;
        distance = d;
      }
    }
    return best;
  }

  double noise2_;
  std::vector<RatioPoint> points_;
  double total_ = 0, weights_ = 0;
};

std::string name_constant(double factor) {
  for (const Constant& c : kConstants) {
    if (std::abs(factor / c.value - 1) < 0.005) return c.formula;
  }
  return number(std::round(factor * 1e5) / 1e5);
}

void add_factor(std::vector<Hypothesis>& list, const RatioEvidence& e, const Suspect& suspect) {
  const auto value = suspect.value;
  const std::string& name = suspect.name;
  const bool compound = name.find(' ') != std::string::npos && name.front() != '(';
  const std::string group = compound ? "(" + name + ")" : name;
  list.push_back({name, "factor " + name + " missing from " + e.denominator + "?", value});
  const std::string inverse_remark = suspect.remark_if_inverse.empty()
                                         ? "factor " + name + " too many in " + e.denominator + "?"
                                         : suspect.remark_if_inverse;
  list.push_back({"1/" + group, inverse_remark, [value](const Vec3& x) { return 1 / value(x); }});
  list.push_back({group + "²", "factor " + name + " missing twice from " + e.denominator + "?",
                  [value](const Vec3& x) { return value(x) * value(x); }});
  list.push_back({"1/" + group + "²",
                  name + " in the place of 1/" + group + " in " + e.denominator + "?",
                  [value](const Vec3& x) { return 1 / (value(x) * value(x)); }});
}

void add_mirrored(std::vector<Hypothesis>& list, const SamplingPair& pair) {
  const auto add = [&](const char* formula, const char* remark, Vec3 signs) {
    list.push_back(
        {formula, remark, [&pair, signs](const Vec3& x) {
           return pair.pdf({signs[0] * x[0], signs[1] * x[1], signs[2] * x[2]}) / pair.pdf(x);
         }});
  };
  add("pdf(−x, −y, z)/pdf(x, y, z)", "the horizontal part of a direction has its sign changed?",
      {-1, -1, 1});
  add("pdf(x, y, −z)/pdf(x, y, z)", "wrong hemisphere?", {1, 1, -1});
  add("pdf(−x, −y, −z)/pdf(x, y, z)", "direction negated?", {-1, -1, -1});
  list.push_back({"pdf(y, x, z)/pdf(x, y, z)", "x and y exchanged?", [&pair](const Vec3& x) {
                    return pair.pdf({x[1], x[0], x[2]}) / pair.pdf(x);
                  }});
}

/// The size of the domain, as something to be confused with its inverse. On the sphere it is a
/// constant that has a name.
void add_extent(std::vector<Hypothesis>& list, const SamplingPair& pair, const RatioEvidence& e) {
  constexpr int kSteps = 64;
  if (pair.domain.dimension() == 0 || pair.domain.directions()) return;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j < kSteps; ++j) {
      sum += pair.domain.chart().element({(i + 0.5) / kSteps, (j + 0.5) / kSteps});
    }
  }
  const double extent = sum / (kSteps * kSteps);
  if (std::abs(extent - 1) < 0.01) return;
  const std::string name = pair.domain.dimension() == 1 ? "length" : "area";
  Suspect suspect{name, [extent](const Vec3&) { return extent; }};
  suspect.remark_if_inverse = "1/" + name + " missing from " + e.denominator + "?";
  add_factor(list, e, suspect);
}

double sum_of_lobes(const SamplingPair& pair, const Vec3& x, bool with_probability) {
  double sum = 0;
  for (const PairLobe& lobe : pair.lobes) {
    sum += (with_probability ? lobe.probability : 1.0) * lobe.pdf(x);
  }
  return sum;
}

void add_lobes(std::vector<Hypothesis>& list, const SamplingPair& pair) {
  list.push_back(
      {"(Σ P·lobe pdf)/(Σ lobe pdf)", "lobe probability missing from pdf?", [&pair](const Vec3& x) {
         return sum_of_lobes(pair, x, true) / sum_of_lobes(pair, x, false);
       }});
  list.push_back({"(Σ P·lobe pdf)/pdf", "lobe probabilities wrong in pdf?",
                  [&pair](const Vec3& x) { return sum_of_lobes(pair, x, true) / pair.pdf(x); }});
  Hypothesis alone{"lobe pdf/pdf", "pdf of the chosen lobe in the place of the mixture's?", {}, {}};
  Hypothesis share{"P·lobe pdf/pdf", "one lobe's part over the pdf of the whole mixture?", {}, {}};
  for (const PairLobe& lobe : pair.lobes) {
    alone.either.push_back([&](const Vec3& x) { return lobe.pdf(x) / pair.pdf(x); });
    share.either.push_back(
        [&](const Vec3& x) { return lobe.probability * lobe.pdf(x) / pair.pdf(x); });
  }
  list.push_back(std::move(alone));
  list.push_back(std::move(share));
}

std::vector<Hypothesis> hypotheses(const SamplingPair& pair, const RatioEvidence& e) {
  std::vector<Hypothesis> list;
  for (const Suspect& s : pair.suspects) {
    if (!s.only_of.empty() && s.only_of != e.denominator) continue;
    if (s.as_is) {
      list.push_back({s.name, s.remark_if_inverse, s.value});
    } else {
      add_factor(list, e, s);
    }
  }
  if (pair.domain.directions()) {
    add_factor(list, e, {"cosθ", [](const Vec3& w) { return std::abs(w[2]); }});
    add_factor(list, e, {"sinθ", [](const Vec3& w) { return std::hypot(w[0], w[1]); }});
    add_mirrored(list, pair);
  }
  add_extent(list, pair, e);
  if (!pair.lobes.empty()) add_lobes(list, pair);
  return list;
}

std::string describe_fit(const std::string& formula, double r_squared, const std::string& remark) {
  char fit[16];
  std::snprintf(fit, sizeof fit, "%.3f", r_squared);
  return formula + " (R² " + fit + "): " + remark;
}

/// A constant factor; one without a name must fit better than what has one.
void consider_constant(const Fitter& fitter, const RatioEvidence& e, Diagnosis& best) {
  const Hypothesis one{"1", {}, [](const Vec3&) { return 1.0; }};
  const auto fit = fitter.fit(one, true);
  if (!fit) return;
  const std::string factor = name_constant(std::exp(fit->log_factor));
  const double penalty = factor.find('.') == std::string::npos ? 0 : kUnnamedPenalty;
  if (!(fit->r_squared - penalty > best.r_squared)) return;
  best.r_squared = fit->r_squared - penalty;
  best.constant = std::exp(fit->log_factor);
  best.text = describe_fit(e.quotient + " = " + factor, fit->r_squared,
                           "constant factor " + factor + " missing from " + e.denominator + "?");
}

void consider(const Fitter& fitter, const RatioEvidence& e, const Hypothesis& h, Diagnosis& best) {
  const auto plain = fitter.fit(h, false);
  if (plain && plain->r_squared > best.r_squared + kTie) {
    best.r_squared = plain->r_squared;
    best.constant = kNotApplicable;
    best.text = describe_fit(e.quotient + " = " + h.formula, plain->r_squared, h.remark);
  }
  if (!h.either.empty()) return;
  const auto scaled = fitter.fit(h, true);
  if (scaled && scaled->r_squared - kFreeFactorPenalty > best.r_squared + kTie) {
    best.r_squared = scaled->r_squared - kFreeFactorPenalty;
    best.constant = kNotApplicable;
    best.text = describe_fit(
        e.quotient + " = " + name_constant(std::exp(scaled->log_factor)) + " · " + h.formula,
        scaled->r_squared, h.remark + " And a constant factor?");
  }
}

/// Samples where the pdf is 0: on the other side, or just outside a support that is too small.
Diagnosis diagnose_strays(const SamplingPair& pair, const RatioEvidence& e) {
  if (e.strays.empty()) return {};
  const double count = static_cast<double>(e.strays.size());
  const auto share = [&](Vec3 signs) {
    double hits = 0;
    for (const Vec3& x : e.strays) {
      hits += pair.pdf({signs[0] * x[0], signs[1] * x[1], signs[2] * x[2]}) > 0 ? 1 : 0;
    }
    return hits / count;
  };
  const std::string some = number(std::round(1e4 * e.stray_share) / 100) +
                           " % of the samples lie " + "where the pdf is 0";
  if (pair.domain.directions() && share({1, 1, -1}) > kGoodFit) {
    return {some + ", mirrored at the horizon it is not: wrong hemisphere?", share({1, 1, -1})};
  }
  if (pair.domain.directions() && share({-1, -1, 1}) > kGoodFit) {
    return {some + ", with x and y negated it is not: sign of the horizontal part?",
            share({-1, -1, 1})};
  }
  return {some + ": support of the pdf too small?", kGoodFit};
}

}  // namespace

Diagnosis diagnose(const SamplingPair& pair, const RatioEvidence& evidence) {
  std::vector<RatioPoint> usable;
  for (const RatioPoint& p : evidence.points) {
    if (p.ratio > 0 && std::isfinite(p.ratio) && p.weight > 0) usable.push_back(p);
  }
  Diagnosis best;
  best.r_squared = kGoodFit;
  const Fitter fitter(evidence, std::move(usable));
  if (fitter.size() >= kEnoughPoints && fitter.explainable() > 0) {
    for (const Hypothesis& h : hypotheses(pair, evidence)) consider(fitter, evidence, h, best);
    consider_constant(fitter, evidence, best);
  }
  const Diagnosis strays = diagnose_strays(pair, evidence);
  if (!strays.text.empty() && (best.text.empty() || evidence.stray_share > kManyStrays)) {
    return strays;
  }
  return best.text.empty() ? Diagnosis{} : best;
}

}  // namespace plumbline::verify
