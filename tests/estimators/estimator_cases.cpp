#include "estimator_cases.h"

#include <memory>
#include <span>
#include <utility>

#include <plumbline/renderer/estimators/optimal_weights.h>
#include <plumbline_tests/support.h>

#include "integral_problem.h"

namespace plumbline::tests {
namespace {

using analytic::Integral1d;
using analytic::WeightRule;
using renderer::Heuristic;
using renderer::Weighting;

using Problem = IntegralProblem<double>;
using Numbers = std::vector<double>;

/// A heuristic as the renderer and as the oracle know it.
struct Rule {
  std::string name;
  Weighting weighting;
  WeightRule oracle;
};

std::vector<Rule> rules() {
  return {{"balance", Heuristic::balance, {WeightRule::Kind::balance, 0}},
          {"power 2", Heuristic::power, {WeightRule::Kind::power, 2}},
          {"power 1.3", {Heuristic::power, 1.3}, {WeightRule::Kind::power, 1.3}},
          {"cutoff 0.1", Heuristic::cutoff, {WeightRule::Kind::cutoff, 0.1}},
          {"maximum", Heuristic::maximum, {WeightRule::Kind::maximum, 0}}};
}

std::string listed(const std::vector<int>& counts) {
  std::string text;
  for (const int n : counts) text.append(" ").append(std::to_string(n));
  return text;
}

int total(const std::vector<int>& counts) {
  int sum = 0;
  for (const int n : counts) sum += n;
  return sum;
}

/// Collects the cases of one integral; each draw owns what it needs but the integral itself.
class Cases {
 public:
  explicit Cases(const Integral1d& integral) : integral_(integral), problem_(integral) {}

  void add(std::string strategy, const analytic::Moments& exact, double samples,
           std::function<double(const Problem&, Uniform<double>&)> draw) {
    EstimatorCase c;
    c.integral = integral_.name;
    c.strategy = std::move(strategy);
    c.value = integral_.value;
    c.exact = exact;
    c.samples = samples;
    c.draw = [problem = problem_, draw = std::move(draw)](verify::Random& random) {
      Uniform<double> uniform(random);
      return draw(problem, uniform);
    };
    cases_.push_back(std::move(c));
  }

  /// Shows the case added last in the figure of errors.
  void feature(std::string short_name) { cases_.back().featured = std::move(short_name); }

  void add_multi_sample(const Rule& rule, const std::vector<int>& counts) {
    add("multi-sample " + rule.name + ", counts" + listed(counts),
        multi_sample_moments(integral_, rule.oracle, counts), total(counts),
        [rule, n = Numbers(counts.begin(), counts.end())](const Problem& p, Uniform<double>& u) {
          return renderer::multi_sample(p, rule.weighting, std::span<const double>(n), u);
        });
  }

  void add_one_sample(const Rule& rule, const std::string& name, const Numbers& selection) {
    add("one-sample " + rule.name + ", " + name,
        one_sample_moments(integral_, rule.oracle, selection), 1,
        [rule, selection](const Problem& p, Uniform<double>& u) {
          return renderer::one_sample(p, rule.weighting, std::span<const double>(selection), u);
        });
  }

  void add_optimal(const std::string& name, const std::vector<int>& counts, const Numbers& alpha) {
    add("optimal weights, " + name + ", counts" + listed(counts),
        control_variate_moments(integral_, counts, alpha), total(counts),
        [n = Numbers(counts.begin(), counts.end()), alpha](const Problem& p, Uniform<double>& u) {
          return renderer::optimal(p, std::span<const double>(n), std::span<const double>(alpha),
                                   u);
        });
  }

  std::vector<EstimatorCase> take() { return std::move(cases_); }

 private:
  const Integral1d& integral_;
  Problem problem_;
  std::vector<EstimatorCase> cases_;
};

Numbers solved(const renderer::OptimalSystem<double>& system, std::size_t size) {
  const auto alpha = system.solve();
  return Numbers(alpha.begin(), alpha.begin() + static_cast<std::ptrdiff_t>(size));
}

/// α from 200 rounds of samples that no estimate uses again.
Numbers sampled_alpha(const Integral1d& integral, const std::vector<int>& counts) {
  renderer::OptimalSystem<double> system(counts.size());
  verify::Random random(check_seed(integral.name + "/optimal system"));
  Uniform<double> uniform(random);
  const Numbers n(counts.begin(), counts.end());
  for (int round = 0; round < 200; ++round) {
    system.add_samples(Problem(integral), std::span<const double>(n), uniform);
  }
  return solved(system, counts.size());
}

}  // namespace

std::vector<double> optimal_alpha(const Integral1d& integral, const std::vector<int>& counts) {
  const analytic::OptimalSystem exact = optimal_system(integral, counts);
  renderer::OptimalSystem<double> system(counts.size());
  for (std::size_t i = 0; i < counts.size(); ++i) {
    system.vector(i) = exact.vector[i];
    for (std::size_t k = 0; k < counts.size(); ++k) system.matrix(i, k) = exact.matrix[i][k];
  }
  return solved(system, counts.size());
}

std::vector<EstimatorCase> estimator_cases(const Integral1d& integral) {
  const std::size_t count = integral.densities.size();
  const auto m = static_cast<double>(count);
  Cases cases(integral);
  for (std::size_t i = 0; i < count; ++i) {
    const std::string number = std::to_string(i + 1);
    cases.add("technique " + number + " alone", single_moments(integral, i), 1,
              [i](const Problem& p, Uniform<double>& u) { return renderer::single(p, i, u); });
    cases.feature(std::string("p").append(number).append(" alone"));
  }
  cases.add("naive average", naive_average_moments(integral), m,
            [](const Problem& p, Uniform<double>& u) { return renderer::naive_average(p, u); });
  cases.feature("naive average");
  cases.add("plain sum", plain_sum_moments(integral), m,
            [](const Problem& p, Uniform<double>& u) { return renderer::plain_sum(p, u); });

  const std::vector<int> ones(count, 1);
  std::vector<int> uneven;
  for (std::size_t i = 0; i < count; ++i) uneven.push_back(i == 0 ? 3 : static_cast<int>(i));
  for (const Rule& rule : rules()) {
    cases.add_multi_sample(rule, ones);
    if (rule.name == "balance" || rule.name == "power 2") cases.feature(rule.name);
    cases.add_multi_sample(rule, uneven);
  }

  const Numbers equal(count, 1 / m);
  Numbers skewed;
  for (const int n : uneven) skewed.push_back(n / static_cast<double>(total(uneven)));
  cases.add_one_sample(rules()[0], "equal chances", equal);
  cases.feature("one-sample balance");
  cases.add_one_sample(rules()[1], "equal chances", equal);
  cases.add_one_sample(rules()[0], "unequal chances", skewed);
  cases.add_one_sample(rules()[4], "unequal chances", skewed);
  cases.add("coin flip", mixture_moments(integral, equal), 1,
            [](const Problem& p, Uniform<double>& u) { return renderer::coin_flip(p, u); });
  // The mean of f/p̄ over fixed counts is the balance heuristic with these counts, written
  // differently.
  cases.add("deterministic mixture, counts" + listed(uneven),
            multi_sample_moments(integral, {WeightRule::Kind::balance, 0}, uneven), total(uneven),
            [n = Numbers(uneven.begin(), uneven.end())](const Problem& p, Uniform<double>& u) {
              return renderer::deterministic_mixture(p, std::span<const double>(n), u);
            });
  cases.add_optimal("by quadrature", ones, optimal_alpha(integral, ones));
  cases.feature("optimal weights");
  cases.add_optimal("by quadrature", uneven, optimal_alpha(integral, uneven));
  cases.add_optimal("from other samples", ones, sampled_alpha(integral, ones));
  return cases.take();
}

verify::MomentSampler moment_sampler(const EstimatorCase& c, std::uint64_t seed,
                                     std::function<double(double)> transform) {
  return [&c, transform = std::move(transform), random = verify::Random(seed)](
             std::uint64_t, std::uint64_t count) mutable {
    verify::Moments moments;
    for (std::uint64_t k = 0; k < count; ++k) moments.add(transform(c.draw(random)));
    return moments;
  };
}

}  // namespace plumbline::tests
