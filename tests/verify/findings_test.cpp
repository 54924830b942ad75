#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "diagnosis/direct.h"
#include "diagnosis/discrete.h"
#include "diagnosis/shape.h"
#include "seen_ratios.h"

/// What a diagnosis sees without any fit: each finding of a pair that is faulty in just that way,
/// and none of one that is not quite.
namespace plumbline::verify {
namespace {

using std::numbers::pi;
constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

/// One failing view of a pair.
struct OneView {
  SamplingPair pair;
  ReportEvidence evidence;

  explicit OneView(Domain domain) {
    pair.domain = std::move(domain);
    pair.sample = [chart = pair.domain](const Uniforms& u) -> std::optional<SampleRecord> {
      return SampleRecord{chart.chart().from_square({u[0], u[1]}), {}, {}};
    };
    pair.pdf = [](const Vec3&) { return 1.0; };
    evidence.views.resize(1);
    view().pair = &pair;
    view().failed = true;
  }
  OneView(const OneView&) = delete;
  OneView& operator=(const OneView&) = delete;

  ViewEvidence& view() { return evidence.views.front(); }
};

std::string words_of(const std::optional<Finding>& f) {
  return f ? std::string(to_string(f->kind)) + ": " + f->words : std::string();
}
bool begins_with(const std::string& text, const std::string& start) {
  return text.compare(0, start.size(), start) == 0;
}
std::string kind_word(CauseKind kind) { return std::string(to_string(kind)) + ": "; }

TEST(Findings, StateThatIsKeptIsFound) {
  OneView v(Domain::unit_square());
  EXPECT_FALSE(find_stale_state(v.evidence));
  v.pair.pdf = [](const Vec3&) { return std::numeric_limits<double>::infinity(); };
  EXPECT_FALSE(find_stale_state(v.evidence)) << "twice the same";
  v.pair.pdf = [calls = 0](const Vec3&) mutable { return ++calls > 64 ? 2.0 : 1.0; };
  EXPECT_EQ(words_of(find_stale_state(v.evidence)),
            kind_word(CauseKind::stale_state) +
                "pdf() gives another answer to the same question after other questions (1, then "
                "2): state is kept between calls");
  OneView s(Domain::unit_square());
  s.pair.sample = [last = 0.0](const Uniforms& u) mutable -> std::optional<SampleRecord> {
    return SampleRecord{{std::exchange(last, u[0]), u[1], 0}, {}, {}};
  };
  EXPECT_EQ(words_of(find_stale_state(s.evidence)),
            kind_word(CauseKind::stale_state) +
                "sample gives another point for the same numbers after other calls: state is kept "
                "between calls");
}

/// A pdf in float that is even over a cap: k steps of 2⁻²⁴, whole ones or nearly so.
TEST(Findings, RoundedCapsAreFound) {
  const auto found = [](double steps, double epsilon = 0x1p-24) {
    OneView v(Domain::hemisphere());
    v.pair.epsilon = epsilon;
    v.pair.pdf = [=](const Vec3&) { return 1 / (2 * pi * steps * 0x1p-24); };
    return words_of(find_rounded_cap(v.evidence));
  };
  EXPECT_EQ(found(5), kind_word(CauseKind::precision) +
                          "1/pdf() is a solid angle of 2π · 5 · 2⁻²⁴: 1 − cosθ was taken in float, "
                          "of a cosine next to 1; write it as 2 sin²(θ/2)");
  EXPECT_NE(found(5.004), "");
  EXPECT_EQ(found(5.006), "");
  EXPECT_NE(found(2000), "");
  EXPECT_EQ(found(2001), "");
  EXPECT_EQ(found(5, 0x1p-53), "") << "not in double";
  OneView uneven(Domain::hemisphere());
  uneven.pair.epsilon = 0x1p-24;
  uneven.pair.pdf = [](const Vec3& x) { return (1 + x[2]) / (2 * pi * 5 * 0x1p-24); };
  EXPECT_FALSE(find_rounded_cap(uneven.evidence));
}

TEST(Findings, WhatIsNotFiniteIsFound) {
  const auto found = [](const std::function<void(OneView&)>& fault) {
    OneView v(Domain::unit_square());
    fault(v);
    return words_of(find_not_finite(v.evidence));
  };
  const std::string kind = kind_word(CauseKind::not_finite);
  EXPECT_EQ(found([](OneView&) {}), "");
  for (const double value : {kNotANumber, -0.5, std::numeric_limits<double>::infinity()}) {
    const std::string words = found([value](OneView& v) {
      v.pair.pdf = [value](const Vec3& x) { return x[0] > 0.9 ? value : 1; };
    });
    const std::string named = std::isnan(value) ? "nan" : value < 0 ? "-0.5" : "inf";
    EXPECT_TRUE(begins_with(words, kind + "pdf() is " + named + " at (0.9")) << words;
  }
  EXPECT_EQ(found([](OneView& v) {
              v.pair.sample = [](const Uniforms& u) -> std::optional<SampleRecord> {
                return SampleRecord{{u[0] > 0.9 ? kNotANumber : u[0], u[1], 0}, {}, {}};
              };
            }),
            kind + "a sampled point is not finite");
  EXPECT_EQ(found([](OneView& v) {
              v.pair.sample = [](const Uniforms& u) -> std::optional<SampleRecord> {
                SampleRecord s{{u[0], u[1], 0}, {}, {}};
                s.weight.count = 1;
                s.weight.value[0] = u[0] > 0.9 ? kNotANumber : 1;
                return s;
              };
            }),
            kind + "a weight is nan");
  EXPECT_NE(found([](OneView& v) {
              v.pair.value = [](const Vec3& x) {
                Channels c;
                c.count = 1;
                c.value[0] = x[0] > 0.9 ? kNotANumber : 1;
                return c;
              };
            }).find("f is nan at (0.9"),
            std::string::npos);
}

/// One in two hundred of 4,096.
TEST(Findings, ManyPointsThatAreNotFiniteAreFound) {
  const auto found = [](int bad_of_512) {
    OneView v(Domain::unit_square());
    v.pair.sample = [=, i = 0](const Uniforms& u) mutable -> std::optional<SampleRecord> {
      return SampleRecord{{i++ % 512 < bad_of_512 ? kNotANumber : u[0], u[1], 0}, {}, {}};
    };
    return words_of(find_points_not_finite(v.evidence));
  };
  EXPECT_EQ(found(2), "");
  EXPECT_EQ(found(3),
            kind_word(CauseKind::not_finite) + "0.6 % of the sampled points are not finite");
  EXPECT_EQ(found(128),
            kind_word(CauseKind::not_finite) + "25 % of the sampled points are not finite");
}

/// Looked for at the middles of 48 × 48 cells; two thousandths of them are 4.6, a hundredth 23.
TEST(Findings, NegativeDensitiesAndThoseThatAreNoNumbersAreFound) {
  const auto found = [](int cells, double value) {
    OneView v(Domain::unit_square());
    v.pair.pdf = [=](const Vec3& x) { return x[1] < 1 / 48.0 && x[0] < cells / 48.0 ? value : 1; };
    return words_of(find_bad_density(v.evidence));
  };
  EXPECT_EQ(found(4, -1), "");
  EXPECT_EQ(found(5, -1), kind_word(CauseKind::not_finite) +
                              "pdf() is negative, down to -1, in 0.2 % of the domain");
  EXPECT_EQ(found(23, kNotANumber), "");
  EXPECT_EQ(found(24, kNotANumber),
            kind_word(CauseKind::not_finite) + "pdf() is nan in 1 % of the domain");
  EXPECT_EQ(found(48, -0.5e-6), "") << "rounding";
  EXPECT_NE(found(48, -2e-6), "");
}

/// A sampler that gives an atom, or rejects.
void give_atoms(OneView& v, double mass, std::optional<double> pdf) {
  v.pair.sample = [=](const Uniforms&) -> std::optional<SampleRecord> {
    if (!(mass > 0)) return std::nullopt;
    SampleRecord s{{0.5, 0.5, 0}, {}, pdf};
    s.mass = mass;
    return s;
  };
}

TEST(Findings, AtomsWithADensityAreFound) {
  const auto found = [](double mass, std::optional<double> pdf, double integral) {
    OneView v(Domain::unit_square());
    give_atoms(v, mass, pdf);
    v.view().mass = MassSeen{integral, 1e-4, mass, 0, 0};
    return words_of(find_atoms_with_density(v.evidence));
  };
  const std::string kind = kind_word(CauseKind::atom_as_density);
  EXPECT_EQ(found(1, 3.0, 0), kind + "a sample that is an atom of mass 1 states a density, 3");
  EXPECT_EQ(found(1, std::nullopt, 0.25),
            kind + "all samples are atoms, but pdf() gives a density, ∫pdf = 0.25");
  EXPECT_EQ(found(1, std::nullopt, 0.9e-3), "") << "not known to be more than 0";
  EXPECT_EQ(found(0, std::nullopt, 0.25), "") << "no sample at all";
  OneView beside(Domain::unit_square());
  beside.view().mass = MassSeen{0.5, 1e-4, 0.5, 0, 0};
  EXPECT_FALSE(find_atoms_with_density(beside.evidence));
}

TEST(Findings, AtomsOfAnotherMassAreFound) {
  // Of 20,000 samples; three standard errors of a share of 0.3 are 0.01.
  const auto found = [](const std::vector<double>& stated) {
    OneView v(Domain::unit_square());
    v.pair.sample = [=](const Uniforms& u) -> std::optional<SampleRecord> {
      const std::size_t i = u[0] < 0.3 ? 0 : u[0] < 0.5 || stated.size() < 3 ? 1 : 2;
      SampleRecord s{{0.1 + 0.2 * static_cast<double>(i), 0.5, 0}, {}, {}};
      s.mass = stated[i];
      return s;
    };
    return words_of(find_atoms_of_other_mass(v.evidence));
  };
  EXPECT_EQ(found({0.3, 0.7}), "");
  EXPECT_EQ(found({0.3, 0.2, 0.5}), "");
  const std::string exchanged = found({0.7, 0.3});
  EXPECT_TRUE(begins_with(exchanged, kind_word(CauseKind::lobe_probability) +
                                         "the masses of the two atoms are exchanged: "))
      << exchanged;
  for (const auto& stated : {std::vector{0.5, 0.5}, {0.35, 0.7}, {0.2, 0.3, 0.5}}) {
    const std::string words = found(stated);
    EXPECT_TRUE(
        begins_with(words, kind_word(CauseKind::atom_as_density) + "an atom states a mass of "))
        << words;
  }
}

/// What falls below the horizon is lifted to it: many samples there, and the pdf knows of none.
TEST(Findings, SamplesThatCrowdAreFound) {
  const auto found = [](double height, double share) {
    OneView v(Domain::hemisphere());
    v.view().wo = Vec3{0, 0, 1};
    v.pair.pdf = [](const Vec3&) { return 1 / (2 * pi); };
    v.pair.sample = [=](const Uniforms& u) -> std::optional<SampleRecord> {
      const double z = u[0] < share ? height + 1e-7 * u[0] : (u[0] - share) / (1 - share);
      const double r = std::sqrt(1 - z * z), phi = 2 * pi * u[1];
      return SampleRecord{{r * std::cos(phi), r * std::sin(phi), z}, {}, {}};
    };
    return words_of(find_samples_near_a_line(v.evidence));
  };
  EXPECT_TRUE(begins_with(found(0.001, 0.1), kind_word(CauseKind::not_rejected)));
  EXPECT_TRUE(begins_with(found(0.3, 0.1), kind_word(CauseKind::on_a_line)));
  EXPECT_EQ(found(0.3, 0.002), "") << "a few may";
  EXPECT_EQ(found(0.7, 0.1), "") << "a lobe around the pole";
}

TEST(Findings, SamplesOnALineAreFound) {
  const auto found = [](const std::function<Vec3(const Uniforms&)>& point) {
    OneView v(Domain::unit_square());
    v.pair.sample = [=](const Uniforms& u) -> std::optional<SampleRecord> {
      return SampleRecord{point(u), {}, {}};
    };
    const auto f = find_samples_on_a_line(v.evidence);
    return f ? std::string(to_string(f->kind)) + ": " + f->words.substr(f->words.find("of the"))
             : std::string();
  };
  EXPECT_EQ(found([](auto& u) { return Vec3{u[0], u[1], 0}; }), "");
  EXPECT_EQ(found([](auto& u) {
              return Vec3{std::max(u[0], 0.25), u[1], 0};
            }),
            kind_word(CauseKind::on_a_line) +
                "of the samples lie on a line, first coordinate = 0.25: a clamp?");
  EXPECT_EQ(found([](auto& u) {
              return Vec3{u[0], std::min(u[1], 0.5), 0};
            }),
            kind_word(CauseKind::on_a_line) +
                "of the samples lie on a line, second coordinate = 0.5: a clamp?");
  EXPECT_EQ(
      found([](auto& u) {
        return u[0] < 0.3 ? Vec3{0.25, 0.5, 0} : Vec3{u[0], u[1], 0};
      }),
      kind_word(CauseKind::on_a_line) +
          "of the samples lie in one point, first coordinate = 0.25, second coordinate = 0.5: "
          "a clamp, or an atom that is not said to be one");
  // One in 250 of them is by chance as good as none.
  EXPECT_EQ(found([](auto& u) { return Vec3{std::max(u[0], 0.004), u[1], 0}; }), "");
}

/// Of 40 items: samples choose item i with `chosen(i)`, pmf() says `stated(i)`.
std::string found_in_set(const std::function<double(int)>& chosen,
                         const std::function<double(int)>& stated) {
  constexpr int kSize = 40;
  OneView v(Domain::discrete(kSize));
  double all = 0;
  for (int i = 0; i < kSize; ++i) all += chosen(i);
  v.pair.sample = [=](const Uniforms& u) -> std::optional<SampleRecord> {
    double left = u[0] * all;
    int i = 0;
    while (i + 1 < kSize && left >= chosen(i)) left -= chosen(i++);
    return SampleRecord{{double(i), 0, 0}, {}, {}};
  };
  v.pair.pdf = [=](const Vec3& x) { return stated(int(x[0])); };
  return words_of(explain_discrete(v.evidence));
}

TEST(Findings, FaultsOfAChoiceAreFound) {
  const auto rising = [](int i) { return (i + 1) / 820.0; };
  EXPECT_EQ(found_in_set(rising, rising), "");
  EXPECT_EQ(found_in_set(rising, [&](int i) { return 1.00009 * rising(i); }), "");
  const std::string constant = kind_word(CauseKind::constant);
  EXPECT_EQ(found_in_set(rising, [&](int i) { return 2 * rising(i); }),
            constant + "pmf() adds up to 2, and is in proportion to how often each is chosen");
  EXPECT_EQ(
      found_in_set(rising, [&](int i) { return 40 * rising(i); }),
      constant +
          "pmf() adds up to 40, the number of items: a density over [0, 1), not a probability");
  EXPECT_EQ(
      found_in_set(rising, [](int) { return 1 / 40.0; }),
      kind_word(CauseKind::choice_probability) +
          "pmf() is the same for all, 0.025, but they are not chosen alike: the weight of the "
          "chosen one is missing");
  EXPECT_EQ(found_in_set([&](int i) { return i < 20 ? rising(i) : 0; }, rising),
            kind_word(CauseKind::numbers_reused) +
                "74.4 % of pmf() is on what is never chosen: a random number that has chosen one "
                "way is used again without being stretched to [0, 1)?");
  // Item 30 with 0.0178 in place of 0.0378 is farther off, in errors of its count, than item 7 with
  // 0.0298 in place of 0.0098.
  const std::string other = found_in_set(rising, [&](int i) {
    return rising(i) + (i == 7 ? 0.02 : i == 30 ? -0.02 : 0);
  });
  EXPECT_TRUE(begins_with(other, kind_word(CauseKind::choice_probability) +
                                     "pmf() is not the probability of choosing: "))
      << other;
  EXPECT_NE(other.find("of the samples are item 30, for which it gives 0.0178049"),
            std::string::npos)
      << other;
}

TEST(Findings, PlacesWithoutSamplesAreMeasured) {
  const auto never = [](double from) {
    OneView v(Domain::unit_square());
    v.pair.sample = [=](const Uniforms& u) -> std::optional<SampleRecord> {
      return SampleRecord{{from + (1 - from) * u[0], u[1], 0}, {}, {}};
    };
    return share_never_sampled(v.view());
  };
  EXPECT_EQ(never(0), 0);
  EXPECT_NEAR(never(0.25), 0.25, 1e-12);
  // The view that lacks most of it counts.
  OneView some(Domain::unit_square());
  some.pair.sample = [](const Uniforms& u) -> std::optional<SampleRecord> {
    return SampleRecord{{u[0] / 2, u[1], 0}, {}, {}};
  };
  OneView all(Domain::unit_square());
  EXPECT_NEAR(never_sampled({{some.view(), all.view()}, {}, {}}), 0.5, 1e-12);
}

TEST(Findings, DenserElsewhereByWhatIsNeverSampled) {
  const auto found = [](double times, double never) {
    SeenRatios seen(
        Domain::unit_square(), [](const Vec3&) { return 1.0; }, {kRatiosPerView, Vec3{0.5, 0.5, 0}},
        [=](const Vec3&) { return times; });
    return words_of(explain_empty_places(Observations::of_density(seen.evidence()), never));
  };
  EXPECT_EQ(found(4 / 3.0, 0.25),
            kind_word(CauseKind::support) +
                "no sample falls where 25 % of pdf() is, and the rest is 1.33333 times as dense as "
                "it says");
  EXPECT_EQ(found(1 / 0.81, 0.19), "") << "too little";
  EXPECT_EQ(found(1.06 / 0.75, 0.25), "") << "not by that share";
  EXPECT_NE(found(1.04 / 0.75, 0.25), "");
}

TEST(Findings, SamplersThatDrawAgainAreFound) {
  const auto again = [](int after) {
    SamplingPair pair;
    pair.draw = [after, calls = 0](Random& random) mutable -> std::optional<SampleRecord> {
      if (++calls > after) random.uniform();
      return SampleRecord{{random.uniform(), 0, 0}, {}, {}};
    };
    return takes_more_at_times(pair);
  };
  EXPECT_TRUE(again(1));
  EXPECT_TRUE(again(199));
  EXPECT_FALSE(again(200)) << "two hundred are looked at";
  EXPECT_FALSE(again(0)) << "always two";
  EXPECT_FALSE(takes_more_at_times(OneView(Domain::unit_square()).pair));
}

/// Records that state pdf() times a multiple.
TEST(Findings, WhatARecordDependsOnIsFound) {
  const auto judged = [](const std::function<double(const Uniforms&)>& times, auto ask) {
    OneView v(Domain::unit_square());
    v.pair.sample = [=](const Uniforms& u) -> std::optional<SampleRecord> {
      return SampleRecord{{u[0], u[1], 0}, {}, times(u)};
    };
    v.pair.numbers = 3;
    return ask(v.evidence);
  };
  const auto multiples = [](auto& e) { return multiples_in_records(e); };
  EXPECT_EQ(judged([](auto& u) { return u[2] < 0.5 ? 0.3 : 0.7; }, multiples), 2u);
  EXPECT_EQ(judged([](auto& u) { return std::ceil(5 * u[2]) / 5; }, multiples), 5u);
  EXPECT_EQ(judged([](auto&) { return 0.5; }, multiples), 0u) << "one is a constant";
  EXPECT_EQ(judged([](auto& u) { return u[2] < 0.6 ? 1 : 0.7; }, multiples), 0u) << "mostly right";
  EXPECT_EQ(judged([](auto& u) { return 0.5 + u[2]; }, multiples), 0u) << "far too many";
  const auto dependence = [](auto& e) { return dependence_of(e, false); };
  EXPECT_EQ(judged([](auto& u) { return 1 + u[0]; }, dependence), Dependence::on_the_point);
  EXPECT_EQ(judged([](auto& u) { return u[2] < 0.5 ? 1 + u[0] : 3 + u[1]; }, dependence),
            Dependence::on_a_choice);
  EXPECT_EQ(judged([](auto& u) { return 1 + u[2]; }, dependence), Dependence::on_the_last_bits);
}

}  // namespace
}  // namespace plumbline::verify
