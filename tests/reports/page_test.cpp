#include <gtest/gtest.h>
#include <plumbline_tests/support.h>
#include <sys/resource.h>
#include <unistd.h>
#include <zlib.h>

#include <bit>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <plumbline/reports/page.h>

#include "json.h"
#include "samples.h"

namespace plumbline::tests {
namespace {

namespace fs = std::filesystem;
using reports::make_page;
using reports::PageInput;
using reports::detail::Json;

PageInput sample_input() {
  PageInput input;
  input.results.checks = {sample_check()};
  input.results.environments = {sample_environment()};
  input.results.renders = {sample_render()};
  input.results.speed = {sample_speed_point()};
  input.results.ray_costs = {sample_ray_cost()};
  input.results.bars = {sample_bar()};
  input.results.stability = {sample_stability_record()};
  input.results.causes = {sample_causes_record()};
  input.results.figures = {sample_figure()};
  input.results.tables = {sample_table()};
  input.results.histories = {sample_history()};
  input.images = {{"furnace_sphere", "mis, power", 1, 1, {0.5f, 0.25f, 0.125f}}};
  input.answers = {{"furnace_sphere", "L = Le / (1 - albedo)"}};
  return input;
}

/// The text between two others, the first time they occur.
std::string between(const std::string& text, const std::string& open, const std::string& close) {
  const std::size_t begin = text.find(open);
  if (begin == std::string::npos) return {};
  const std::size_t from = begin + open.size();
  return text.substr(from, text.find(close, from) - from);
}

std::string decode_base64(const std::string& text) {
  static const std::string kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t bits = 0;
  int held = 0;
  for (const char c : text) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<std::uint32_t>(kDigits.find(c));
    held += 6;
    if (held >= 8) {
      held -= 8;
      bytes += static_cast<char>(bits >> held);
    }
  }
  return bytes;
}

/// What base64 and zlib were made of, by zlib itself.
std::string inflate(const std::string& base64) {
  const std::string packed = decode_base64(base64);
  std::string bytes;
  z_stream stream{};
  if (::inflateInit(&stream) != Z_OK) throw std::runtime_error("inflateInit");
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = static_cast<uInt>(packed.size());
  int status = Z_OK;
  while (status == Z_OK) {
    char part[4096];
    stream.next_out = reinterpret_cast<Bytef*>(part);
    stream.avail_out = sizeof part;
    status = ::inflate(&stream, Z_NO_FLUSH);
    bytes.append(part, sizeof part - stream.avail_out);
  }
  ::inflateEnd(&stream);
  if (status != Z_STREAM_END) throw std::runtime_error("not what zlib makes");
  return bytes;
}

/// What a browser takes for the data: up to the first `</script`, whatever stands in it.
Json data_of(const std::string& page) {
  return Json::parse(
      inflate(between(page, "<script type=\"text/plain\" id=\"data\">", "</script")));
}

/// The values of the only image of a page, as the browser puts them together.
std::vector<float> pixels_of(const std::string& page) {
  const std::string bytes =
      inflate(between(page, "<script type=\"text/plain\" id=\"images\">\n", "\n"));
  std::vector<float> values;
  for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) {
    const auto byte = [&](std::size_t k) {
      return std::uint32_t{static_cast<std::uint8_t>(bytes[k])};
    };
    values.push_back(std::bit_cast<float>((byte(i) | byte(i + 1) << 8) << 16));
  }
  return values;
}

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++count;
  }
  return count;
}

TEST(Page, HoldsEveryRecordOfTheResults) {
  const Json data = data_of(make_page(sample_input()));
  EXPECT_EQ(data["checks"][0]["subject"], "furnace_sphere/mis/power");
  EXPECT_EQ(data["checks"][0]["as_expected"], false);
  EXPECT_EQ(data["summary"]["unexpected"], 1);
  EXPECT_EQ(data["environments"][0]["commit"], "0123456789abcdef");
  EXPECT_EQ(data["renders"][0]["scene"], "furnace_sphere");
  EXPECT_EQ(data["speed"][0]["curves"][0]["strategy"], "one-sample");
  EXPECT_EQ(data["ray_costs"][0]["ratio"], 0.75);
  EXPECT_EQ(data["bars"][0]["verdict"], "indicative");
  EXPECT_EQ(data["stability"][0]["condition"], 3e5);
  EXPECT_EQ(data["causes"][0]["twins"][1]["named"], "shifted");
  EXPECT_EQ(data["figures"][0]["title"], "Error against samples");
  EXPECT_EQ(data["tables"][0]["rows"][1][1], "1.25");
  EXPECT_EQ(data["history"][0]["numbers"][0]["median"][1], 2);
  EXPECT_EQ(data["history"][0]["failing_gate_runs"][0]["seed"], "18446744073709551614");
  EXPECT_EQ(data["history"][0]["nights"][1]["parts"][0]["status"], "timed out");
  EXPECT_EQ(data["images"][0]["group"], "furnace_sphere");
  EXPECT_EQ(data["answers"]["furnace_sphere"], "L = Le / (1 - albedo)");
}

TEST(Page, ValuesOfPlotsOverNightsAreRoundedButNotWhatIsCounted) {
  PageInput input = sample_input();
  reports::TrackedNumber& time = input.results.histories[0].numbers[0];
  time.counter = false;
  time.median = {1.23456789, std::numeric_limits<double>::quiet_NaN()};
  reports::TrackedNumber rays = time;
  rays.counter = true;
  rays.median = {123'456'789, 987'654'321};
  input.results.histories[0].numbers.push_back(rays);
  input.results.histories[0].sequences[0].bound[0] = 0.0012345;
  const Json numbers = data_of(make_page(input))["history"][0]["numbers"];
  EXPECT_EQ(numbers[0]["median"][0], 1.2346);
  EXPECT_TRUE(numbers[0]["median"][1].is_null());
  EXPECT_EQ(numbers[1]["median"][0], 123'456'789);
  EXPECT_EQ(data_of(make_page(input))["history"][0]["sequences"][0]["bound"][0], 0.00123);
}

TEST(Page, SeedsAreTextBecauseTheBrowserWouldRoundThem) {
  const Json data = data_of(make_page(sample_input()));
  EXPECT_EQ(data["checks"][0]["seed"], "18446744073709551615");
  EXPECT_EQ(data["renders"][0]["seed"], "18446744073709551614");
  EXPECT_EQ(data["causes"][0]["seed"], "18446744073709551613");
}

TEST(Page, IsSelfContained) {
  const std::string page = make_page(sample_input());
  std::string markup = between(page, "<!doctype", "<script");
  std::erase_if(markup, [](char c) {
    return std::string_view(" \t\n\r\"'").find(c) != std::string_view::npos;
  });
  for (const std::string attribute : {"src=", "href=", "action=", "data="}) {
    for (const char* start : {"http:", "https:", "file:", "/", "./", "../"}) {
      EXPECT_EQ(markup.find(attribute + start), std::string::npos) << attribute << start;
    }
  }
  for (const char* text : {"<script src", "@import", "url(", "<img", "<iframe", "fetch(",
                           "XMLHttpRequest", "sourceMappingURL", "import("}) {
    EXPECT_EQ(page.find(text), std::string::npos) << text;
  }
  EXPECT_NE(page.find("default-src 'none'"), std::string::npos);
  EXPECT_NE(page.find("Chart.js v"), std::string::npos) << "the plots' library, with its notice";
  for (const char* part : {"{{css}}", "{{data}}", "{{images}}", "{{chart}}", "{{script}}"}) {
    EXPECT_EQ(page.find(part), std::string::npos) << part;
  }
}

TEST(Page, NoTextCanEndTheScriptThatHoldsIt) {
  const std::string plain = make_page(sample_input());
  PageInput input = sample_input();
  const std::string hostile = "</script><script>alert(1)</script><!--<script>{{css}}\u2028";
  input.results.checks[0].reason = hostile;
  input.results.stability[0].place = hostile;
  input.results.causes[0].twins[0].fault = hostile;
  input.results.figures[0].title = hostile;
  input.results.renders[0].parameters = {{hostile, hostile}};
  input.results.warnings = {{"a.jsonl", 1, hostile}};
  input.images[0].name = hostile;
  const std::string page = make_page(input);
  for (const char* markup : {"<script", "</script", "<!--"}) {
    EXPECT_EQ(count_of(page, markup), count_of(plain, markup)) << markup;
  }
  EXPECT_EQ(data_of(page)["checks"][0]["reason"], hostile);
  EXPECT_EQ(data_of(page)["images"][0]["name"], hostile);
}

PageInput with_pixels(const std::vector<float>& rgb) {
  PageInput input = sample_input();
  input.images[0] = {"scene", "mis", static_cast<int>(rgb.size() / 3), 1, rgb};
  return input;
}

/// Half of the last of 8 binary digits, 2⁻⁸ of a value just above a power of two.
TEST(Page, PixelsArriveRoundedToEightBinaryDigits) {
  std::vector<float> values{1.0f, 1.00390625f, 1.01f, 0.1f, 16777217.0f, 1.2e-38f, -2.3f, 1e30f};
  for (int i = 0; i < 1000; ++i) values.push_back(std::exp2(-20 + 0.041f * static_cast<float>(i)));
  for (std::size_t pixels : {1u, 2u, 3u, 336u}) {  // every length of base64's last group
    const std::vector<float> sent(values.begin(),
                                  values.begin() + static_cast<std::ptrdiff_t>(3 * pixels));
    const std::vector<float> got = pixels_of(make_page(with_pixels(sent)));
    ASSERT_EQ(got.size(), sent.size());
    for (std::size_t i = 0; i < sent.size(); ++i) {
      EXPECT_LE(std::abs(got[i] - sent[i]), std::ldexp(std::abs(sent[i]), -8)) << sent[i];
    }
  }
}

/// A picture that shows a finite pixel as one that is not, or hides one that is not, misleads.
TEST(Page, PixelsThatAreNotFiniteArriveAsSuchAndNoOthers) {
  using Limits = std::numeric_limits<float>;
  const std::vector<float> got = pixels_of(
      make_page(with_pixels({0.0f, -0.0f, 1e-40f, Limits::max(), -Limits::max(), Limits::infinity(),
                             -Limits::infinity(), Limits::quiet_NaN(), Limits::signaling_NaN()})));
  ASSERT_EQ(got.size(), 9u);
  EXPECT_EQ(got[0], 0.0f);
  EXPECT_TRUE(std::signbit(got[1]));
  for (std::size_t i = 0; i < 5; ++i) EXPECT_TRUE(std::isfinite(got[i])) << i;
  EXPECT_EQ(got[5], Limits::infinity());
  EXPECT_EQ(got[6], -Limits::infinity());
  EXPECT_TRUE(std::isnan(got[7]));
  EXPECT_TRUE(std::isnan(got[8]));
}

/// The page of an image of one value; 27,648 pixels of it take 332 kB as floats in base64.
TEST(Page, WhatRepeatsTakesNoSpace) {
  const std::size_t plain = make_page(with_pixels({0.5f, 0.5f, 0.5f})).size();
  const std::vector<float> grey(std::size_t{3} * 192 * 144, 0.5f);
  EXPECT_LT(make_page(with_pixels(grey)).size(), plain + 1000);
}

TEST(Page, ImageWhoseSizeAndDataDisagreeIsRefused) {
  PageInput input = sample_input();
  input.images[0].rgb.pop_back();
  EXPECT_THROW(make_page(input), std::invalid_argument);
  input.images[0] = {"scene", "mis", 0, 0, {}};
  EXPECT_THROW(make_page(input), std::invalid_argument);
}

/// relMSE = 0.09/t, so the error is 0.3·t^(−1/2).
TEST(Page, SlopeOfErrorAgainstTimeIsFittedPerCurve) {
  PageInput input;
  for (const char* strategy : {"bsdf", "mis"}) {
    for (double seconds = 0.25; seconds < 100; seconds *= 4) {
      reports::SpeedPoint point = sample_speed_point();
      point.strategy = strategy;
      point.seconds = seconds;
      point.rel_mse = 0.09 / seconds * (strategy[0] == 'm' ? 0.25 : 1);
      point.rel_mse_low = 0.8 * point.rel_mse;
      point.rel_mse_high = point.rel_mse / 0.8;
      input.results.speed.push_back(point);
    }
  }
  const Json curves = data_of(make_page(input))["speed"][0]["curves"];
  ASSERT_EQ(curves.elements().size(), 2u);
  EXPECT_EQ(curves[0]["strategy"], "bsdf");
  EXPECT_NEAR(curves[0]["slope"].as_double(), -0.5, 1e-12);
  EXPECT_NEAR(curves[0]["factor"].as_double(), 0.3, 1e-12);
  EXPECT_NEAR(curves[1]["factor"].as_double(), 0.15, 1e-12);
  EXPECT_GT(curves[0]["slope_error"].as_double(), 0);
}

TEST(WritePage, MakesMissingDirectoriesAndLeavesNothingElse) {
  const ScratchDirectory scratch;
  const fs::path path = scratch / "a" / "b" / "index.html";
  reports::write_page(sample_input(), path);
  EXPECT_EQ(text_of(path), make_page(sample_input()));
  int entries = 0;
  for (const auto& entry : fs::directory_iterator(path.parent_path())) entries += entry.exists();
  EXPECT_EQ(entries, 1);
}

/// A limit on the size of files stands in for the full disk. That the old page survives it is for
/// the command to see to: tests/tools.
TEST(WritePage, TellsOfAFailure) {
  const ScratchDirectory scratch;
  const fs::path path = scratch / "index.html";
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit small = before;
  small.rlim_cur = 4096;
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  EXPECT_THROW(reports::write_page(sample_input(), path), std::system_error);
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, old_handler);
}

TEST(WritePage, PathThatIsADirectoryIsAnErrorThatNamesIt) {
  const ScratchDirectory scratch;
  fs::create_directory(scratch / "page");
  try {
    reports::write_page(sample_input(), scratch / "page");
    FAIL() << "wrote over a directory";
  } catch (const std::system_error& error) {
    EXPECT_NE(std::string(error.what()).find("page"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace plumbline::tests
