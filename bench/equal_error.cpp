#include "equal_error.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <ctime>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <plumbline/renderer/assembly/description.h>
#include <plumbline/renderer/assembly/render.h>
#include "peer.h"
#include "publish.h"
#include "scenes.h"
#include "statistics.h"

namespace plumbline::bench {
namespace {

using renderer::Scene;

/// Another renderer's figures at another time, in one run with ours of then: CPU seconds of one
/// thread, 64 samples per pixel.
struct Quoted {
  const char *sampler, *product, *ratio, *parts;
};

/// A scene of the comparison, at its full resolution, and pbrt-v4's `path` integrator on it, the
/// best of its samplers first.
struct Comparison {
  const char *scene, *title;
  int width, height;
  double bar;  ///< relMSE × s by the wall clock, two threads of a machine like ours
  std::array<Quoted, 3> pbrt;
};

constexpr Comparison kComparisons[] = {
    {"veach",
     "Veach's plates",
     512,
     384,
     0.0025,
     {{{"paddedsobol", "0.0341", "12.1 [11.6, 13.1]", "9.5 × 1.28"},
       {"zsobol", "0.0443", "15.9 [14.1, 16.9]", "11.7 × 1.35"},
       {"independent", "0.140", "50", "8.4 × 5.9"}}}},
    {"cornell",
     "Cornell box",
     256,
     256,
     0.0065,
     {{{"paddedsobol", "0.119", "13.3 [12.7, 13.7]", "7.6 × 1.76"},
       {"independent", "0.131", "14.9 [14.5, 15.4]", "6.3 × 2.34"},
       {"zsobol", "0.147", "16.7 [16.2, 17.5]", "9.6 × 1.73"}}}}};

constexpr std::uint32_t kComparedSamples = 64;
constexpr int kThreads = 2;
constexpr int kReplicates = 16;
constexpr std::uint32_t kReferenceSamples = 4 * kComparedSamples;  // in each of two halves

renderer::RenderOptions options_for(const renderer::PathOptions& path, std::uint32_t samples,
                                    std::uint64_t seed) {
  renderer::RenderOptions options;
  options.path = path;
  options.samples_per_pixel = samples;
  options.seed = seed;
  options.sampler = renderer::SamplerType::sobol;
  options.threads = kThreads;
  return options;
}

struct ConvergedImage {
  std::vector<double> image;
  double rel_mse = 0;  ///< of itself, from the difference of its halves
};

/// Two renders with seeds that no replicate has; (a − b)²/4 is an unbiased estimate of the squared
/// error of their mean.
ConvergedImage render_reference(const Scene& scene, const renderer::PathOptions& path) {
  ConvergedImage reference;
  reference.image = luminances(render(scene, options_for(path, kReferenceSamples, 1001)).film);
  std::vector<double> off =
      luminances(render(scene, options_for(path, kReferenceSamples, 1002)).film);
  for (std::size_t i = 0; i < off.size(); ++i) {
    const double half_difference = (off[i] - reference.image[i]) / 2;
    reference.image[i] += half_difference;
    off[i] = reference.image[i] + half_difference;
  }
  reference.rel_mse = rel_mse(off, reference.image);
  return reference;
}

/// A comparison under way.
struct Subject {
  Subject(const Comparison& of, bool full)
      : comparison(of),
        shrink(full ? 1 : 4),
        description(load_at_size(of.scene, of.width / shrink, of.height / shrink)),
        scene(make_scene(description)),
        path{.max_depth = description.integrator.max_depth,
             .rr_depth = description.integrator.rr_depth},
        reference(render_reference(scene, path)) {}

  /// Times of as many pixels as the scene has at its full resolution.
  double scaled(double seconds) const { return seconds * shrink * shrink; }

  std::string name() const {
    return fmt::format("equal_error/{}{}", comparison.scene, shrink == 1 ? "" : ", small");
  }

  const Comparison& comparison;
  int shrink;
  renderer::SceneDescription description;
  Scene scene;
  renderer::PathOptions path;
  ConvergedImage reference;
};

std::uint64_t seed_of(int replicate) { return static_cast<std::uint64_t>(replicate) + 1; }

/// By the wall clock, against the bar.
void measure_bar(const Subject& subject, reports::ResultLog& log) {
  std::vector<double> errors, times;
  for (int i = 0; i < kReplicates; ++i) {
    const renderer::RenderResult result =
        render(subject.scene, options_for(subject.path, kComparedSamples, seed_of(i)));
    errors.push_back(rel_mse(luminances(result.film), subject.reference.image) -
                     subject.reference.rel_mse);
    times.push_back(subject.scaled(result.seconds));
  }
  const Estimate error = mean_with_interval(errors);
  std::vector<double> costs;
  for (const double seconds : times) costs.push_back(error.value * seconds);
  keep(log, subject.name(), "relMSE × s", std::move(costs));
  const Estimate time = median_with_interval(std::move(times));

  reports::Bar bar;
  bar.name = fmt::format("Equal error, {}", subject.comparison.title);
  bar.unit = "relMSE × s";
  bar.limit = subject.comparison.bar;
  bar.measured = error.value * time.value;
  bar.low = error.low * time.low;
  bar.high = error.high * time.high;
  bar.indicative = subject.shrink != 1;
  bar.note = fmt::format(
      "{}×{}, {} samples per pixel, {} threads{}: relMSE {:.3g} [{:.3g}, {:.3g}] (mean of {} "
      "renders), {:.3g} s [{:.3g}, {:.3g}] (median); the reference's own relMSE, {:.2g}, is "
      "subtracted",
      subject.description.camera.width, subject.description.camera.height, kComparedSamples,
      kThreads,
      subject.shrink == 1 ? "" : fmt::format(", time × {}", subject.shrink * subject.shrink),
      error.value, error.low, error.high, kReplicates, time.value, time.low, time.high,
      subject.reference.rel_mse);
  publish(log, bar);
}

/// CPU time of this process [s].
double process_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Pictures of one way to render, by one thread.
struct Contestant {
  std::string name;
  std::function<PeerPicture(std::uint32_t samples, std::uint64_t seed)> render;
  bool is_ours = true;
  std::vector<std::vector<double>> images = {};
  std::vector<double> cpu_seconds = {};
  double start_seconds = 0;  ///< of a command: what a picture of one sample takes
  std::string failure = {};
};

Contestant ours(const Subject& subject, bool adaptive) {
  const auto render_it = [&subject, adaptive](std::uint32_t samples, std::uint64_t seed) {
    renderer::RenderOptions options = options_for(subject.path, samples, seed);
    options.threads = 1;
    options.adaptive = adaptive;
    const double start = process_seconds();
    const renderer::RenderResult result = render(subject.scene, options);
    return PeerPicture{luminances(result.film), process_seconds() - start, result.seconds};
  };
  return {adaptive ? "ours, --adaptive" : "ours", render_it};
}

Contestant peer(const Subject& subject, const Peer& peer) {
  const auto render_it = [&](std::uint32_t samples, std::uint64_t seed) {
    return peer.render({scene_path(subject.comparison.scene), subject.description.camera.width,
                        subject.description.camera.height, samples, seed, 1});
  };
  return {peer.command(), render_it, false};
}

/// All in turn, so that the machine is the same for all.
void run(std::vector<Contestant>& contestants) {
  for (int i = 0; i < kReplicates; ++i) {
    for (Contestant& contestant : contestants) {
      if (!contestant.failure.empty()) continue;
      try {
        if (!contestant.is_ours && i == 0) {
          contestant.start_seconds = contestant.render(1, seed_of(0)).cpu_seconds;
        }
        PeerPicture picture = contestant.render(kComparedSamples, seed_of(i));
        contestant.images.push_back(std::move(picture.luminance));
        contestant.cpu_seconds.push_back(picture.cpu_seconds);
      } catch (const std::exception& error) {
        if (contestant.is_ours) throw;
        contestant.failure = error.what();
      }
    }
  }
}

/// relMSE of each picture about the mean of all: without bias of that of an unbiased renderer,
/// whatever its colours come to, and in need of no reference but for r² + 0.01.
struct Spread {
  std::vector<double> errors;
  double distance = 0;  ///< relMSE of the mean picture from the reference, without both noises
};

Spread spread_of(const std::vector<std::vector<double>>& images, const ConvergedImage& reference) {
  const auto n = static_cast<double>(images.size());
  std::vector<double> mean(reference.image.size());
  for (const auto& image : images) {
    for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += image[i] / n;
  }
  Spread spread;
  for (const auto& image : images) {
    double sum = 0;
    for (std::size_t i = 0; i < mean.size(); ++i) {
      const double off = image[i] - mean[i], r = reference.image[i];
      sum += off * off / (r * r + 0.01);
    }
    spread.errors.push_back(sum / static_cast<double>(mean.size()) * n / (n - 1));
  }
  spread.distance = rel_mse(mean, reference.image) - mean_with_interval(spread.errors).value / n -
                    reference.rel_mse;
  return spread;
}

/// Of the means of two samples, by the delta method, 95 %.
Estimate ratio_of_means(const std::vector<double>& a, const std::vector<double>& b) {
  const Estimate x = mean_with_interval(a), y = mean_with_interval(b);
  const double half = std::hypot((x.high - x.value) / x.value, (y.high - y.value) / y.value);
  const double ratio = x.value / y.value;
  return {ratio, ratio * std::exp(-half), ratio * std::exp(half)};
}

/// Of pairs that were measured one after the other.
Estimate ratio_of_pairs(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < a.size(); ++i) ratios.push_back(a[i] / b[i]);
  return median_with_interval(std::move(ratios));
}

/// A picture whose systematic difference is as large as a tenth of its noise is of another scene.
constexpr double kSameScene = 0.1;

std::vector<std::string> row_of(const Contestant& contestant, const Spread& spread,
                                const Contestant& first, const Spread& first_spread) {
  const double error = mean_with_interval(spread.errors).value;
  const double seconds = median_with_interval(contestant.cpu_seconds).value;
  std::vector<std::string> row = {contestant.name, fmt::format("{:.3g}", error),
                                  fmt::format("{:.3g}", seconds),
                                  fmt::format("{:.3g}", error * seconds)};
  if (!contestant.is_ours) row[2] += fmt::format(" ({:.2g})", contestant.start_seconds);
  if (spread.distance > kSameScene * error) {
    row.push_back("another picture");
    row.push_back(fmt::format("its mean is off by relMSE {:.2g}", spread.distance));
    return row;
  }
  if (&contestant == &first) {
    row.insert(row.end(), {"1", ""});
    return row;
  }
  const Estimate quality = ratio_of_means(spread.errors, first_spread.errors);
  const Estimate speed = ratio_of_pairs(contestant.cpu_seconds, first.cpu_seconds);
  row.push_back(
      text_of({quality.value * speed.value, quality.low * speed.low, quality.high * speed.high}));
  row.push_back(fmt::format("{:.3g} × {:.3g}", speed.value, quality.value));
  return row;
}

void add_quoted(const Comparison& comparison, reports::Table& table) {
  for (const Quoted& quoted : comparison.pbrt) {
    table.rows.push_back({fmt::format("pbrt-v4, {} (quoted)", quoted.sampler), "", "",
                          quoted.product, quoted.ratio, quoted.parts});
  }
}

/// By the CPU time of one thread, beside others.
void measure_table(const Subject& subject, const std::vector<Peer>& peers, reports::ResultLog& log,
                   std::string& failures) {
  std::vector<Contestant> contestants = {ours(subject, false), ours(subject, true)};
  for (const Peer& other : peers) contestants.push_back(peer(subject, other));
  run(contestants);

  reports::Table table;
  table.group = "Equal error";
  table.title = fmt::format("Error times time, {}", subject.comparison.title);
  table.caption = fmt::format(
      "relMSE of luminance times CPU seconds of one thread, {}×{} pixels, {} samples per pixel, {} "
      "renders of each in turn; the time of a command is all that it takes, in brackets with one "
      "sample per pixel. Ratios of others to "
      "ours in the first row, with 95 % intervals: what they take for the same error, and that as "
      "time × error at equal samples. Quoted: pbrt-v4 of November 2026 in a run with ours of then, "
      "0.0028 (Veach) and 0.0089 (Cornell), on another machine.",
      subject.description.camera.width, subject.description.camera.height, kComparedSamples,
      kReplicates);
  table.columns = {"renderer", "relMSE", "CPU s", "relMSE × s", "ratio", "= time × error"};
  std::vector<Spread> spreads;
  for (const Contestant& contestant : contestants) {
    if (!contestant.failure.empty()) {
      table.rows.push_back({contestant.name, "", "", "", "failed", ""});
      failures += contestant.failure + "\n";
      spreads.emplace_back();
      continue;
    }
    spreads.push_back(spread_of(contestant.images, subject.reference));
    table.rows.push_back(row_of(contestant, spreads.back(), contestants[0], spreads[0]));
  }
  std::vector<double> costs;
  for (const double seconds : contestants[1].cpu_seconds) {
    costs.push_back(mean_with_interval(spreads[1].errors).value * subject.scaled(seconds));
  }
  keep(log, subject.name() + "/adaptive", "relMSE × CPU s", std::move(costs));
  if (peers.empty()) add_quoted(subject.comparison, table);
  publish(log, table);
}

}  // namespace

void measure_equal_error(reports::ResultLog& log, const std::vector<std::string>& peers,
                         bool full) {
  const std::vector<Peer> others(peers.begin(), peers.end());
  fmt::print("equal error: relMSE × seconds, mis with Owen-scrambled Sobol'\n");
  std::string failures;
  for (const Comparison& comparison : kComparisons) {
    const Subject subject(comparison, full);
    measure_bar(subject, log);
    measure_table(subject, others, log, failures);
  }
  if (!failures.empty()) throw std::runtime_error("--peer: " + failures);
}

}  // namespace plumbline::bench
