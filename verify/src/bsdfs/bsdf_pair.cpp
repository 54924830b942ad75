#include <cmath>
#include <string>

#include <plumbline/verify/bsdf.h>

namespace plumbline::verify {

namespace {

PairSample to_pair_sample(const BsdfRecord& record) {
  return {record.wi, record.pdf, record.mass, record.weight};
}

std::optional<PairSample> to_pair_sample(const std::optional<BsdfRecord>& record) {
  if (!record) return std::nullopt;
  return to_pair_sample(*record);
}

std::vector<PairLobe> lobes_at(const ErasedBsdf& bsdf, const Vec3& wo) {
  std::vector<PairLobe> lobes;
  for (std::size_t i = 0; i < bsdf.lobes.size(); ++i) {
    const BsdfLobe& lobe = bsdf.lobes[i];
    lobes.push_back({"lobe " + std::to_string(i), lobe.probability(wo),
                     [lobe, wo](const Uniforms& u) { return to_pair_sample(lobe.sample(wo, u)); },
                     [lobe, wo](const Vec3& wi) { return lobe.pdf(wo, wi); }});
  }
  return lobes;
}

}  // namespace

SamplingPair bsdf_pair(const std::string& name, const ErasedBsdf& bsdf, const Vec3& wo,
                       const BsdfOptions& options) {
  SamplingPair pair;
  pair.name = name;
  pair.domain = Domain::sphere();
  pair.numbers = bsdf.numbers;
  pair.epsilon = bsdf.epsilon;
  if (bsdf.sample) {
    pair.sample = [bsdf, wo](const Uniforms& u) { return to_pair_sample(bsdf.sample(wo, u)); };
  }
  if (bsdf.draw) {
    pair.draw = [bsdf, wo](Random& random) { return to_pair_sample(bsdf.draw(wo, random)); };
  }
  pair.pdf = [bsdf, wo](const Vec3& wi) { return bsdf.pdf(wo, wi); };
  pair.value = [bsdf, wo](const Vec3& wi) {
    Channels f = bsdf.eval(wo, wi);
    for (std::size_t c = 0; c < f.count; ++c) f.value[c] *= std::abs(wi[2]);
    return f;
  };
  pair.lobes = lobes_at(bsdf, wo);
  for (const BsdfSuspect& s : options.suspects) {
    pair.suspects.push_back({s.name, [s, wo](const Vec3& wi) { return s.value(wo, wi); }});
  }
  return pair;
}

}  // namespace plumbline::verify
