#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <plumbline/verify/bsdf.h>
#include <plumbline/verify/conventions.h>

#include "correct_pairs.h"
#include "textbook_glass.h"

/// Conventions by name: code that is written as a renderer writes it passes under its name, and
/// fails under Plumbline's own where that says something else.
namespace plumbline::verify {
namespace {

BsdfOptions options_with(const std::string& name, const BsdfConventions& conventions) {
  BsdfOptions options;
  options.conventions = conventions;
  options.contract = tests::contract_options(name);
  options.contract.points = 1'000;
  options.angles = {60};
  options.random_directions = 0;
  return options;
}

Report report_of(const std::string& name, const ErasedBsdf& bsdf, const BsdfOptions& options) {
  return check_bsdf(name, apply_conventions(bsdf, options.conventions), options);
}

TEST(ConventionWords, SayWhatTheNamesInCodeSay) {
  using conventions::from_words;
  EXPECT_EQ(from_words(std::vector<std::string>{}), BsdfConventions{});
  EXPECT_EQ(from_words(std::vector<std::string>{"blender"}), conventions::blender());
  BsdfConventions y_up = conventions::mitsuba();
  y_up.frame = BsdfConventions::Frame::local_y_up;
  EXPECT_EQ(from_words(std::vector<std::string>{"mitsuba", "y-up"}), y_up);
  BsdfConventions world;
  world.frame = BsdfConventions::Frame::world;
  world.normal = {0.6, 0, -0.8};
  EXPECT_EQ(from_words(std::vector<std::string>{"normal:3,0,-4"}), world);
}

TEST(ConventionWords, EachSaysSomethingOfItsOwn) {
  std::vector<BsdfConventions> seen{{}};
  for (const conventions::Word& known : conventions::words()) {
    const BsdfConventions c = conventions::from_words(std::vector{std::string(known.word)});
    EXPECT_NE(c, BsdfConventions{}) << known.word;
    if (known.all) continue;  // renderers may agree
    EXPECT_EQ(std::count(seen.begin(), seen.end(), c), 0) << known.word;
    seen.push_back(c);
  }
}

TEST(ConventionWords, RefuseWhatTheyDoNotKnow) {
  for (const std::vector<std::string>& words : {std::vector<std::string>{"mitsubaa"},
                                                {"y-up", "mitsuba"},
                                                {"normal:0,0,0"},
                                                {"normal:1,2"},
                                                {"normal:1,2,3,4"},
                                                {"normal:1,nan,0"},
                                                {"normal:inf,0,0"},
                                                {""}}) {
    EXPECT_THROW(conventions::from_words(words), std::invalid_argument) << words.back();
  }
}

/// Of the pointwise checks, which see at once that weight · pdf is not f·|cosθ|.
Verdict pointwise_verdict(const std::string& name, const ErasedBsdf& bsdf) {
  const BsdfOptions options = options_with(name, {});
  return check_pointwise(bsdf_pair(name, bsdf, unit({0.3, 0.4, 0.8}), options), options.contract)
      .verdict();
}

/// What a renderer's eval and sample give of a mirror, and whether they state the pdf.
struct Style {
  bool cosine_in_eval, eval_over_pdf;
  BsdfConventions::Weight weight;
  bool states_pdf;
};

ErasedBsdf mirror_in(const Style& style) {
  const RoughMirror mirror{0.4};
  ErasedBsdf b = erased(mirror);
  const auto eval = [=](const Vec3& wo, const Vec3& wi) {
    double f = mirror.eval(wo, wi);
    const double pdf = mirror.pdf(wo, wi);
    if (style.cosine_in_eval || style.eval_over_pdf) f *= std::abs(wi[2]);
    return style.eval_over_pdf ? (pdf > 0 ? f / pdf : 0) : f;
  };
  b.eval = [=](const Vec3& wo, const Vec3& wi) { return gray(eval(wo, wi)); };
  b.sample = [=](const Vec3& wo, const Uniforms& u) -> std::optional<SampleRecord> {
    auto record = mirror.sample(wo, u[0], u[1]);
    // Nothing sampled: a direction all the same, with a pdf of 0.
    if (!record) record = SampleRecord{{0, 0, -1}, gray(0), 0};
    const double pdf = mirror.pdf(wo, record->x), f = mirror.eval(wo, record->x);
    if (style.weight == BsdfConventions::Weight::f) record->weight = gray(f);
    if (style.weight == BsdfConventions::Weight::f_cosine) {
      record->weight = gray(f * std::abs(record->x[2]));
    }
    record->pdf = style.states_pdf ? std::optional(pdf) : std::nullopt;
    return record;
  };
  return b;
}

TEST(Conventions, PassUnderTheirNameAndFailUnderAnother) {
  using W = BsdfConventions::Weight;
  const struct {
    const char* name;
    BsdfConventions conventions;
    Style style;
  } kRenderers[] = {{"pbrt", conventions::pbrt(), {false, false, W::f, true}},
                    {"mitsuba", conventions::mitsuba(), {true, false, W::throughput, true}},
                    {"nori", conventions::nori(), {false, false, W::throughput, false}},
                    {"osl", conventions::osl(), {false, true, W::throughput, true}},
                    {"openpbr", conventions::openpbr(), {false, false, W::f, true}},
                    {"falcor", conventions::falcor(), {true, false, W::throughput, true}},
                    {"blender", conventions::blender(), {true, false, W::f_cosine, true}}};
  for (const auto& r : kRenderers) {
    const ErasedBsdf mirror = mirror_in(r.style);
    const Report right = report_of(r.name, mirror, options_with(r.name, r.conventions));
    EXPECT_TRUE(right.ok()) << right.summary();
    EXPECT_EQ(pointwise_verdict(r.name, mirror), Verdict::fail) << r.name;
  }
}

/// Rough glass, with or without the square of the index that radiance has. Its samples are not
/// looked at.
ErasedBsdf rough_glass(double eta, bool without_eta_squared) {
  const tests::TextbookGlass<double> glass{0.4, eta};
  ErasedBsdf b = erase_bsdf<tests::Vector<double>>(glass);
  if (!without_eta_squared) return b;
  b.eval = [=, eval = b.eval](const Vec3& wo, const Vec3& wi) {
    Channels f = eval(wo, wi);
    f.value[0] *= (wi[2] < 0 ? eta * eta : 1) / (wo[2] < 0 ? eta * eta : 1);
    return f;
  };
  return b;
}

/// A flat surface that lets through half of the light from above, as an atom, and returns the rest.
ErasedBsdf half_mirror(double eta, bool without_eta_squared) {
  ErasedBsdf b;
  b.sample = [=](const Vec3& wo, const Uniforms& u) {
    const bool through = u[0] < 0.5;
    SampleRecord record{{-wo[0], -wo[1], wo[2]}, gray(1), std::nullopt, 0.5};
    if (through) {
      const double x = -wo[0] / eta, y = -wo[1] / eta;
      record.x = {x, y, -std::sqrt(1 - x * x - y * y)};
      if (!without_eta_squared) record.weight = gray(1 / (eta * eta));
    }
    return std::optional(record);
  };
  b.pdf = [](const Vec3&, const Vec3&) { return 0.0; };
  b.eval = [](const Vec3&, const Vec3&) { return gray(0); };
  return b;
}

TEST(Conventions, GlassMayLackEtaSquaredIfItSaysSo) {
  const double eta = 1.5;
  const Vec3 wo = unit({0.3, 0.4, 0.8});
  BsdfConventions lacks;
  lacks.without_eta_squared = true;
  for (const bool says_so : {false, true}) {
    const BsdfConventions conventions = says_so ? lacks : BsdfConventions{};
    BsdfOptions options = options_with(says_so ? "says so" : "has it", conventions);
    options.eta = eta;
    for (const bool lacks_it : {false, true}) {
      const Verdict right = lacks_it == says_so ? Verdict::pass : Verdict::fail;
      EXPECT_EQ(check_reciprocity(
                    "rough", apply_conventions(rough_glass(eta, lacks_it), conventions), options)
                    .verdict,
                right);
      // Half of the light for all of it: an albedo of 1, of 1.625, or of 0.72, which may be.
      options.albedo = [](const Vec3&) { return 1.0; };
      EXPECT_EQ(check_energy("smooth", apply_conventions(half_mirror(eta, lacks_it), conventions),
                             wo, options)
                    .verdict,
                right);
    }
  }
}

/// A mirror of another reflectance in each channel.
ErasedBsdf coloured_mirror() {
  ErasedBsdf b = half_mirror(1, false);
  b.sample = [](const Vec3& wo, const Uniforms&) {
    SampleRecord record{{-wo[0], -wo[1], wo[2]}, gray(0), std::nullopt, 1};
    record.weight.value = {0.9, 0.5, 0.2};
    record.weight.count = 3;
    return std::optional(record);
  };
  return b;
}

TEST(Energy, IsHeldInTheChannelThatTheKnownAlbedoIsOf) {
  BsdfOptions options = options_with("coloured", {});
  options.albedo = [](const Vec3&) { return 0.2; };
  for (const std::size_t channel : {0u, 1u, 2u}) {
    options.albedo_channel = channel;
    EXPECT_EQ(check_energy("mirror", coloured_mirror(), unit({0.3, 0.4, 0.8}), options).verdict,
              channel == 2 ? Verdict::pass : Verdict::fail);
  }
  options.albedo_channel = Channels::kMost;
  EXPECT_THROW(check_energy("mirror", coloured_mirror(), unit({0.3, 0.4, 0.8}), options),
               std::invalid_argument);
}

/// A white fibre along z that scatters evenly in azimuth and by the cosine along itself: f = 1/π²,
/// ∫ f·cosθ dω = 1/π² ∫ cos²θ dθ dφ = 1. Angles θ from the plane across: dω = cosθ dθ dφ.
struct Fibre {
  static double pdf(const Vec3&, const Vec3& wi) {
    return std::hypot(wi[0], wi[1]) / (std::numbers::pi * std::numbers::pi);
  }
  static double eval(const Vec3&, const Vec3&) { return 1 / (std::numbers::pi * std::numbers::pi); }
  static std::optional<SampleRecord> sample(const Vec3& wo, double u, double v) {
    // F(θ) = (θ + sinθ·cosθ)/π + 1/2 has no inverse in closed form: bisected.
    double low = -std::numbers::pi / 2, high = -low;
    for (int i = 0; i < 60; ++i) {
      const double t = (low + high) / 2;
      ((t + std::sin(t) * std::cos(t)) / std::numbers::pi + 0.5 < u ? low : high) = t;
    }
    const double theta = (low + high) / 2, phi = 2 * std::numbers::pi * v;
    const Vec3 wi{std::cos(theta) * std::cos(phi), std::cos(theta) * std::sin(phi),
                  std::sin(theta)};
    return SampleRecord{wi, gray(1), pdf(wo, wi)};
  }
};

TEST(Conventions, AFibreHasACosineOfItsOwn) {
  BsdfConventions fibre;
  fibre.cosine = BsdfConventions::Cosine::fibre;
  const Report right = report_of("fibre", erased(Fibre{}), options_with("fibre", fibre));
  EXPECT_TRUE(right.ok()) << right.summary();
  EXPECT_EQ(pointwise_verdict("fibre", erased(Fibre{})), Verdict::fail);
}

}  // namespace
}  // namespace plumbline::verify
