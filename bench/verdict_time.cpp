#include "verdict_time.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <plumbline/reports/table.h>
#include <plumbline/verify/bsdf.h>
#include "bsdf_layers.h"
#include "clock.h"
#include "publish.h"

namespace plumbline::bench {
namespace {

namespace corpus = tests::corpus;
using corpus::P3;
using Direction = corpus::V3<float>;
using Small = corpus::Conductor<float>;
using Production = corpus::Principled<float>;

struct Asked {
  verify::Vec3 wo;
  std::array<double, 3> a;  ///< numbers, or wi
};

/// Calls of one function under test, and every so many of what it was asked for.
struct Calls {
  static constexpr std::size_t kKeptEvery = 64;
  std::size_t count = 0;
  std::vector<Asked> kept;

  void see(const Asked& asked) {
    if (count++ % kKeptEvery == 0) kept.push_back(asked);
  }
};

struct AllCalls {
  Calls sample, pdf, eval;
};

/// The same function, which keeps count.
template <class R>
verify::Many<R(verify::Vec3, verify::Vec3)> counted(
    const verify::Many<R(verify::Vec3, verify::Vec3)>& function, Calls& calls) {
  return {[function, &calls](std::span<const verify::Vec3> wo, std::span<const verify::Vec3> a,
                             std::span<R> out) {
            for (std::size_t i = 0; i < a.size(); ++i) {
              calls.see({wo[i], a[i]});
            }
            function(wo, a, out);
          },
          function.batch()};
}

verify::ErasedBsdf counted(verify::ErasedBsdf bsdf, AllCalls& calls) {
  bsdf.sample = counted(bsdf.sample, calls.sample);
  bsdf.pdf = counted(bsdf.pdf, calls.pdf);
  bsdf.eval = counted(bsdf.eval, calls.eval);
  return bsdf;
}

/// Seconds that so many calls take by themselves: the least of three times over what was kept.
template <class F>
double own_seconds(const Calls& calls, const F& f) {
  if (calls.kept.empty()) return 0;
  double least = 1e30;
  for (int i = 0; i < 3; ++i) {
    least = std::min(least, seconds_of([&] {
                       for (const Asked& asked : calls.kept) f(asked);
                     }));
  }
  return least * static_cast<double>(calls.count) / static_cast<double>(calls.kept.size());
}

Direction direction(const std::array<double, 3>& v) { return verify::from_vec3<Direction>(v); }

P3<float> three(const std::array<double, 3>& u) {
  return {static_cast<float>(u[0]), static_cast<float>(u[1]), static_cast<float>(u[2])};
}

auto sample_of(const Small& b, const Asked& q) {
  return b.sample(direction(q.wo), static_cast<float>(q.a[0]), static_cast<float>(q.a[1]));
}

auto sample_of(const Production& b, const Asked& q) {
  return b.sample(direction(q.wo), three(q.a));
}

struct Run {
  double seconds = 0;
  verify::Report report;
};

/// Of correct code.
///
/// @throws std::runtime_error where it does not pass: the time would be that of a diagnosis too
template <class Check>
Run timed(const Check& check) {
  Run run;
  run.seconds = seconds_of([&] { run.report = check(); });
  if (!run.report.ok()) throw std::runtime_error("verdict-time: " + run.report.summary());
  return run;
}

/// What is measured in each round.
struct Subject {
  std::string name;
  double limit = 0;  ///< [s] beyond its own; 0: none
  std::function<Run()> run;
  std::function<double()> own;  ///< seconds of the code under test in one run

  std::size_t checks = 0;
  std::vector<double> seconds = {}, own_seconds = {};
  std::map<std::string, double> shares = {};  ///< [s] by kind of check
};

verify::BsdfOptions from_the_front() {
  verify::BsdfOptions options;
  options.back = false;
  return options;
}

template <class B>
double own_of(const B& bsdf, const AllCalls& calls) {
  const auto sample = [&](const Asked& q) { benchmark::DoNotOptimize(sample_of(bsdf, q)); };
  const auto pdf = [&](const Asked& q) {
    benchmark::DoNotOptimize(bsdf.pdf(direction(q.wo), direction(q.a)));
  };
  const auto eval = [&](const Asked& q) {
    benchmark::DoNotOptimize(bsdf.eval(direction(q.wo), direction(q.a)));
  };
  return own_seconds(calls.sample, sample) + own_seconds(calls.pdf, pdf) +
         own_seconds(calls.eval, eval);
}

template <class B>
Subject of_bsdf(const std::string& name, double limit, const B& bsdf,
                const verify::BsdfOptions& options) {
  const auto calls = std::make_shared<AllCalls>();
  verify::check_bsdf(name, counted(verify::erase_bsdf(bsdf, options.conventions), *calls), options);
  return {name, limit,
          [=] { return timed([&] { return verify::check_bsdf(name, bsdf, options); }); },
          [=] { return own_of(bsdf, *calls); }};
}

/// Of a BSDF whose pdf lacks 1/(4 wo·h), until the first check that fails.
Subject gross_fault() {
  const auto run = [] {
    const Small bsdf{{0.2F, 0.2F, true}, corpus::Normals::disk, false, 0.9F, 10};
    std::optional<double> first;
    verify::BsdfOptions options = from_the_front();
    const double start = thread_seconds();
    options.contract.decided = [&](const verify::CheckResult& r) {
      if (!first && r.verdict == verify::Verdict::fail) first = thread_seconds() - start;
    };
    Run all;
    all.report = verify::check_bsdf("fault", bsdf, options);
    all.seconds = first.value_or(thread_seconds() - start);
    return all;
  };
  return {"gross fault, first verdict", 0.1, run, [] { return 0.0; }};
}

/// Cosine-weighted directions around a normal: a light's or a warp's pair.
verify::SamplingPair cosine_pair() {
  return verify::sampling_pair<Direction>(
      "cosine", verify::Domain::sphere(),
      [](float u, float v) { return corpus::cosine_hemisphere(u, v); },
      [](const Direction& w) { return w.z > 0 ? w.z / corpus::pi_v<float> : 0.0F; });
}

/// Uniform in a cone of 30° around z.
verify::SamplingPair cone_pair() {
  constexpr float kCosine = 0.8660254F, kHeight = 1 - kCosine;
  return verify::sampling_pair<Direction>(
      "cone", verify::Domain::sphere(),
      [](float u, float v) {
        return corpus::spherical(1 - u * kHeight, 2 * corpus::pi_v<float> * v);
      },
      [](const Direction& w) {
        return w.z >= kCosine ? 1 / (2 * corpus::pi_v<float> * kHeight) : 0.0F;
      });
}

struct PairCalls {
  Calls sample, pdf;
};

template <class R>
verify::Many<R(verify::Vec3)> counted(const verify::Many<R(verify::Vec3)>& function, Calls& calls) {
  return {[function, &calls](std::span<const verify::Vec3> a, std::span<R> out) {
            for (const verify::Vec3& x : a) calls.see({{}, x});
            function(a, out);
          },
          function.batch()};
}

/// @param check  of a pair, to a Report
template <class Check>
Subject of_check(const std::string& name, double limit, const verify::SamplingPair& pair,
                 const Check& check) {
  const auto calls = std::make_shared<PairCalls>();
  verify::SamplingPair counting = pair;
  counting.sample = counted(pair.sample, calls->sample);
  counting.pdf = counted(pair.pdf, calls->pdf);
  check(counting);
  return {name, limit, [=] { return timed([&] { return check(pair); }); },
          [=] {
            const auto sample = [&](const Asked& q) { benchmark::DoNotOptimize(pair.sample(q.a)); };
            const auto pdf = [&](const Asked& q) { benchmark::DoNotOptimize(pair.pdf(q.a)); };
            return own_seconds(calls->sample, sample) + own_seconds(calls->pdf, pdf);
          }};
}

Subject of_pair(const std::string& name, const verify::SamplingPair& pair) {
  return of_check(name, 0.3, pair,
                  [](const verify::SamplingPair& p) { return verify::check_pair(p); });
}

/// All samples in one look.
Subject of_chi_square(std::uint64_t samples) {
  verify::ContractOptions options;
  options.first_look = options.samples = samples;
  options.deviation = 0.05;  // that the fewest prove
  return of_check(fmt::format("chi-square, {} samples", samples), 0, cosine_pair(),
                  [options](const verify::SamplingPair& pair) {
                    return verify::Report(std::vector{verify::check_chi_square(pair, options)});
                  });
}

void add_round(Subject& subject) {
  const Run run = subject.run();
  subject.seconds.push_back(run.seconds);
  subject.own_seconds.push_back(subject.own());
  subject.checks = run.report.results.size();
  for (const verify::CheckResult& r : run.report) {
    subject.shares[std::string(to_string(r.kind))] += r.seconds;
  }
}

double least(const std::vector<double>& values) {
  return *std::min_element(values.begin(), values.end());
}

std::string shares_of(const Subject& subject) {
  double sum = 0;
  for (const auto& [kind, seconds] : subject.shares) sum += seconds;
  std::string text;
  for (const auto& [kind, seconds] : subject.shares) {
    if (seconds < 0.01 * sum) continue;
    text += fmt::format("{}{} {:.0f} %", text.empty() ? "" : ", ", kind, 100 * seconds / sum);
  }
  return text;
}

void publish_bar(reports::ResultLog& log, const std::string& name, double limit,
                 std::vector<double> beyond) {
  std::sort(beyond.begin(), beyond.end());
  publish(log, reports::Bar{name, "s", false, limit, beyond.front(), beyond.front(), beyond.back(),
                            false, "",
                            fmt::format("CPU time beyond that of the code under test, least and "
                                        "most of {} rounds in turns",
                                        beyond.size())});
}

std::vector<double> beyond_own(const Subject& subject) {
  std::vector<double> beyond;
  for (std::size_t i = 0; i < subject.seconds.size(); ++i) {
    beyond.push_back(subject.seconds[i] - subject.own_seconds[i]);
  }
  return beyond;
}

}  // namespace

void measure_verdict_time(reports::ResultLog& log, bool full) {
  verify::BsdfOptions production = from_the_front();
  production.eta = 1.45;
  std::vector<Subject> subjects{
      of_bsdf("small BSDF", 0.8, Small{{0.2F, 0.2F, true}, corpus::Normals::disk, false, 0.9F, 0},
              from_the_front()),
      of_bsdf("production BSDF", 5, Production{}, production),
      of_pair("light", cone_pair()),
      of_pair("warp", cosine_pair()),
      gross_fault(),
      of_chi_square(100'000),
      of_chi_square(1'100'000)};
  const int rounds = full ? 9 : 3;
  for (int i = 0; i < rounds; ++i) {
    for (Subject& subject : subjects) add_round(subject);
  }
  reports::Table table;
  table.group = "Time to a verdict";
  table.title = "CPU seconds of a battery";
  table.caption = fmt::format(
      "With the users' options, on one thread; the least of {} rounds in turns. Own: the calls of "
      "the code under test by themselves.",
      rounds);
  table.columns = {"subject", "checks", "time [s]", "own [s]", "beyond [s]", "shares"};
  for (const Subject& s : subjects) {
    table.rows.push_back({s.name, std::to_string(s.checks), fmt::format("{:.3f}", least(s.seconds)),
                          fmt::format("{:.3f}", least(s.own_seconds)),
                          fmt::format("{:.3f}", least(beyond_own(s))), shares_of(s)});
    keep(log, "verdict_time/" + s.name, "s", s.seconds);
    if (s.limit > 0) publish_bar(log, "Verdict, " + s.name, s.limit, beyond_own(s));
  }
  const std::vector<double> few = beyond_own(subjects[5]), many = beyond_own(subjects[6]);
  std::vector<double> million;
  for (std::size_t i = 0; i < many.size(); ++i) million.push_back(many[i] - few[i]);
  publish_bar(log, "Verdict, a million chi-square samples", 0.1, million);
  publish(log, table);
}

}  // namespace plumbline::bench
