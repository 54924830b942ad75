#include <cmath>
#include <memory>
#include <utility>

#include <plumbline/verify/detail/erase_bsdf.h>

#include "pairs/uniforms.h"
#include "vec3.h"

namespace plumbline::verify {

namespace {

using Conventions = BsdfConventions;

/// Between Plumbline's local frame (z up) and the frame of the code under test.
class FrameChange {
 public:
  explicit FrameChange(const Conventions& c) : kind_(c.frame), normal_(normalized(c.normal)) {
    const Vec3 helper = std::abs(normal_[2]) < 0.9 ? Vec3{0, 0, 1} : Vec3{1, 0, 0};
    tangent_ = normalized(cross(helper, normal_));
    bitangent_ = cross(normal_, tangent_);
  }

  Vec3 to_theirs(const Vec3& w) const {
    switch (kind_) {
      case Conventions::Frame::local_y_up:
        return {w[0], w[2], -w[1]};
      case Conventions::Frame::world:
        return sum(sum(scaled(tangent_, w[0]), scaled(bitangent_, w[1])), scaled(normal_, w[2]));
      case Conventions::Frame::local_z_up:
        break;
    }
    return w;
  }

  Vec3 to_ours(const Vec3& w) const {
    switch (kind_) {
      case Conventions::Frame::local_y_up:
        return {w[0], -w[2], w[1]};
      case Conventions::Frame::world:
        return {dot(w, tangent_), dot(w, bitangent_), dot(w, normal_)};
      case Conventions::Frame::local_z_up:
        break;
    }
    return w;
  }

 private:
  Conventions::Frame kind_;
  Vec3 normal_, tangent_{}, bitangent_{};
};

/// Everything that changes between what the code takes and gives and what the checks do.
class Translator {
 public:
  Translator(ErasedBsdf raw, const Conventions& conventions)
      : raw_(std::move(raw)), c_(conventions), frame_(conventions) {}

  using Density = std::function<double(const Vec3&, const Vec3&)>;

  double probability(const BsdfLobe& lobe, const Vec3& wo) const {
    return lobe.probability(given(wo));
  }

  double pdf(const Density& density, const Vec3& wo, const Vec3& wi) const {
    const double theirs = call(density, wo, wi);
    return c_.projected_pdf ? theirs * std::abs(wi[2]) : theirs;
  }

  Channels eval(const Vec3& wo, const Vec3& wi) const {
    Channels f = call(raw_.eval, wo, wi);
    const double cosine = std::abs(wi[2]);
    // On the horizon f·|cosθ| says nothing about f, and nothing is asked of it.
    if (c_.cosine_in_eval) scale(f, cosine > 0 ? 1 / cosine : 0);
    return f;
  }

  /// @param density  that the samples should have, in the author's conventions
  template <class Source>
  std::optional<SampleRecord> sample(
      const std::function<std::optional<SampleRecord>(const Vec3&, Source)>& function,
      const Density& density, const Vec3& wo, Source source) const {
    auto record = function(given(wo), source);
    if (!record) return std::nullopt;
    const auto probability = [&, theirs = record->x] {
      if (record->mass > 0) return record->mass;
      return record->pdf ? *record->pdf : in_their_order(density, given(wo), theirs);
    };
    if (c_.zero_pdf_is_failure && record->mass == 0 && probability() == 0) return std::nullopt;
    record->x = frame_.to_ours(record->x);
    translate_weight(*record, probability);
    if (c_.projected_pdf && record->pdf) *record->pdf *= std::abs(record->x[2]);
    return record;
  }

  const ErasedBsdf& raw() const { return raw_; }

 private:
  Vec3 given(const Vec3& wo) const {
    const Vec3 theirs = frame_.to_theirs(wo);
    return c_.given_points_in ? scaled(theirs, -1) : theirs;
  }

  template <class R>
  R call(const std::function<R(const Vec3&, const Vec3&)>& f, const Vec3& wo,
         const Vec3& wi) const {
    return in_their_order(f, given(wo), frame_.to_theirs(wi));
  }

  template <class R>
  R in_their_order(const std::function<R(const Vec3&, const Vec3&)>& f, const Vec3& given,
                   const Vec3& sampled) const {
    return c_.sampled_direction_first ? f(sampled, given) : f(given, sampled);
  }

  static void scale(Channels& channels, double factor) {
    for (std::size_t i = 0; i < channels.count; ++i) channels.value[i] *= factor;
  }

  /// @param probability  the record's pdf in the author's measure, or mass
  template <class Probability>
  void translate_weight(SampleRecord& record, const Probability& probability) const {
    if (c_.weight == Conventions::Weight::throughput || record.weight.count == 0) return;
    if (c_.weight == Conventions::Weight::unused) {
      record.weight = {};
      return;
    }
    const double cosine = std::abs(record.x[2]);
    const double projected = c_.projected_pdf && !(record.mass > 0) ? cosine : 1;
    const double value = c_.weight == Conventions::Weight::f ? cosine : 1;
    scale(record.weight, value / (projected * probability()));
  }

  ErasedBsdf raw_;
  Conventions c_;
  FrameChange frame_;
};

/// @param lobe  of the translator's own BSDF, which it keeps
BsdfLobe translated(const std::shared_ptr<const Translator>& translator, const BsdfLobe& lobe) {
  BsdfLobe ours;
  ours.numbers = lobe.numbers;
  ours.probability = [translator, &lobe](const Vec3& wo) {
    return translator->probability(lobe, wo);
  };
  ours.pdf = [translator, &lobe](const Vec3& wo, const Vec3& wi) {
    return translator->pdf(lobe.pdf, wo, wi);
  };
  if (lobe.sample) {
    ours.sample = [translator, &lobe](const Vec3& wo, const Uniforms& u) {
      return translator->sample<const Uniforms&>(lobe.sample, lobe.pdf, wo, u);
    };
  }
  if (lobe.draw) {
    ours.draw = [translator, &lobe](const Vec3& wo, Random& random) {
      return translator->sample<Random&>(lobe.draw, lobe.pdf, wo, random);
    };
  }
  return ours;
}

}  // namespace

ErasedBsdf apply_conventions(ErasedBsdf raw, const BsdfConventions& conventions) {
  const auto translator = std::make_shared<const Translator>(std::move(raw), conventions);
  const ErasedBsdf& theirs = translator->raw();
  ErasedBsdf ours;
  ours.epsilon = theirs.epsilon;
  ours.numbers = theirs.numbers;
  for (const BsdfLobe& lobe : theirs.lobes) ours.lobes.push_back(translated(translator, lobe));
  ours.pdf = [translator](const Vec3& wo, const Vec3& wi) {
    return translator->pdf(translator->raw().pdf, wo, wi);
  };
  ours.eval = [translator](const Vec3& wo, const Vec3& wi) { return translator->eval(wo, wi); };
  if (theirs.sample) {
    ours.sample = [translator](const Vec3& wo, const Uniforms& u) {
      return translator->sample<const Uniforms&>(translator->raw().sample, translator->raw().pdf,
                                                 wo, u);
    };
  }
  if (theirs.draw) {
    ours.draw = [translator](const Vec3& wo, Random& random) {
      return translator->sample<Random&>(translator->raw().draw, translator->raw().pdf, wo, random);
    };
  }
  return ours;
}

std::optional<SampleRecord> ErasedBsdf::next(const Vec3& wo, Random& random) const {
  return draw ? draw(wo, random) : sample(wo, draw_uniforms(random, numbers, epsilon));
}

}  // namespace plumbline::verify
