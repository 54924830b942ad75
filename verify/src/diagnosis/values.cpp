#include "diagnosis/values.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "diagnosis/geometry.h"
#include "text.h"

namespace plumbline::verify {

namespace {

constexpr double kAllowed = 4;
constexpr double kRatioRounding = 1e-9;

using OfPair = std::function<double(const Vec3& wo, const Vec3& wi)>;

bool measured(const ReciprocityAt& r) { return r.ratio > 0 && std::isfinite(r.ratio); }

/// f = f₀ X, f₀ reciprocal: the ratio is X(wo, wi)/X(wi, wo).
bool explains(const ReportEvidence& evidence, const OfPair& x) {
  std::size_t outliers = 0, tested = 0;
  for (const ReciprocityAt& r : evidence.reciprocity) {
    if (!measured(r)) continue;
    ++tested;
    const double residual =
        std::abs(std::log(r.ratio) - std::log(x(r.wo, r.wi)) + std::log(x(r.wi, r.wo)));
    if (!(residual <= kAllowed * r.error + kRatioRounding)) ++outliers;
    // A few pairs at a clamp or an edge have no ratio to speak of.
    if (outliers > 2 + evidence.reciprocity.size() / 500) return false;
  }
  return tested >= 8;
}

/// The number for which X explains the pairs, if there is one: where the sum of squares on every
/// other pair is least.
std::optional<double> fitted(const ReportEvidence& evidence,
                             const std::function<OfPair(double)>& of_number,
                             const std::vector<double>& starts) {
  const auto cost = [&](double n) {
    const OfPair x = of_number(n);
    double sum = 0;
    const std::size_t step = 2 * std::max<std::size_t>(1, evidence.reciprocity.size() / 400);
    for (std::size_t i = 0; i < evidence.reciprocity.size(); i += step) {
      const ReciprocityAt& r = evidence.reciprocity[i];
      if (!measured(r)) continue;
      const double d = std::log(r.ratio) - std::log(x(r.wo, r.wi)) + std::log(x(r.wi, r.wo));
      sum += std::isfinite(d) ? d * d : 1e6;
    }
    return sum;
  };
  double best = starts.front();
  for (const double s : starts) best = cost(s) < cost(best) ? s : best;
  // Gauss-Newton in one number, by differences.
  const auto residuals = [&](double n) {
    const OfPair x = of_number(n);
    std::vector<double> out;
    const std::size_t step = 2 * std::max<std::size_t>(1, evidence.reciprocity.size() / 400);
    for (std::size_t i = 0; i < evidence.reciprocity.size(); i += step) {
      const ReciprocityAt& r = evidence.reciprocity[i];
      if (!measured(r)) continue;
      const double d = std::log(r.ratio) - std::log(x(r.wo, r.wi)) + std::log(x(r.wi, r.wo));
      out.push_back(std::isfinite(d) ? d : 0);
    }
    return out;
  };
  double damping = 1e-3;
  for (int i = 0; i < 60 && damping < 1e9; ++i) {
    constexpr double kStep = 1e-6;
    const auto here = residuals(best), above = residuals(best + kStep),
               below = residuals(best - kStep);
    double slope2 = 0, slope_r = 0;
    for (std::size_t k = 0; k < here.size(); ++k) {
      const double s = (above[k] - below[k]) / (2 * kStep);
      slope2 += s * s;
      slope_r += s * here[k];
    }
    if (!(slope2 > 0)) break;
    const double next = best - slope_r / (slope2 * (1 + damping));
    if (cost(next) < cost(best)) {
      best = next;
      damping /= 8;
    } else {
      damping *= 8;
    }
  }
  if (!explains(evidence, of_number(best))) return std::nullopt;
  return best;
}

}  // namespace

bool reciprocity_fails(const ReportEvidence& evidence) {
  return std::any_of(evidence.reciprocity.begin(), evidence.reciprocity.end(),
                     [](const ReciprocityAt& r) {
                       return measured(r) && std::abs(std::log(r.ratio)) > 4 * r.error + 1e-9;
                     });
}

bool explains_reciprocity(const ReportEvidence& evidence, const Prediction& prediction,
                          std::span<const double> numbers) {
  if (evidence.views.empty() || evidence.reciprocity.empty()) return true;
  const ViewEvidence* view = &evidence.views.front();
  return explains(evidence, [&](const Vec3& wo, const Vec3& wi) {
    // A factor that is missing from f is in it as its inverse.
    return 1 / prediction({view, wo, wi, 1}, numbers);
  });
}

std::vector<Finding> explain_asymmetry(const ReportEvidence& evidence) {
  std::vector<Finding> found;
  const double eta = evidence.views.empty() ? 1 : evidence.views.front().eta;
  struct Fixed {
    CauseKind kind;
    const char* words;
    OfPair x;
  };
  const auto cosine = [](const Vec3&, const Vec3& wi) { return std::abs(wi[2]); };
  const auto index2 = [eta](const Vec3& wo, const Vec3& wi) {
    if (!transmits(wo, wi)) return 1.0;
    return wo[2] > 0 ? eta * eta : 1 / (eta * eta);
  };
  std::vector<Fixed> fixed = {
      {CauseKind::value_cosine,
       "f holds cosθi once too often: the cosine is applied twice, or is that of the wrong "
       "direction",
       cosine},
      {CauseKind::value_cosine,
       "f is divided by cosθi once too often, or by cosθi instead of cosθo",
       [cosine](const Vec3& wo, const Vec3& wi) { return 1 / cosine(wo, wi); }},
      {CauseKind::value_cosine, "f holds cosθi twice too often",
       [cosine](const Vec3& wo, const Vec3& wi) { return std::pow(cosine(wo, wi), 2); }},
      {CauseKind::value_cosine, "f is divided by cosθi² in place of cosθi cosθo",
       [cosine](const Vec3& wo, const Vec3& wi) { return std::pow(cosine(wo, wi), -2); }}};
  if (eta != 1) {
    for (const double power : {-0.5, 0.5, -1.0, 1.0}) {
      // Half a power in X is a whole in the ratio, which holds it both ways.
      fixed.push_back({CauseKind::eta_squared,
                       std::abs(power) < 1 ? "the factor η_o²/η_i² of radiance across the "
                                             "refraction is missing from f, or one too many"
                                           : "the factor η_o²/η_i² of radiance across the "
                                             "refraction is upside down in f, or there twice",
                       [index2, power](const Vec3& wo, const Vec3& wi) {
                         return std::pow(index2(wo, wi), power);
                       }});
    }
    const auto half_dot = [eta](const Vec3& wo, const Vec3& wi) {
      if (!transmits(wo, wi)) return 1.0;
      return std::abs(dot(wi, half_vector_of(wo, wi, eta)));
    };
    for (const double power : {1.0, -1.0}) {
      fixed.push_back({CauseKind::refraction_jacobian,
                       "|wi·h| of the refraction stands in f once too often or not at all",
                       [half_dot, power](const Vec3& wo, const Vec3& wi) {
                         return std::pow(half_dot(wo, wi), power);
                       }});
    }
  }
  for (const Fixed& f : fixed) {
    if (explains(evidence, f.x)) found.push_back({f.kind, f.words});
  }
  if (!found.empty()) return found;
  const std::vector<double> roughnesses = {-5.5, -4.0, -3.0, -2.0, -1.2, -0.6, 0.0};
  for (const double power : {1.0, -1.0}) {
    const auto masking = [power](double n) -> OfPair {
      return [power, a = std::exp(n)](const Vec3&, const Vec3& wi) {
        return std::pow(smith_g1(wi, a), power);
      };
    };
    if (const auto n = fitted(evidence, masking, roughnesses)) {
      found.push_back(
          {CauseKind::masking, std::string("masking G1 of ") + (power > 0 ? "wo" : "wi") +
                                   " is missing from f (GGX, α = " + number(std::exp(*n)) + ")"});
    }
    const auto schlick = [power](double n) -> OfPair {
      return [power, f0 = 1 / (1 + std::exp(-n))](const Vec3& wo, const Vec3&) {
        return std::pow(fresnel_schlick(wo[2], f0), power);
      };
    };
    if (const auto n = fitted(evidence, schlick, {-3.2, -1.0, 0.5})) {
      found.push_back(
          {CauseKind::fresnel,
           "Fresnel in f is of the cosine of one direction, not of wo·h (Schlick, F0 = " +
               number(1 / (1 + std::exp(-*n))) + ")"});
    }
  }
  if (!found.empty()) return found;
  found.push_back({CauseKind::asymmetric, "f(wo, wi) and f(wi, wo) differ"});
  return found;
}

bool energy_fails(const ReportEvidence& evidence) {
  return std::any_of(evidence.albedos.begin(), evidence.albedos.end(), [](const AlbedoAt& a) {
    const double excess = a.known ? std::abs(a.albedo - *a.known) : a.albedo - 1;
    return excess > a.error + 1e-3;
  });
}

std::vector<Finding> explain_energy(const ReportEvidence& evidence) {
  std::vector<Finding> found;
  // Against what is known: the same usual constant from everywhere.
  double low = 1e300, high = -1e300;
  bool known = !evidence.albedos.empty();
  for (const AlbedoAt& a : evidence.albedos) {
    if (!a.known || !(*a.known > 0) || !(a.albedo > 0)) {
      known = false;
      continue;
    }
    const double ratio = std::log(a.albedo / *a.known);
    const double error = a.error / a.albedo + 1e-3;
    low = std::min(low, ratio + error);
    high = std::max(high, ratio - error);
  }
  if (known && high <= low) {
    const std::string c = usual_constant(std::exp((low + high) / 2), (low - high) / 2 + 1e-9);
    found.push_back({CauseKind::value_constant,
                     "f is " + (c.empty() ? number(std::exp((low + high) / 2)) : c) +
                         " times what the known albedo asks for, from every direction"});
    return found;
  }
  // Without: the same albedo from everywhere, and so far above 1 that 2 or π is missing rather than
  // a few percent too many.
  constexpr double kFactor = 1.5;
  double least = 1e300, most = 0;
  for (const AlbedoAt& a : evidence.albedos) {
    least = std::min(least, a.albedo);
    most = std::max(most, a.albedo);
  }
  if (!known && most > kFactor && most - least < 5e-3 * most) {
    found.push_back({CauseKind::value_constant,
                     "the albedo is " + number(most) +
                         " from every direction: 1/π or another constant is missing from f"});
  }
  found.push_back(
      {CauseKind::energy, "f gives off more than arrives: the albedo reaches " + number(most)});
  return found;
}

}  // namespace plumbline::verify
