#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <cmath>
#include <numbers>
#include <optional>

#include <plumbline/verify/pair.h>

namespace plumbline::verify {
namespace {

using tests::expect_verdict;

using std::numbers::pi_v;

/// A vector class as another project has it.
struct Direction {
  float x, y, z;
};

/// A vector class that knows its components by index only.
class Indexed {
 public:
  double operator[](int i) const { return v_[i]; }
  double& operator[](int i) { return v_[i]; }

 private:
  double v_[3] = {0, 0, 0};
};

std::optional<Direction> cosine(float u, float v) {
  const float radius = std::sqrt(u), phi = 2 * pi_v<float> * v;
  return Direction{radius * std::cos(phi), radius * std::sin(phi), std::sqrt(1 - u)};
}

float cosine_pdf(const Direction& w) { return w.z > 0 ? w.z / pi_v<float> : 0; }

ContractOptions options(const char* subject) {
  ContractOptions o;
  o.seed = tests::check_seed(subject);
  return o;
}

/// The check under the seed of its subject, with the verdict that it must give.
template <class D>
CheckResult check(const char* subject, Verdict expected, auto density, auto sampler) {
  CheckResult r = check_chi_square<D>(subject, density, sampler, options(subject));
  r.expected = expected;
  return r;
}

/// A density that integrates to 1 is refuted by samples, not by its integral: a cubature that is
/// off, or cannot decide, would be no sign that the counts are looked at.
void expect_fails_by_bins(const CheckResult& r) {
  expect_verdict(r);
  EXPECT_NE(r.reason.find("bins, the one around"), std::string::npos) << r.reason;
  EXPECT_EQ(r.reason.find("∫pdf"), std::string::npos) << r.reason;
}

TEST(ChiSquare, PassesACorrectPair) {
  const CheckResult r = check<Direction>("chi2/cosine", Verdict::pass, cosine_pdf, cosine);
  expect_verdict(r);
  EXPECT_LE(r.bound, r.tolerance);
}

TEST(ChiSquare, TakesAnyVectorType) {
  expect_verdict(check<Indexed>(
      "chi2/indexed vector", Verdict::pass,
      [](const Indexed& w) { return w[2] > 0 ? w[2] / std::numbers::pi : 0.0; },
      [](double u, double v) -> std::optional<Indexed> {
        Indexed w;
        w[0] = std::sqrt(u) * std::cos(2 * std::numbers::pi * v);
        w[1] = std::sqrt(u) * std::sin(2 * std::numbers::pi * v);
        w[2] = std::sqrt(1 - u);
        return w;
      }));
}

TEST(ChiSquare, FailsAPdfOfAnotherShape) {
  // 2 % of the mass moved from the pole to the rim: invisible to the integral.
  expect_fails_by_bins(check<Direction>(
      "chi2/tilted pdf", Verdict::fail,
      [](const Direction& w) { return cosine_pdf(w) * (1 + 0.1f * (w.z - 2.0f / 3)); }, cosine));
}

TEST(ChiSquare, FailsAPdfWithAWrongConstant) {
  const CheckResult r = check<Direction>(
      "chi2/forgotten pi", Verdict::fail, [](const Direction& w) { return w.z > 0 ? w.z : 0.0f; },
      cosine);
  expect_verdict(r);
  EXPECT_NE(r.reason.find("∫pdf = 3.14"), std::string::npos) << r.reason;
}

TEST(ChiSquare, FailsOnTheFirstSamplesWhereThePdfIsZero) {
  // One sample in 2,000 goes below the horizon: 50 of the first 100,000, none of them once in e^50.
  const CheckResult r = check<Direction>("chi2/stray samples", Verdict::fail, cosine_pdf,
                                         [](float u, float v) -> std::optional<Direction> {
                                           auto w = cosine(u, v);
                                           if (v > 1 - 1 / 2'000.0f) w->z = -w->z;
                                           return w;
                                         });
  expect_verdict(r);
  EXPECT_EQ(r.samples, 100'000u);
  EXPECT_NE(r.reason.find("pdf is 0"), std::string::npos) << r.reason;
}

TEST(ChiSquare, CountsRejectedSamples) {
  const auto rejecting = [](float u, float v) -> std::optional<Direction> {
    // The rim, a tenth of all samples, is rejected.
    return u < 0.9f ? cosine(u, v) : std::nullopt;
  };
  const auto inside = [](const Direction& w) { return w.z * w.z > 0.1f ? cosine_pdf(w) : 0.0f; };
  expect_verdict(check<Direction>("chi2/rejected", Verdict::pass, inside, rejecting));
  const CheckResult wrong =
      check<Direction>("chi2/rejected but in the pdf", Verdict::fail, cosine_pdf, rejecting);
  expect_verdict(wrong);
  EXPECT_NE(wrong.reason.find("with atoms and rejected samples 1.1"), std::string::npos)
      << wrong.reason;
}

TEST(ChiSquare, NeverPassesADensityThatIsNotFinite) {
  expect_verdict(check<Direction>(
      "chi2/NaN in the pdf", Verdict::fail,
      [](const Direction& w) { return w.x > 0.999f ? std::nanf("") : cosine_pdf(w); }, cosine));
}

TEST(ChiSquare, IsInconclusiveWithTooFewSamples) {
  ContractOptions o = options("chi2/too few samples");
  o.first_look = o.samples = 20'000;
  CheckResult r = check_chi_square<Direction>("chi2/too few samples", cosine_pdf, cosine, o);
  r.expected = Verdict::inconclusive;
  expect_verdict(r);
}

TEST(ChiSquare, SeesALobeWeightOfFiftyOnePercent) {
  // Half of the samples in a narrow lobe about z, half cosine; the pdf says 0.51 and 0.49.
  const float k = 1e4f;
  const auto lobe_pdf = [k](const Direction& w) {
    const float h = (w.x * w.x + w.y * w.y) / (1 + std::abs(w.z));
    return w.z > 0 ? k / (2 * pi_v<float>)*std::exp(-k * h) : 0.0f;
  };
  const auto density = [=](float weight) {
    return [=](const Direction& w) { return weight * lobe_pdf(w) + (1 - weight) * cosine_pdf(w); };
  };
  const auto half_and_half = [k](float u, float v) -> std::optional<Direction> {
    if (v < 0.5f) return cosine(u, 2 * v);
    const float h = -std::log1p(-u) / k, phi = 2 * pi_v<float> * (2 * v - 1);
    const float radius = std::sqrt(h * (2 - h));
    return Direction{radius * std::cos(phi), radius * std::sin(phi), 1 - h};
  };
  expect_verdict(
      check<Direction>("chi2/lobe weight 0.50", Verdict::pass, density(0.50f), half_and_half));
  // Of the 4096 finest bins alone 0.02² · 1e6 makes 4.4 standard deviations √(2·4096), less than
  // the level asks for; of 64 bins 35. Missed with a chance below 1e-9, so that no run of many may.
  ContractOptions o = options("chi2/lobe weight 0.51");
  for (int i = 0; i < (tests::nightly() ? 1000 : 20); ++i, ++o.seed) {
    CheckResult r =
        check_chi_square<Direction>("chi2/lobe weight 0.51", density(0.51f), half_and_half, o);
    r.expected = Verdict::fail;
    expect_fails_by_bins(r);
  }
}

TEST(ChiSquare, AFailShowsItsBins) {
  const auto line = [](const std::string& name, double low) {
    return sampling_pair<double>(
        name, Domain::interval(), [low](double u) { return low + (1 - low) * u; },
        [](double) { return 1.0; });
  };
  const CheckResult right = check_chi_square(line("right", 0));
  EXPECT_EQ(right.verdict, Verdict::pass);
  EXPECT_TRUE(right.bins.empty());
  const CheckResult wrong = check_chi_square(line("wrong", 0.25));
  ASSERT_EQ(wrong.verdict, Verdict::fail);
  ASSERT_EQ(wrong.bins.size(), 256u);
  double length = 0, observed = 0, expected = 0;
  for (const Bin& bin : wrong.bins) {
    length += bin.x.high - bin.x.low;
    observed += bin.observed;
    expected += bin.expected;
    if (bin.x.high <= 0.25) {
      EXPECT_EQ(bin.observed, 0);
    }
  }
  const auto samples = static_cast<double>(wrong.samples);
  EXPECT_NEAR(length, 1, 1e-12);
  EXPECT_EQ(observed, samples);
  EXPECT_NEAR(expected, samples, 1e-3 * samples);

  const CheckResult set = check_chi_square(sampling_pair<int>(
      "set", Domain::discrete(3), [](float u) { return u < 0.5f ? 0 : 2; },
      [](int) { return 1.0 / 3; }));
  ASSERT_EQ(set.verdict, Verdict::fail);
  EXPECT_EQ(set.bins[1].observed, 0);
  EXPECT_EQ(set.bins[1].x, (Interval{1, 2}));
}

}  // namespace
}  // namespace plumbline::verify
