#include <optional>
#include <span>
#include <utility>

#include <plumbline/exchange/answerer.h>

namespace plumbline::exchange {
namespace {

using verify::Channels;
using verify::SampleRecord;
using verify::Uniforms;
using verify::Vec3;
using Samples = std::span<std::optional<SampleRecord>>;

double epsilon_of(const Answerer& answerer) { return answerer.hello().float64 ? 0x1p-53 : 0x1p-24; }

}  // namespace

verify::ErasedBsdf as_bsdf(const SharedAnswerer& answerer,
                           const verify::BsdfConventions& conventions) {
  verify::ErasedBsdf bsdf;
  bsdf.epsilon = epsilon_of(*answerer);
  bsdf.numbers = answerer->hello().numbers;
  bsdf.sample = [answerer](std::span<const Vec3> wo, std::span<const Uniforms> u, Samples out) {
    answerer->sample(wo, u, out);
  };
  bsdf.pdf = [answerer](std::span<const Vec3> wo, std::span<const Vec3> wi, std::span<double> out) {
    answerer->pdf(wo, wi, out);
  };
  if (answerer->hello().has_eval) {
    bsdf.eval = [answerer](std::span<const Vec3> wo, std::span<const Vec3> wi,
                           std::span<Channels> out) { answerer->eval(wo, wi, out); };
  }
  return verify::apply_conventions(std::move(bsdf), conventions);
}

verify::SamplingPair as_pair(const SharedAnswerer& answerer, const std::string& name,
                             const verify::Domain& domain) {
  answerer->set_dimensions(coordinates_of(domain));
  verify::SamplingPair pair;
  pair.name = name;
  pair.domain = domain;
  pair.numbers = answerer->hello().numbers;
  pair.epsilon = epsilon_of(*answerer);
  pair.sample = [answerer](std::span<const Uniforms> u, Samples out) {
    answerer->sample({}, u, out);
  };
  pair.pdf = [answerer](std::span<const Vec3> x, std::span<double> out) {
    answerer->pdf({}, x, out);
  };
  if (answerer->hello().has_eval) {
    pair.value = [answerer](std::span<const Vec3> x, std::span<Channels> out) {
      answerer->eval({}, x, out);
    };
  }
  return pair;
}

std::size_t coordinates_of(const verify::Domain& domain) {
  if (domain.directions()) return 3;
  return domain.dimension() == 2 ? 2 : 1;
}

}  // namespace plumbline::exchange
