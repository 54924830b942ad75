#include <gtest/gtest.h>

#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include <plumbline/verify/bsdf.h>

#include "correct_pairs.h"
#include "progress.h"

/// What a person who waits gets to see, and looking from several directions at the same time.
namespace plumbline::verify {
namespace {

/// Three directions, little of everything.
BsdfOptions glance() {
  BsdfOptions o;
  o.angles = {20, 60};
  o.random_directions = 1;
  o.back = false;
  o.contract.points = 200;
  o.contract.jacobian_points = 100;
  o.contract.evaluations = 20'000;
  o.contract.first_look = o.contract.samples = 20'000;
  o.contract.finest_bins = 64;
  o.contract.deviation = 0.3;
  o.contract.mass_tolerance = 5e-3;
  return o;
}

bool needs_statistics(const CheckResult& r) {
  return r.kind == CheckKind::integral || r.kind == CheckKind::chi_square ||
         r.kind == CheckKind::energy;
}

TEST(Decided, IsFirstWhatNeedsNoStatisticsOfAllDirections) {
  std::vector<CheckResult> decided;
  BsdfOptions options = glance();
  options.contract.decided = [&](const CheckResult& r) { decided.push_back(r); };
  const Report report = check_bsdf("diffuse", erased(Diffuse()), options);
  EXPECT_TRUE(report.ok()) << report.summary();
  ASSERT_EQ(decided.size(), report.results.size());
  bool statistics = false;
  for (const CheckResult& r : decided) {
    EXPECT_FALSE(statistics && !needs_statistics(r)) << r.subject;
    statistics = statistics || needs_statistics(r);
    const CheckResult* same = nullptr;
    for (const CheckResult& reported : report) {
      if (reported.subject == r.subject) same = &reported;
    }
    ASSERT_NE(same, nullptr) << r.subject;
    EXPECT_EQ(same->verdict, r.verdict) << r.subject;
  }
}

/// The density of the samples is twice what pdf says.
struct HalfThePdf : Diffuse {
  static double pdf(const Vec3& wo, const Vec3& wi) { return Diffuse::pdf(wo, wi) / 2; }
};

TEST(Decided, AGrossFaultIsAmongTheFirst) {
  std::vector<CheckResult> decided;
  BsdfOptions options = glance();
  options.contract.decided = [&](const CheckResult& r) { decided.push_back(r); };
  EXPECT_FALSE(check_bsdf("half", erased(HalfThePdf()), options).ok());
  std::size_t first = 0;
  while (first < decided.size() && decided[first].verdict != Verdict::fail) ++first;
  // The points of the first direction: record, weight, support, finite, Jacobian.
  EXPECT_LT(first, 5U);
}

TEST(Decided, APairTellsToo) {
  std::vector<std::string> decided;
  ContractOptions options = glance().contract;
  options.decided = [&](const CheckResult& r) { decided.push_back(r.subject); };
  SamplingPair pair;
  pair.name = "even";
  pair.domain = Domain::unit_square();
  pair.sample = [](const Uniforms& u) -> std::optional<SampleRecord> { return SampleRecord{u}; };
  pair.pdf = [](const Vec3&) { return 1.0; };
  const Report report = check_pair(pair, options);
  std::vector<std::string> reported;
  for (const CheckResult& r : report) reported.push_back(r.subject);
  EXPECT_EQ(decided, reported);
}

void expect_same(const Report& one, const Report& other) {
  ASSERT_EQ(one.results.size(), other.results.size());
  for (std::size_t i = 0; i < one.results.size(); ++i) {
    const CheckResult &a = one.results[i], &b = other.results[i];
    EXPECT_EQ(a.subject, b.subject);
    EXPECT_EQ(a.verdict, b.verdict);
    EXPECT_EQ(a.estimate, b.estimate);
    EXPECT_EQ(a.bound, b.bound);
    EXPECT_EQ(a.p_value, b.p_value);
    EXPECT_EQ(a.figures, b.figures);
    EXPECT_EQ(a.reason, b.reason);
  }
  EXPECT_EQ(one.cause, other.cause);
}

TEST(Threads, GiveTheSameReportAsOne) {
  BsdfOptions one = glance(), three = one;
  three.contract.threads = 3;
  expect_same(check_bsdf("mirror", erased(RoughMirror{0.4}), one),
              check_bsdf("mirror", erased(RoughMirror{0.4}), three));
  expect_same(check_bsdf("half", erased(HalfThePdf()), one),
              check_bsdf("half", erased(HalfThePdf()), three));
}

/// Once in a while the answer depends on what was asked before.
struct Remembering : Diffuse {
  std::shared_ptr<int> asked = std::make_shared<int>(0);

  double eval(const Vec3& wo, const Vec3& wi) const {
    return Diffuse::eval(wo, wi) * (++*asked % 10 == 0 ? 1 + 1e-15 : 1);
  }
};

/// Its samples take their numbers from a generator that it keeps.
struct OwnNumbers : Diffuse {
  std::shared_ptr<std::mt19937> numbers = std::make_shared<std::mt19937>(1);

  std::optional<SampleRecord> sample(const Vec3& wo, double u, double) const {
    return Diffuse::sample(wo, u, std::generate_canonical<double, 53>(*numbers));
  }
};

TEST(Threads, AreRefusedToCodeThatKeepsAState) {
  BsdfOptions options = glance();
  options.contract.threads = 2;
  EXPECT_THROW(check_bsdf("remembering", erased(Remembering()), options), std::invalid_argument);
  EXPECT_THROW(check_bsdf("own numbers", erased(OwnNumbers()), options), std::invalid_argument);
}

struct Throwing : Diffuse {
  std::shared_ptr<std::mutex> mutex = std::make_shared<std::mutex>();
  std::shared_ptr<int> asked = std::make_shared<int>(0);

  double pdf(const Vec3& wo, const Vec3& wi) const {
    const std::lock_guard lock(*mutex);
    if (++*asked > 20'000) throw std::domain_error("enough");
    return Diffuse::pdf(wo, wi);
  }
};

TEST(Threads, HandOnWhatTheCodeThrows) {
  BsdfOptions options = glance();
  options.contract.threads = 2;
  EXPECT_THROW(check_bsdf("throwing", erased(Throwing()), options), std::domain_error);
}

TEST(Progress, SaysWhatIsDecidedAndWhatRuns) {
  Standing standing{"ggx", 12, 0, "", "ggx/front 60°: chi-square"};
  EXPECT_EQ(line_of(standing, 100), "ggx: 12 decided; ggx/front 60°: chi-square");
  standing.unexpected = 2;
  standing.first_unexpected = "ggx/front 0°/jacobian";
  EXPECT_EQ(line_of(standing, 100),
            "ggx: 12 decided, 2 not as expected (ggx/front 0°/jacobian); ggx/front 60°: "
            "chi-square");
}

TEST(Progress, CutsNoCharacterInTwo) {
  const Standing standing{"°°°", 0, 0, "", ""};
  EXPECT_EQ(line_of(standing, 2), "°°");
  EXPECT_EQ(line_of(standing, 14), "°°°: 0 decided");
  EXPECT_EQ(line_of(standing, 13), "°°°: 0 decide");
}

}  // namespace
}  // namespace plumbline::verify
