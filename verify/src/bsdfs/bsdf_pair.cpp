#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include <plumbline/verify/bsdf.h>

#include "diagnosis/smith.h"
#include "pairs/uniforms.h"
#include "vec3.h"

namespace plumbline::verify {

namespace {

/// Held by all functions of a pair together.
using Held = std::shared_ptr<const ErasedBsdf>;

Suspect ratio_of_pdf(const char* name, const char* remark,
                     std::function<double(const Vec3&)> value) {
  Suspect s{name, std::move(value), remark};
  s.only_of = "pdf";
  s.as_is = true;
  return s;
}

Suspect ratio_of_value(const char* name, const char* remark,
                       std::function<double(const Vec3&)> value) {
  Suspect s = ratio_of_pdf(name, remark, std::move(value));
  s.only_of = "f·|cosθ|";
  return s;
}

void add_half_vector(std::vector<Suspect>& suspects, const Vec3& wo) {
  const auto half = [wo](const Vec3& wi) { return normalized(sum(wo, wi)); };
  suspects.push_back({"(4 wo·h)",
                      [wo, half](const Vec3& wi) { return 4 * std::abs(dot(wo, half(wi))); },
                      "half-vector Jacobian missing from pdf?"});
  suspects.push_back(
      {"(wo·h)", [wo, half](const Vec3& wi) { return std::abs(dot(wo, half(wi))); }});
  suspects.push_back({"cosθh", [half](const Vec3& wi) { return std::abs(half(wi)[2]); }});
  for (const double alpha : {0.01, 0.02, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 1.0}) {
    const std::string name = "G1(wi), GGX α≈" + std::to_string(alpha).substr(0, 4);
    suspects.push_back({"(" + name + ")", [alpha](const Vec3& wi) { return smith_g1(wi, alpha); }});
  }
}

void add_swapped(std::vector<Suspect>& suspects, const Held& bsdf, const Vec3& wo) {
  suspects.push_back(
      ratio_of_pdf("pdf(wi, wo)/pdf(wo, wi)", "wo and wi swapped in pdf relative to sample?",
                   [bsdf, wo](const Vec3& wi) { return bsdf->pdf(wi, wo) / bsdf->pdf(wo, wi); }));
  suspects.push_back(ratio_of_value(
      "f(wi, wo)/f(wo, wi)", "wo and wi swapped in eval relative to sample?",
      [bsdf, wo](const Vec3& wi) { return bsdf->eval(wi, wo)[0] / bsdf->eval(wo, wi)[0]; }));
}

void add_refraction(std::vector<Suspect>& suspects, const Vec3& wo, double eta) {
  suspects.push_back({"η²", [wo, eta](const Vec3& wi) {
                        if (wo[2] * wi[2] >= 0) return 1.0;
                        return wo[2] > 0 ? eta * eta : 1 / (eta * eta);
                      }});
}

bool same(const std::optional<SampleRecord>& a, const std::optional<SampleRecord>& b) {
  return a.has_value() == b.has_value() && (!a || a->x == b->x);
}

/// Whether the lobe's map is one of two numbers: it takes no third, or does nothing with it.
bool maps_a_square(const BsdfLobe& lobe, const Vec3& wo) {
  if (!lobe.sample || lobe.numbers < 3) return lobe.sample && lobe.numbers == 2;
  for (const double first : {0.1, 0.4, 0.9}) {
    for (const double second : {0.2, 0.7}) {
      const auto here = lobe.sample(wo, {first, second, 0});
      for (const double third : {0.05, 0.3, 0.6, 0.95}) {
        if (!same(here, lobe.sample(wo, {first, second, third}))) return false;
      }
    }
  }
  return true;
}

/// The lobes from one direction. One that takes a third number for something is drawn with the
/// check's own: it has no Jacobian, but a density that adds to the whole.
std::vector<PairLobe> lobes_at(const Held& bsdf, const Vec3& wo) {
  std::vector<PairLobe> lobes;
  for (std::size_t i = 0; i < bsdf->lobes.size(); ++i) {
    const BsdfLobe& lobe = bsdf->lobes[i];
    PairLobe at;
    at.name = "lobe " + std::to_string(i);
    at.probability = lobe.probability(wo);
    at.pdf = [bsdf, &lobe, wo](const Vec3& wi) { return lobe.pdf(wo, wi); };
    if (maps_a_square(lobe, wo)) {
      at.sample = [bsdf, &lobe, wo](const Uniforms& u) { return lobe.sample(wo, u); };
    } else if (lobe.draw) {
      at.draw = [bsdf, &lobe, wo](Random& random) { return lobe.draw(wo, random); };
    } else {
      at.draw = [bsdf, &lobe, wo](Random& random) {
        return lobe.sample(wo, draw_uniforms(random, lobe.numbers, bsdf->epsilon));
      };
    }
    lobes.push_back(std::move(at));
  }
  return lobes;
}

}  // namespace

SamplingPair bsdf_pair(const std::string& name, const ErasedBsdf& erased, const Vec3& wo,
                       const BsdfOptions& options) {
  const Held bsdf = std::make_shared<const ErasedBsdf>(erased);
  SamplingPair pair;
  pair.name = name;
  pair.domain = Domain::sphere();
  pair.numbers = bsdf->numbers;
  pair.epsilon = bsdf->epsilon;
  if (bsdf->sample) pair.sample = [bsdf, wo](const Uniforms& u) { return bsdf->sample(wo, u); };
  if (bsdf->draw) pair.draw = [bsdf, wo](Random& random) { return bsdf->draw(wo, random); };
  pair.pdf = [bsdf, wo](const Vec3& wi) { return bsdf->pdf(wo, wi); };
  pair.value = [bsdf, wo](const Vec3& wi) {
    Channels f = bsdf->eval(wo, wi);
    for (std::size_t c = 0; c < f.count; ++c) f.value[c] *= std::abs(wi[2]);
    return f;
  };
  pair.lobes = lobes_at(bsdf, wo);
  for (const BsdfSuspect& s : options.suspects) {
    pair.suspects.push_back({s.name, [s, wo](const Vec3& wi) { return s.value(wo, wi); }});
  }
  add_swapped(pair.suspects, bsdf, wo);
  add_half_vector(pair.suspects, wo);
  if (options.eta != 1) add_refraction(pair.suspects, wo, options.eta);
  return pair;
}

}  // namespace plumbline::verify
