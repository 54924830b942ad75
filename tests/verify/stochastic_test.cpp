#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <plumbline/verify/gtest.h>
#include <plumbline/verify/stochastic.h>

#include "correct_pairs.h"
#include "layered_walk.h"
#include "textbook_glass.h"

namespace plumbline::verify {
namespace {

using tests::check_seed;
using tests::repeatable;

StochasticOptions seen_from(std::vector<double> angles, const std::string& subject) {
  StochasticOptions o;
  o.angles = std::move(angles);
  o.back = false;
  o.tolerance = 0.05;  // of a pass, which takes few walks then; what is to fail fails as surely
  o.seed = check_seed(subject);
  return o;
}

Report check_walk(LayeredWalk walk, StochasticOptions options) {
  return check_stochastic_bsdf(stochastic_bsdf<Vec3>("walk", walk), options);
}

/// What fails: the words after the last slash.
std::set<std::string> failing(const Report& report) {
  std::set<std::string> names;
  for (const CheckResult& r : report) {
    if (r.verdict == Verdict::fail) names.insert(r.subject.substr(r.subject.rfind('/') + 1));
  }
  return names;
}

Report check_fault(WalkFault fault, const std::string& name) {
  LayeredWalk walk;
  walk.fault = fault;
  return check_walk(walk, seen_from({60}, "stochastic/" + name));
}

TEST(Stochastic, AWalkThroughLayersPassesFromBothSides) {
  StochasticOptions o = seen_from({20, 70}, "stochastic/both sides");
  o.back = true;
  PLUMBLINE_EXPECT_PASS(repeatable(check_walk({}, o)));
}

TEST(Stochastic, NoMeanTakesMoreSamplesThanItMay) {
  StochasticOptions o = seen_from({60}, "stochastic/few samples");
  o.tolerance = 1e-6;       // beyond reach
  o.max_samples = 1 << 15;  // one look more than the first
  for (const CheckResult& r : check_walk({}, o)) {
    EXPECT_LE(r.samples, 2 * o.max_samples) << r.subject;  // two sides that should agree
  }
}

TEST(Stochastic, AWhiteWalkReflectsEverything) {
  LayeredWalk white;
  white.albedo = white.bottom = {1, 1};
  StochasticOptions o = seen_from({60}, "stochastic/white");
  o.albedo = [](const Vec3&) { return 1.0; };  // nothing is absorbed, and below is the bottom
  PLUMBLINE_EXPECT_PASS(repeatable(check_walk(white, o)));
}

TEST(Stochastic, ADeterministicBsdfPasses) {
  PLUMBLINE_EXPECT_PASS(repeatable(check_stochastic_bsdf(
      stochastic_bsdf("diffuse", erased(Diffuse{})), seen_from({0, 60}, "stochastic/diffuse"))));
  PLUMBLINE_EXPECT_PASS(
      repeatable(check_stochastic_bsdf(stochastic_bsdf("mirror", erased(RoughMirror{0.2})),
                                       seen_from({30}, "stochastic/rough mirror"))));
}

TEST(Stochastic, ANarrowLobePasses) {
  // Whose tails hold little, over most of the sphere: points that are even over a large cell there
  // would hardly ever come upon the corner that holds it.
  PLUMBLINE_EXPECT_PASS(
      repeatable(check_stochastic_bsdf(stochastic_bsdf("narrow", erased(RoughMirror{0.05})),
                                       seen_from({10, 75}, "stochastic/narrow"))));
}

TEST(Stochastic, WrongValuesOfEvalShow) {
  EXPECT_TRUE(failing(check_fault(WalkFault::no_pi, "no pi")).contains("eval"));
  const std::set<std::string> exit =
      failing(check_fault(WalkFault::no_exit_fresnel, "no exit fresnel"));
  EXPECT_TRUE(exit.contains("eval"));
  EXPECT_TRUE(exit.contains("reciprocity"));
  EXPECT_TRUE(failing(check_fault(WalkFault::short_eval, "short eval")).contains("eval"));
}

TEST(Stochastic, AnErrorThatIsTheSameFromEachDirectionShowsInReciprocity) {
  EXPECT_TRUE(failing(check_fault(WalkFault::one_way_fresnel, "one way")).contains("reciprocity"));
}

TEST(Stochastic, ReciprocityAcrossARefractionTakesTheIndexIntoAccount) {
  using Direction = tests::Vector<double>;
  const tests::TextbookGlass<double> glass{0.3, 1.5};
  const StochasticBsdf bsdf = stochastic_bsdf("glass", erase_bsdf<Direction, double>(glass));
  StochasticOptions o = seen_from({}, "stochastic/glass");
  o.back = true;
  o.eta = 1.5;
  PLUMBLINE_EXPECT_PASS(repeatable(check_stochastic_bsdf(bsdf, o)));
  o.eta = 1;
  EXPECT_EQ(failing(check_stochastic_bsdf(bsdf, o)), std::set<std::string>{"reciprocity"});
}

TEST(Stochastic, AWalkThatEndsTooEarlyEverywhereShowsInAKnownAlbedo) {
  LayeredWalk white;
  white.albedo = white.bottom = {1, 1};
  white.fault = WalkFault::short_walk;
  StochasticOptions o = seen_from({60}, "stochastic/short walk");
  o.reciprocal = false;  // fewer vertices are as reciprocal
  o.albedo = [](const Vec3&) { return 1.0; };
  EXPECT_EQ(failing(check_walk(white, o)), std::set<std::string>{"albedo"});
}

TEST(Stochastic, APdfOfAnotherLobeIsNoDensityButGivesRightWeights) {
  EXPECT_EQ(failing(check_fault(WalkFault::pdf_of_bottom, "other lobe")),
            std::set<std::string>{"pdf"});
  LayeredWalk walk;
  walk.fault = WalkFault::pdf_of_bottom;
  StochasticOptions o = seen_from({60}, "stochastic/approximate pdf");
  o.unbiased_pdf = false;
  PLUMBLINE_EXPECT_PASS(repeatable(check_walk(walk, o)));
}

TEST(Stochastic, AnEstimateOfThePdfIsNoDivisor) {
  const std::set<std::string> names =
      failing(check_fault(WalkFault::pdf_as_divisor, "pdf as divisor"));
  EXPECT_TRUE(names.contains("eval"));
  EXPECT_FALSE(names.contains("pdf"));
}

TEST(Stochastic, APdfThatComesWithTheSampleDoesNotFitThatOfPdf) {
  EXPECT_EQ(failing(check_fault(WalkFault::pdf_of_last_vertex, "last vertex")),
            std::set<std::string>{"mis"});
}

TEST(Stochastic, WeightsFromTheWalkOfTheValueAreBiased) {
  EXPECT_EQ(failing(check_fault(WalkFault::one_seed, "one seed")), std::set<std::string>{"mis"});
}

TEST(Stochastic, BlackFromEverySideIsInconclusive) {
  StochasticBsdf black = stochastic_bsdf("black", erased(Diffuse{}));
  StochasticOptions o = seen_from({45}, "stochastic/black");
  o.front = false;
  o.back = true;
  const Report report = check_stochastic_bsdf(black, o);
  EXPECT_EQ(report.verdict(), Verdict::inconclusive) << report.summary();
}

TEST(Stochastic, NegativePdfsFail) {
  StochasticBsdf bsdf = stochastic_bsdf("diffuse", erased(Diffuse{}));
  bsdf.pdf = [](const Vec3&, const Vec3&, Random&) { return -0.1; };
  EXPECT_EQ(failing(check_stochastic_bsdf(bsdf, seen_from({45}, "stochastic/negative"))),
            (std::set<std::string>{"pdf", "mis"}));
}

TEST(Stochastic, RefusesWhatMakesNoSense) {
  EXPECT_THROW(check_stochastic_bsdf(StochasticBsdf{}), std::invalid_argument);
  StochasticOptions o;
  o.angles = {90};
  EXPECT_THROW(check_stochastic_bsdf(stochastic_bsdf("d", erased(Diffuse{})), o),
               std::invalid_argument);
}

}  // namespace
}  // namespace plumbline::verify
