#include "diagnosis/observations.h"

#include <gtest/gtest.h>

#include <cmath>
#include <span>
#include <vector>

#include <plumbline/verify/pair.h>

#include "lattice.h"

/// What is allowed for a residual, at the border of what is: exact ratios, counts, masses, strays.
namespace plumbline::verify {
namespace {

/// One view of the unit square, with pdf() 1, and what was seen of it.
struct Seen {
  SamplingPair pair;
  ReportEvidence evidence;

  Seen() {
    pair.domain = Domain::unit_square();
    pair.pdf = [](const Vec3&) { return 1.0; };
    evidence.views.resize(1);
    view().pair = &pair;
  }
  Seen(const Seen&) = delete;
  Seen& operator=(const Seen&) = delete;

  ViewEvidence& view() { return evidence.views.front(); }

  /// Ratios of 1, known to an error, the first `odd` of them off by so many errors.
  void see_ratios(int count, double error, int odd, double errors_off) {
    RatioSeries& series = view().ratios.emplace_back();
    series.kind = RatioKind::density_over_pdf;
    for (const Point2& p : even_points(count)) {
      const bool is_odd = static_cast<int>(series.points.size()) < odd;
      series.points.push_back(
          {{p[0], p[1], 0}, is_odd ? std::exp(errors_off * error) : 1, error, -1, {}});
    }
  }

  /// Bins of even mass with two nodes each, the first `odd` of them off by so many standard errors.
  void see_counts(int count, double each, int odd, double errors_off) {
    view().samples = count * each;
    for (const Point2& p : even_points(count)) {
      BinSeen& bin = view().bins.emplace_back();
      bin.expected = each;
      // The root of a count has the standard error ½.
      const double root = std::sqrt(each + 0.375) + errors_off / 2;
      bin.observed = static_cast<int>(view().bins.size()) <= odd ? root * root - 0.375 : each;
      bin.nodes = {{p[0], p[1], 0}, {p[1], p[0], 0}};
      bin.shares = {0.5, 0.5};
    }
  }

  bool holds(const Prediction& prediction = as_stated, std::span<const double> numbers = {}) const {
    return Observations::of_density(evidence).judge(prediction, numbers).admissible;
  }
};

bool ratios_hold(int count, double error, int odd, double errors_off) {
  Seen seen;
  seen.see_ratios(count, error, odd, errors_off);
  return seen.holds();
}

TEST(Observations, RatiosMayBeOffByFourErrors) {
  EXPECT_TRUE(ratios_hold(90, 1e-2, 90, 3.9));
  EXPECT_FALSE(ratios_hold(90, 1e-2, 1, 4.1));
  EXPECT_FALSE(ratios_hold(90, 1e-2, 1, -4.1));
}

/// Errors are estimates: a tenth of the points may be off by what differences are, 1e-4.
TEST(Observations, ATenthOfTheRatiosMayBeAsFarOffAsDifferencesAre) {
  EXPECT_TRUE(ratios_hold(90, 1e-6, 9, 90));
  EXPECT_FALSE(ratios_hold(90, 1e-6, 10, 90));
  EXPECT_FALSE(ratios_hold(90, 1e-6, 1, 110));
}

/// Of many ratios a few may be wild: three, or 7 in a thousand.
TEST(Observations, AFewOfManyRatiosMayBeWild) {
  constexpr double kWild = 1e4;
  EXPECT_FALSE(ratios_hold(99, 1e-4, 1, kWild));
  EXPECT_TRUE(ratios_hold(100, 1e-4, 3, kWild));
  EXPECT_FALSE(ratios_hold(100, 1e-4, 4, kWild));
  // A view keeps every third of 1,200; the first are the wild ones.
  EXPECT_TRUE(ratios_hold(1200, 1e-4, 9, kWild));
  EXPECT_FALSE(ratios_hold(1200, 1e-4, 10, kWild));
}

/// Points that a search brings may lack a way to them, a share of all.
TEST(Observations, WhatASearchMissesIsAllowedForBesides) {
  const auto hold = [](int odd) {
    Seen seen;
    seen.see_ratios(50, 1e-4, 0, 0);
    ExactOfView more{&seen.view(), {}};
    for (const Point2& p : even_points(50)) {
      const bool wild = static_cast<int>(more.points.size()) < odd;
      more.points.push_back({{&seen.view(), {}, {p[0], p[1], 0}, 1}, wild ? 3.0 : 1.0, 1e-4});
    }
    return Observations::of_density(seen.evidence)
        .with_points({more}, 0.1)
        .judge(as_stated)
        .admissible;
  };
  // A tenth of 100, and the three of which any may be wild.
  EXPECT_TRUE(hold(13));
  EXPECT_FALSE(hold(14));
}

TEST(Observations, APredictionHasToKnowEnoughOfThem) {
  const auto hold = [](int count, int known) {
    Seen seen;
    seen.see_ratios(count, 1e-4, 0, 0);
    int asked = 0;
    return seen.holds([&asked, known](const Place& p, std::span<const double>) {
      return asked++ < known ? p.base : kNothingSaid;
    });
  };
  EXPECT_TRUE(hold(90, 90));
  EXPECT_TRUE(hold(90, 50));
  EXPECT_FALSE(hold(90, 49));
  EXPECT_TRUE(hold(399, 60)) << "15 % of them";
  EXPECT_FALSE(hold(399, 59));
}

bool counts_hold(int count, double each, int odd, double errors_off) {
  Seen seen;
  seen.see_counts(count, each, odd, errors_off);
  return seen.holds();
}

/// z with P(Z > z) = 1e-4/2/100, from tables of the normal distribution.
constexpr double kOf100 = 4.8916;

TEST(Observations, CountsMayBeOffByWhatIsSeenInOneOfTenThousandReports) {
  EXPECT_TRUE(counts_hold(100, 400, 0, 0));
  EXPECT_TRUE(counts_hold(100, 400, 2, kOf100 - 0.01));
  EXPECT_FALSE(counts_hold(100, 400, 2, kOf100 + 0.01));
  EXPECT_FALSE(counts_hold(100, 400, 2, -kOf100 - 0.01));
  // One may be half as far off again, whose nodes missed what it holds.
  EXPECT_TRUE(counts_hold(100, 400, 1, 1.5 * kOf100 - 0.01));
  EXPECT_FALSE(counts_hold(100, 400, 1, 1.5 * kOf100 + 0.01));
}

/// Together they have the sum of squares of as many normal numbers: of 100, 161.3 once in 10,000.
TEST(Observations, CountsMayNotAllBeALittleOff) {
  EXPECT_TRUE(counts_hold(100, 400, 100, std::sqrt(1.61)));
  EXPECT_FALSE(counts_hold(100, 400, 100, std::sqrt(1.62)));
  // Of bins that hold fewer than four it is not asked.
  EXPECT_TRUE(counts_hold(100, 3.9, 100, std::sqrt(1.7)));
  EXPECT_FALSE(counts_hold(100, 4.1, 100, std::sqrt(1.7)));
}

/// Where 200 ratios tell what the density is, two bins may be odd by any amount, those that hold
/// more than twice as many as expected say nothing, nor those whose nodes differ much.
TEST(Observations, BesideManyRatiosAFewBinsMayBeOdd) {
  const auto hold = [](int ratios, int odd, double errors_off) {
    Seen seen;
    seen.see_ratios(ratios, 1e-4, 0, 0);
    seen.see_counts(100, 400, odd, errors_off);
    return seen.holds();
  };
  EXPECT_TRUE(hold(200, 2, -15));
  EXPECT_FALSE(hold(200, 3, -15));
  EXPECT_FALSE(hold(199, 2, -15));
  EXPECT_FALSE(hold(200, 3, 16)) << "less than twice as many";
  EXPECT_TRUE(hold(200, 50, 20)) << "more than twice as many";
  const auto hold_unevenly = [](double error_of_expected) {
    Seen seen;
    seen.see_ratios(200, 1e-4, 0, 0);
    seen.see_counts(100, 4e6, 5, 100);
    for (BinSeen& bin : seen.view().bins) bin.expected_error = error_of_expected * bin.expected;
    return seen.holds();
  };
  // Off by 5 %: of an expected count that is known to 1 % that is seen, of one to 4 % not asked.
  EXPECT_FALSE(hold_unevenly(0.01));
  EXPECT_TRUE(hold_unevenly(0.04));
}

/// A prediction that varies over a bin is added up by the shares of its mass and by its measures:
/// where the two differ, the nodes are too few for either.
TEST(Observations, MeasuresShowWhereNodesAreTooFew) {
  const auto hold = [](bool with_measures) {
    Seen seen;
    seen.see_counts(100, 400, 3, 8);
    // Of 40,000 samples 400 by the shares, but 600 by what the nodes stand for.
    if (with_measures) {
      for (BinSeen& bin : seen.view().bins) bin.measures = {0.0075, 0.0075};
    }
    return seen.holds([](const Place& p, std::span<const double>) {
      return p.base * (p.x[0] < p.x[1] ? 1.001 : 0.999);
    });
  };
  EXPECT_TRUE(hold(true));
  EXPECT_FALSE(hold(false));
}

TEST(Observations, StraysHaveToBeExplained) {
  const auto hold = [](int strays, int beyond) {
    Seen seen;
    seen.see_ratios(90, 1e-4, 0, 0);
    for (int i = 0; i < strays; ++i) seen.view().strays.push_back({i < beyond ? 2.0 : 0.5, 0, 0});
    return seen.holds([](const Place& p, std::span<const double>) { return p.x[0] < 1 ? 1 : 0; });
  };
  EXPECT_TRUE(hold(100, 2));
  EXPECT_FALSE(hold(100, 3));
}

TEST(Observations, MassesHaveToAddUp) {
  const auto hold = [](double atoms, double rejected, double rejected_error) {
    Seen seen;
    seen.see_counts(100, 400, 0, 0);
    seen.view().mass = MassSeen{1, 0, atoms, rejected, rejected_error};
    return seen.holds();
  };
  EXPECT_TRUE(hold(0, 0, 0));
  EXPECT_TRUE(hold(0, 0.9e-4, 0));
  EXPECT_FALSE(hold(0, 1.1e-4, 0));
  EXPECT_FALSE(hold(1.1e-4, 0, 0));
  EXPECT_TRUE(hold(0, 0.01, 0.01));
  EXPECT_FALSE(hold(0, 0.01, 0.0098));
  // Without the balance it is not asked.
  Seen seen;
  seen.see_counts(100, 400, 0, 0);
  seen.view().mass = MassSeen{1, 0, 0.5, 0, 0};
  EXPECT_TRUE(Observations::of_density(seen.evidence).without_mass().judge(as_stated).admissible);
}

TEST(Observations, UpsideDownTheOtherFunctionIsBlamed) {
  Seen seen;
  seen.see_ratios(90, 1e-6, 90, std::log(2) / 1e-6);
  const Observations observed = Observations::of_density(seen.evidence);
  const auto twice = [](const Place& p, std::span<const double>) { return 2 * p.base; };
  const auto half = [](const Place& p, std::span<const double>) { return p.base / 2; };
  EXPECT_TRUE(observed.judge(twice).admissible);
  EXPECT_FALSE(observed.judge(half).admissible);
  EXPECT_TRUE(observed.inverted().judge(half).admissible);
  EXPECT_FALSE(observed.inverted().judge(twice).admissible);
}

}  // namespace
}  // namespace plumbline::verify
