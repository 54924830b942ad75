#include <cmath>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <plumbline/verify/bsdf.h>

#include "pairs/uniforms.h"

namespace plumbline::verify {

namespace {

/// Held by all functions of a pair together.
using Held = std::shared_ptr<const ErasedBsdf>;

/// A function of wo and something else, with wo fixed.
template <class R, class A>
struct FromDirection {
  Many<R(Vec3, A)> function;
  Vec3 wo;

  R operator()(const A& a) const { return function(wo, a); }
  void operator()(std::span<const A> a, std::span<R> out) const {
    function(std::vector<Vec3>(a.size(), wo), a, out);
  }
};

template <class R, class A>
Many<R(A)> from_direction(const Vec3& wo, const Many<R(Vec3, A)>& function) {
  if (!function) return {};
  return {FromDirection<R, A>{function, wo}, function.batch()};
}

/// f·|cosθ|
struct TimesCosine {
  Held bsdf;
  Many<Channels(Vec3)> f;

  void weigh(const Vec3& wi, Channels& value) const {
    const double cosine = bsdf->cosine_of(wi);
    for (std::size_t c = 0; c < value.count; ++c) value.value[c] *= cosine;
  }
  Channels operator()(const Vec3& wi) const {
    Channels value = f(wi);
    weigh(wi, value);
    return value;
  }
  void operator()(std::span<const Vec3> wi, std::span<Channels> out) const {
    f(wi, out);
    for (std::size_t i = 0; i < out.size(); ++i) weigh(wi[i], out[i]);
  }
};

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
    at.pdf = from_direction(wo, lobe.pdf);
    if (maps_a_square(lobe, wo)) {
      at.sample = from_direction(wo, lobe.sample);
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
  pair.sample = from_direction(wo, bsdf->sample);
  if (bsdf->draw) pair.draw = [bsdf, wo](Random& random) { return bsdf->draw(wo, random); };
  pair.pdf = from_direction(wo, bsdf->pdf);
  pair.value = {TimesCosine{bsdf, from_direction(wo, bsdf->eval)}, bsdf->eval.batch()};
  pair.lobes = lobes_at(bsdf, wo);
  for (const BsdfSuspect& s : options.suspects) {
    pair.suspects.push_back({s.name, [s, wo](const Vec3& wi) { return s.value(wo, wi); }});
  }
  return pair;
}

}  // namespace plumbline::verify
