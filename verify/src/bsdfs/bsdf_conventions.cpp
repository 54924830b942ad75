#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <plumbline/verify/detail/erase_bsdf.h>

#include "pairs/batches.h"
#include "vec3.h"

namespace plumbline::verify {

namespace {

using Conventions = BsdfConventions;

double cosine_at(const Vec3& w, Conventions::Cosine kind) {
  if (kind == Conventions::Cosine::fibre) return std::hypot(w[0], w[1]);
  return std::abs(w[2]);
}

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

using Density = Many<double(Vec3, Vec3)>;

/// Everything that changes between what the code takes and gives and what the checks do.
class Translator {
 public:
  explicit Translator(const Conventions& conventions) : c_(conventions), frame_(conventions) {}

  /// wo as the author takes it.
  Vec3 given(const Vec3& wo) const {
    const Vec3 theirs = frame_.to_theirs(wo);
    return c_.given_points_in ? scaled(theirs, -1) : theirs;
  }

  /// f(wo, wi) by a function of the author's.
  template <class R>
  R call(const Many<R(Vec3, Vec3)>& f, const Vec3& wo, const Vec3& wi) const {
    return in_their_order(f, given(wo), frame_.to_theirs(wi));
  }

  template <class R>
  void call(const Many<R(Vec3, Vec3)>& f, std::span<const Vec3> wo, std::span<const Vec3> wi,
            std::span<R> out) const {
    std::vector<Vec3> theirs(wi.size());
    for (std::size_t i = 0; i < wi.size(); ++i) theirs[i] = frame_.to_theirs(wi[i]);
    in_their_order(f, given(wo), theirs, out);
  }

  std::vector<Vec3> given(std::span<const Vec3> wo) const {
    std::vector<Vec3> theirs(wo.size());
    for (std::size_t i = 0; i < wo.size(); ++i) theirs[i] = given(wo[i]);
    return theirs;
  }

  double density(double theirs, const Vec3& wi) const {
    return c_.projected_pdf ? theirs * cosine_of(wi) : theirs;
  }

  bool eval_over_pdf() const { return c_.eval_over_pdf; }

  /// @param pdf  the author's, where `eval_over_pdf`
  Channels value(Channels theirs, const Vec3& wi, double pdf) const {
    const double cosine = cosine_of(wi);
    const double projected = c_.projected_pdf ? cosine : 1;
    if (c_.eval_over_pdf) scale(theirs, pdf * projected);
    // On the horizon f·|cosθ| says nothing about f, and nothing is asked of it.
    if (c_.cosine_in_eval || c_.eval_over_pdf) scale(theirs, cosine > 0 ? 1 / cosine : 0);
    return theirs;
  }

  /// Whether a record that does not state its density is asked for it.
  bool wants_density(const Record& theirs) const {
    if (!theirs || theirs->mass > 0 || theirs->pdf) return false;
    const bool for_weight =
        theirs->weight.count > 0 &&
        (c_.weight == Conventions::Weight::f || c_.weight == Conventions::Weight::f_cosine);
    return c_.zero_pdf_is_failure || for_weight;
  }

  /// @param density  of the author's pdf at the sample, where `wants_density`
  Record record(Record record, double density) const {
    if (!record) return std::nullopt;
    const double probability = record->mass > 0 ? record->mass : record->pdf.value_or(density);
    if (c_.zero_pdf_is_failure && record->mass == 0 && probability == 0) return std::nullopt;
    record->x = frame_.to_ours(record->x);
    translate_weight(*record, probability);
    if (c_.projected_pdf && record->pdf) *record->pdf *= cosine_of(record->x);
    return record;
  }

  /// The author's pdf in the author's frame.
  template <class Given, class Sampled, class... Out>
  auto in_their_order(const auto& f, const Given& given, const Sampled& sampled,
                      const Out&... out) const {
    return c_.sampled_direction_first ? f(sampled, given, out...) : f(given, sampled, out...);
  }

 private:
  static void scale(Channels& channels, double factor) {
    for (std::size_t i = 0; i < channels.count; ++i) channels.value[i] *= factor;
  }

  /// @param probability  the record's pdf in the author's measure, or mass
  void translate_weight(SampleRecord& record, double probability) const {
    if (c_.weight == Conventions::Weight::throughput || record.weight.count == 0) return;
    if (c_.weight == Conventions::Weight::unused) {
      record.weight = {};
      return;
    }
    const double cosine = cosine_of(record.x);
    const double projected = c_.projected_pdf && !(record.mass > 0) ? cosine : 1;
    const double value = c_.weight == Conventions::Weight::f ? cosine : 1;
    scale(record.weight, value / (projected * probability));
  }

  double cosine_of(const Vec3& w) const { return cosine_at(w, c_.cosine); }

  Conventions c_;
  FrameChange frame_;
};

using Shared = std::shared_ptr<const Translator>;

struct TranslatedDensity {
  Shared to;
  Density theirs;

  double operator()(const Vec3& wo, const Vec3& wi) const {
    return to->density(to->call(theirs, wo, wi), wi);
  }
  void operator()(std::span<const Vec3> wo, std::span<const Vec3> wi, std::span<double> out) const {
    to->call(theirs, wo, wi, out);
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = to->density(out[i], wi[i]);
  }
};

struct TranslatedValue {
  Shared to;
  Many<Channels(Vec3, Vec3)> theirs;
  Density density;

  Channels operator()(const Vec3& wo, const Vec3& wi) const {
    const double pdf = to->eval_over_pdf() ? to->call(density, wo, wi) : 0;
    return to->value(to->call(theirs, wo, wi), wi, pdf);
  }
  void operator()(std::span<const Vec3> wo, std::span<const Vec3> wi,
                  std::span<Channels> out) const {
    to->call(theirs, wo, wi, out);
    std::vector<double> pdf(out.size(), 0.0);
    if (to->eval_over_pdf()) to->call(density, wo, wi, std::span(pdf));
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = to->value(out[i], wi[i], pdf[i]);
  }
};

/// Samples, with the density that they should have where they do not state it.
struct TranslatedSample {
  Shared to;
  Many<Record(Vec3, Uniforms)> theirs;
  Density density;

  Record operator()(const Vec3& wo, const Uniforms& u) const {
    const Vec3 given = to->given(wo);
    Record record = theirs(given, u);
    const double p = to->wants_density(record) ? to->in_their_order(density, given, record->x) : 0;
    return to->record(record, p);
  }

  void operator()(std::span<const Vec3> wo, std::span<const Uniforms> u,
                  std::span<Record> out) const {
    const std::vector<Vec3> given = to->given(wo);
    theirs(given, u, out);
    std::vector<Vec3> of, at;
    for (std::size_t i = 0; i < out.size(); ++i) {
      if (!to->wants_density(out[i])) continue;
      of.push_back(given[i]);
      at.push_back(out[i]->x);
    }
    std::vector<double> p(at.size());
    to->in_their_order(density, of, at, std::span(p));
    std::size_t next = 0;
    for (Record& record : out) {
      const double at_record = to->wants_density(record) ? p[next++] : 0;
      record = to->record(record, at_record);
    }
  }
};

/// The same of code that takes a generator.
struct TranslatedDraw {
  Shared to;
  std::function<Record(const Vec3&, Random&)> theirs;
  Density density;

  Record operator()(const Vec3& wo, Random& random) const {
    const Vec3 given = to->given(wo);
    Record record = theirs(given, random);
    const double p = to->wants_density(record) ? to->in_their_order(density, given, record->x) : 0;
    return to->record(record, p);
  }
};

/// `sample`, `draw` and `pdf` of a BSDF or of a lobe.
template <class T>
void translate_sampling(const Shared& to, T& it) {
  if (it.sample) it.sample = {TranslatedSample{to, it.sample, it.pdf}, it.sample.batch()};
  if (it.draw) it.draw = TranslatedDraw{to, it.draw, it.pdf};
  it.pdf = {TranslatedDensity{to, it.pdf}, it.pdf.batch()};
}

}  // namespace

ErasedBsdf apply_conventions(ErasedBsdf bsdf, const BsdfConventions& conventions) {
  if (conventions == BsdfConventions{}) return bsdf;
  const auto to = std::make_shared<const Translator>(conventions);
  if (bsdf.eval) bsdf.eval = {TranslatedValue{to, bsdf.eval, bsdf.pdf}, bsdf.eval.batch()};
  translate_sampling(to, bsdf);
  bsdf.without_eta_squared = conventions.without_eta_squared;
  bsdf.cosine = conventions.cosine;
  for (BsdfLobe& lobe : bsdf.lobes) {
    translate_sampling(to, lobe);
    lobe.probability = [to, theirs = lobe.probability](const Vec3& wo) {
      return theirs(to->given(wo));
    };
  }
  return bsdf;
}

double ErasedBsdf::cosine_of(const Vec3& w) const { return cosine_at(w, cosine); }

}  // namespace plumbline::verify
