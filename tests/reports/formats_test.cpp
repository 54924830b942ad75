#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "json.h"
#include "samples.h"

namespace plumbline::tests {
namespace {

using reports::FormatError;
using reports::detail::Json;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The message with which a text is refused; empty if it is taken.
std::string refusal_of_check(const std::string& text) {
  try {
    reports::parse_check(text);
    return {};
  } catch (const FormatError& error) {
    return error.what();
  }
}

/// A check's JSON with one field replaced.
std::string check_with(const char* field, const Json& value) {
  Json json = Json::parse(reports::to_json(sample_check()));
  json[field] = value;
  return json.dump();
}

TEST(Formats, EveryRecordSurvivesTheRoundTrip) {
  using namespace reports;
  EXPECT_EQ(parse_environment(to_json(sample_environment())), sample_environment());
  EXPECT_EQ(parse_render_record(to_json(sample_render())), sample_render());
  EXPECT_EQ(parse_speed_point(to_json(sample_speed_point())), sample_speed_point());
  EXPECT_EQ(parse_ray_cost(to_json(sample_ray_cost())), sample_ray_cost());
  EXPECT_EQ(parse_bar(to_json(sample_bar())), sample_bar());
  EXPECT_EQ(parse_stability_record(to_json(sample_stability_record())), sample_stability_record());
  EXPECT_EQ(parse_causes_record(to_json(sample_causes_record())), sample_causes_record());
  EXPECT_EQ(parse_duet_record(to_json(sample_duet_record())), sample_duet_record());
  EXPECT_EQ(parse_figure(to_json(sample_figure())), sample_figure());
  EXPECT_EQ(reports::parse_table(to_json(sample_table())), sample_table());
  EXPECT_EQ(parse_distribution(to_json(sample_distribution())), sample_distribution());
  EXPECT_EQ(parse_counter(to_json(sample_counter())), sample_counter());
  EXPECT_EQ(parse_seed_run(to_json(sample_seed_run())), sample_seed_run());
  EXPECT_EQ(parse_history(to_json(sample_history())), sample_history());
}

TEST(Formats, CheckIsReadBackFieldByField) {
  const verify::CheckResult in = sample_check();
  const verify::CheckResult out = reports::parse_check(reports::to_json(in));
  EXPECT_EQ(out.kind, in.kind);
  EXPECT_EQ(out.subject, in.subject);
  EXPECT_EQ(out.verdict, in.verdict);
  EXPECT_EQ(out.expected, in.expected);
  EXPECT_EQ(out.estimate, in.estimate);
  EXPECT_EQ(out.reference, in.reference);
  EXPECT_EQ(out.tolerance, in.tolerance);
  EXPECT_EQ(out.bound, in.bound);
  EXPECT_EQ(out.detectable, in.detectable);
  EXPECT_EQ(out.p_value, in.p_value);
  EXPECT_EQ(out.interval, in.interval);
  EXPECT_EQ(out.samples, in.samples);
  EXPECT_EQ(out.seconds, in.seconds);
  EXPECT_EQ(out.leaned_on, in.leaned_on);
  EXPECT_EQ(out.reason, in.reason);
  EXPECT_EQ(out.diagnosis, in.diagnosis);
  EXPECT_EQ(out.advice, in.advice);
  EXPECT_EQ(out.waived, in.waived);
  EXPECT_EQ(out.seed, in.seed);
  EXPECT_EQ(out.replay, in.replay);
  EXPECT_EQ(out.figures, in.figures);
  EXPECT_EQ(out.bins, in.bins);
}

TEST(Formats, RenderRecordHoldsWhatTheCommandPromises) {
  const Json json = Json::parse(reports::to_json(sample_render()));
  EXPECT_EQ(json["format"], "plumbline.render/1");
  for (const char* field : {"scene", "strategy", "spp", "seconds", "camera_rays", "bounce_rays",
                            "shadow_rays", "rejected", "non_finite", "mean", "seed", "version"}) {
    EXPECT_TRUE(json.find(field) != nullptr) << field;
  }
  EXPECT_EQ(json["seed"].as_uint64(), 18'446'744'073'709'551'614u);
}

TEST(Formats, EachStatesItsFormatFirstOnOneLine) {
  using namespace reports;
  const std::pair<std::string, std::string> cases[] = {
      {to_json(sample_check()), "plumbline.check/1"},
      {to_json(sample_environment()), "plumbline.environment/1"},
      {to_json(sample_render()), "plumbline.render/1"},
      {to_json(sample_speed_point()), "plumbline.speed/1"},
      {to_json(sample_ray_cost()), "plumbline.ray_cost/1"},
      {to_json(sample_bar()), "plumbline.bar/1"},
      {to_json(sample_stability_record()), "plumbline.stability/1"},
      {to_json(sample_causes_record()), "plumbline.causes/1"},
      {to_json(sample_duet_record()), "plumbline.duet/1"},
      {to_json(sample_figure()), "plumbline.figure/1"},
      {to_json(sample_table()), "plumbline.table/1"},
  };
  for (const auto& [text, format] : cases) {
    EXPECT_EQ(text.rfind("{\"format\":\"" + format + "\"", 0), 0u) << text;
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    EXPECT_EQ(Json::parse(text)["format"], format);
  }
}

TEST(Duets, SidesHaveAsManyTimes) {
  reports::DuetRecord record = sample_duet_record();
  record.a_seconds.push_back(1);
  EXPECT_THROW(reports::to_json(record), FormatError);
  Json json = Json::parse(reports::to_json(sample_duet_record()));
  json["b_seconds"] = Json::array({0.5});
  EXPECT_THROW(reports::parse_duet_record(json.dump()), FormatError);
}

TEST(Duets, AreJudgedByTheWholeInterval) {
  const auto verdict_of = [](double low, double high) {
    reports::DuetRecord record;
    record.a_seconds = record.b_seconds = {1};
    record.low = low;
    record.high = high;
    return reports::verdict(record);
  };
  EXPECT_EQ(verdict_of(1.0101, 1.03), "slower");
  EXPECT_EQ(verdict_of(1.0099, 1.03), "undecided") << "reaches into what layout may do";
  EXPECT_EQ(verdict_of(0.97, 0.99), "faster");
  EXPECT_EQ(verdict_of(0.97, 0.9902), "undecided");
  EXPECT_EQ(verdict_of(0.9902, 1.0099), "no change");
  EXPECT_EQ(verdict_of(0.9, 1.1), "undecided");
  EXPECT_EQ(verdict_of(std::nan(""), std::nan("")), "undecided");
}

TEST(Duets, WithoutTimesSayWhy) {
  reports::DuetRecord record;
  EXPECT_EQ(reports::verdict(record), "not timed");
  record.identical_code = true;
  EXPECT_EQ(reports::verdict(record), "identical code");
}

TEST(Bars, AreMetOnlyWhereTheWholeIntervalIs) {
  const auto verdict_of = [](bool at_least, double low, double high) {
    reports::Bar bar;
    bar.at_least = at_least;
    bar.limit = 1;
    bar.low = low;
    bar.measured = (low + high) / 2;
    bar.high = high;
    return std::string(reports::verdict(bar));
  };
  EXPECT_EQ(verdict_of(false, 0.5, 0.9), "met");
  EXPECT_EQ(verdict_of(false, 0.5, 1.1), "open");
  EXPECT_EQ(verdict_of(false, 1.1, 1.2), "missed");
  EXPECT_EQ(verdict_of(true, 1.1, 1.2), "met");
  EXPECT_EQ(verdict_of(true, 0.5, 1.1), "open");
  EXPECT_EQ(verdict_of(true, 0.5, 0.9), "missed");
  EXPECT_EQ(verdict_of(false, std::nan(""), 0.9), "open");
  EXPECT_EQ(verdict_of(true, 1.1, std::nan("")), "open");
  EXPECT_EQ(reports::verdict(sample_bar()), "indicative");
}

TEST(Formats, NotANumberIsNullAndInfinityIsAWord) {
  verify::CheckResult check = sample_check();
  check.bound = kInfinity;
  check.interval = {-kInfinity, 0.375};
  check.p_value = std::nullopt;
  check.figures = {{"skewness", std::nan("")}};
  const std::string text = reports::to_json(check);
  const Json json = Json::parse(text);
  EXPECT_EQ(json["bound"], "inf");
  EXPECT_EQ(json["interval_low"], "-inf");
  EXPECT_TRUE(json["p_value"].is_null());
  const verify::CheckResult out = reports::parse_check(text);
  EXPECT_EQ(out.bound, kInfinity);
  EXPECT_EQ(out.interval->low, -kInfinity);
  EXPECT_EQ(out.p_value, std::nullopt);
  EXPECT_TRUE(std::isnan(out.figures.at(0).value));
}

TEST(Formats, WhatACheckHasNotIsNullAndComesBackAbsent) {
  const std::string text = reports::to_json(verify::CheckResult{});
  const Json json = Json::parse(text);
  for (const char* field : {"estimate", "reference", "tolerance", "bound", "detectable", "p_value",
                            "interval_low", "interval_high"}) {
    EXPECT_TRUE(json[field].is_null()) << field;
  }
  const verify::CheckResult out = reports::parse_check(text);
  EXPECT_FALSE(out.estimate || out.reference || out.tolerance || out.bound || out.detectable);
  EXPECT_FALSE(out.p_value || out.interval);
}

TEST(Formats, FiguresAreReadBackByWhatTheyAre) {
  const verify::CheckResult out = reports::parse_check(reports::to_json(sample_check()));
  EXPECT_EQ(out.figure(verify::Figure::bins), 4096);
  EXPECT_EQ(out.figures.at(1).figure, verify::Figure::other);
  EXPECT_EQ(out.figures.at(1).name(), "a \"quoted\" name");
}

TEST(Formats, TextsKeepQuotesLineBreaksUnicodeAndMarkup) {
  verify::CheckResult check = sample_check();
  check.reason = "θ = 89.9°, \"quoted\"\n\ttabbed \\ </script><!-- 日本 \U0001F4CF";
  EXPECT_EQ(reports::parse_check(reports::to_json(check)).reason, check.reason);
}

TEST(Formats, TextThatIsNotUtf8IsReplacedNotThrownAt) {
  verify::CheckResult check = sample_check();
  check.reason = "bad byte: \xff";
  EXPECT_EQ(reports::parse_check(reports::to_json(check)).reason, "bad byte: \uFFFD");
}

TEST(Formats, UnknownVersionIsRefusedByName) {
  EXPECT_EQ(
      refusal_of_check(check_with("format", "plumbline.check/2")),
      "format \"plumbline.check/2\" is not \"plumbline.check/1\", the one that this version reads");
  EXPECT_EQ(refusal_of_check(reports::to_json(sample_render())),
            "format \"plumbline.render/1\" is not \"plumbline.check/1\", the one that this version "
            "reads");
}

TEST(Formats, FieldAtFaultIsNamed) {
  EXPECT_EQ(refusal_of_check(check_with("samples", -1)),
            "field \"samples\": not a whole number >= 0");
  EXPECT_EQ(refusal_of_check(check_with("samples", 1.5)),
            "field \"samples\": not a whole number >= 0");
  EXPECT_EQ(refusal_of_check(check_with("bound", "small")), "field \"bound\": not a number");
  EXPECT_EQ(refusal_of_check(check_with("subject", 3)), "field \"subject\": not a text");
  EXPECT_EQ(refusal_of_check(check_with("verdict", "maybe")),
            "field \"verdict\": unknown word \"maybe\"");
  EXPECT_EQ(refusal_of_check(check_with("check", "guess")),
            "field \"check\": unknown word \"guess\"");
  EXPECT_EQ(refusal_of_check(check_with("figures", Json::array({"bins"}))),
            "field \"figures\": not a pair of name and number");
}

TEST(Formats, MissingFieldIsNamed) {
  Json json = Json::parse(reports::to_json(sample_check()));
  json.erase("verdict");
  EXPECT_EQ(refusal_of_check(json.dump()), "field \"verdict\" is missing");
}

TEST(Formats, IntegersBeyond32BitsAreRefused) {
  Json json = Json::parse(reports::to_json(sample_render()));
  for (const std::int64_t value : {std::int64_t{1} << 31, -(std::int64_t{1} << 31) - 1}) {
    json["max_depth"] = value;
    EXPECT_THROW(reports::parse_render_record(json.dump()), FormatError) << value;
  }
  json["max_depth"] = -1;
  EXPECT_EQ(reports::parse_render_record(json.dump()).max_depth, -1);
}

TEST(Formats, EveryBeginningOfALineIsRefused) {
  const std::string text = reports::to_json(sample_check());
  for (std::size_t length = 0; length < text.size(); ++length) {
    EXPECT_NE(refusal_of_check(text.substr(0, length)), "") << length;
  }
}

TEST(Formats, WhatIsNotAnObjectIsRefused) {
  for (const char* text :
       {"", "null", "[]", "3", "\"plumbline.check/1\"", "{}", "{\"format\":3}"}) {
    EXPECT_NE(refusal_of_check(text), "") << text;
  }
}

TEST(Formats, FigureWhoseSeriesDisagreeInLengthIsRefused) {
  for (const auto damage : {0, 1, 2}) {
    reports::Figure figure = sample_figure();
    if (damage == 0) figure.series[0].y.pop_back();
    if (damage == 1) figure.series[0].high.clear();
    if (damage == 2) figure.series[1].low = {1};
    EXPECT_THROW(reports::to_json(figure), FormatError) << damage;
  }
}

TEST(Formats, CausesOfWhichATwinLacksSomethingAreRefused) {
  const auto refusal = [](const char* field, const Json& value) -> std::string {
    Json json = Json::parse(reports::to_json(sample_causes_record()));
    json["twins"][1][field] = value;
    try {
      reports::parse_causes_record(json.dump());
    } catch (const FormatError& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_EQ(refusal("expected", ""), "twin \"ggx/frame\" expects no cause");
  EXPECT_EQ(refusal("name", ""), "causes of the set \"third\": a twin has no name");
  EXPECT_EQ(refusal("named", nullptr), "field \"twins\": field \"named\": not a text");
  EXPECT_EQ(refusal("found", "yes"), "field \"twins\": field \"found\": not true or false");
  EXPECT_EQ(refusal("named", ""), "") << "silence is an outcome";
  reports::CausesRecord record = sample_causes_record();
  record.twins[0].expected.clear();
  EXPECT_THROW(reports::to_json(record), FormatError);
}

TEST(Formats, MeasuredWithoutANameOrValuesIsRefused) {
  reports::Distribution distribution = sample_distribution();
  distribution.values.clear();
  EXPECT_THROW(to_json(distribution), FormatError);
  EXPECT_THROW(to_json(reports::Distribution{"", "ns", true, {1}}), FormatError);
  EXPECT_THROW(to_json(reports::Counter{"", "rays", 1}), FormatError);
}

TEST(Formats, HistoryThatDoesNotFitItsAxisIsRefused) {
  const auto refused = [](const auto& spoil) {
    reports::HistoryRecord record = sample_history();
    spoil(record);
    EXPECT_THROW(to_json(record), FormatError);
  };
  using Record = reports::HistoryRecord;
  refused([](Record& r) { r.numbers[0].median.push_back(1); });
  refused([](Record& r) { r.numbers[0].low.pop_back(); });
  refused([](Record& r) { r.numbers[0].high.clear(); });
  refused([](Record& r) { r.numbers[0].changes[0].last_night = 2; });
  refused([](Record& r) { r.numbers[0].changes[0].first_night = 2; });
  refused([](Record& r) { r.numbers[0].odd_nights = {2}; });
  refused([](Record& r) { r.sequences[0].bound.push_back(1); });
  refused([](Record& r) { r.sequences[0].evidence.pop_back(); });
}

TEST(Formats, EnvironmentOfThisBuildIsFilledIn) {
  const reports::RunEnvironment environment = reports::current_environment();
  EXPECT_FALSE(environment.version.empty());
  EXPECT_TRUE(environment.commit == "unknown" || environment.commit.size() == 40)
      << environment.commit;
  EXPECT_NE(environment.compiler, "unknown");
  EXPECT_GT(environment.cores, 0);
  EXPECT_GE(environment.load_average, 0);
  EXPECT_EQ(environment.time.size(), std::string("2024-02-29T12:00:00Z").size());
  EXPECT_TRUE(environment.same_build(reports::current_environment()));
}

}  // namespace
}  // namespace plumbline::tests
