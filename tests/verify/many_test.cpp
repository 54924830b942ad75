#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include <plumbline/verify/bsdf.h>
#include <plumbline/verify/detail/many.h>

#include "correct_pairs.h"

namespace plumbline::verify {
namespace {

using Sum = Many<double(double, int)>;

TEST(Many, AnswersOneByOneAndInSpansWhicheverWayItIsWritten) {
  const auto one = [](double a, int b) { return a + b; };
  const auto spans = [](std::span<const double> a, std::span<const int> b, std::span<double> out) {
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = a[i] + b[i];
  };
  const std::array<double, 3> a{0.5, 1.5, 2.5};
  const std::array<int, 3> b{1, 2, 3};
  for (const Sum& sum : {Sum(one), Sum(spans)}) {
    EXPECT_EQ(sum(a[1], b[1]), 3.5);
    std::array<double, 3> out{};
    sum(a, b, out);
    EXPECT_EQ(out, (std::array<double, 3>{1.5, 3.5, 5.5}));
  }
  EXPECT_GT(Sum(spans).batch(), Sum(one).batch());
}

TEST(Many, SaysWhetherItIsThere) {
  EXPECT_FALSE(Sum());
  EXPECT_FALSE(Sum(std::function<double(double, int)>()));
  EXPECT_TRUE(Sum([](double a, int) { return a; }));
  EXPECT_THROW(Sum()(0.0, 1), std::bad_function_call);
}

TEST(Many, RefusesSpansOfDifferentSizes) {
  const Sum sum = [](double a, int b) { return a + b; };
  const std::array<double, 2> a{};
  const std::array<int, 3> b{};
  std::array<double, 3> out{};
  EXPECT_THROW(sum(a, b, out), std::invalid_argument);
}

/// How often code is called, and for how many values.
struct Asked {
  std::size_t calls = 0, values = 0;
};

/// The same function, in spans only.
template <class R, class... A>
Many<R(A...)> in_spans(const Many<R(A...)>& function, Asked& asked) {
  return [function, &asked](std::span<const A>... a, std::span<R> out) {
    ++asked.calls;
    asked.values += out.size();
    function(a..., out);
  };
}

ErasedBsdf in_spans(ErasedBsdf bsdf, Asked& asked) {
  bsdf.sample = in_spans(bsdf.sample, asked);
  bsdf.pdf = in_spans(bsdf.pdf, asked);
  bsdf.eval = in_spans(bsdf.eval, asked);
  return bsdf;
}

void expect_same(const Report& a, const Report& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    CheckResult first = a.results[i], second = b.results[i];
    first.seconds = second.seconds = 0;
    EXPECT_EQ(describe(first), describe(second));
  }
  EXPECT_EQ(a.cause, b.cause);
}

BsdfOptions few_directions() {
  BsdfOptions options;
  options.angles = {60};
  options.random_directions = 0;
  options.back = false;
  options.contract.finest_bins = 256;
  return options;
}

TEST(Batches, AskForManyValuesAtOnce) {
  Asked asked;
  const Report report =
      check_bsdf("mirror", in_spans(erased(RoughMirror{0.3}), asked), few_directions());
  EXPECT_TRUE(report.ok()) << report.summary();
  EXPECT_LT(asked.calls, asked.values / 100);
}

/// No factor that is known explains it: a diagnosis tries all that it has.
ErasedBsdf faulty_mirror() {
  ErasedBsdf bsdf = erased(RoughMirror{0.3});
  bsdf.pdf = [right = bsdf.pdf](const Vec3& wo, const Vec3& wi) {
    return right(wo, wi) * (0.7 + 0.3 * wi[2]);
  };
  return bsdf;
}

TEST(Batches, ADiagnosisAsksForManyValuesAtOnce) {
  Asked asked;
  const Report report = check_bsdf("mirror", in_spans(faulty_mirror(), asked), few_directions());
  EXPECT_FALSE(report.ok());
  EXPECT_LT(asked.calls, asked.values / 50);
}

TEST(Batches, GiveTheReportThatOneByOneGives) {
  BsdfConventions conventions;
  conventions.frame = BsdfConventions::Frame::local_y_up;
  conventions.given_points_in = true;
  conventions.cosine_in_eval = true;
  conventions.projected_pdf = true;
  conventions.weight = BsdfConventions::Weight::f;
  for (const BsdfConventions& c : {BsdfConventions{}, conventions}) {
    const ErasedBsdf mirror = erased(RoughMirror{0.3});
    Asked asked;
    expect_same(
        check_bsdf("mirror", apply_conventions(mirror, c), few_directions()),
        check_bsdf("mirror", apply_conventions(in_spans(mirror, asked), c), few_directions()));
  }
}

}  // namespace
}  // namespace plumbline::verify
