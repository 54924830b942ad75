#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <plumbline/output/output_file.h>
#include <plumbline/renderer/assembly/description.h>
#include <plumbline/renderer/assembly/render.h>
#include <plumbline/renderer/image_io/exr.h>
#include <plumbline/reports/render_record.h>
#include "allocation.h"

namespace plumbline::bench {
namespace {

using renderer::Allocation;
using renderer::Scene;

constexpr auto kSamples = static_cast<double>(kIterations * kIterationSamples);

// The other policies draw nearly the samples that root-nodes draws with the same seed.
constexpr std::size_t kAnchor = 6;
static_assert(renderer::kAllocations[kAnchor] == Allocation::root_nodes);
constexpr std::uint64_t kPilotSeed = 0xb10f;

using Reference = std::vector<PixelIntegrals>;

double variance(const PixelIntegrals& pixel, std::size_t k, VarianceOf of) {
  switch (of) {
    case VarianceOf::counts:
      return pixel.count_variance(k);
    case VarianceOf::mixture:
      return pixel.mixture_variance(k);
    case VarianceOf::optimal_weights:
      return pixel.optimal_weights_variance(k);
  }
  return 0;
}

/// Variance of a pixel after `iterations`, whose samples all have the same weight.
double variance_after(const PixelIntegrals& pixel, const std::uint8_t* shares,
                      std::size_t iterations, VarianceOf of) {
  double sum = 0;
  for (std::size_t j = 0; j < iterations; ++j) sum += variance(pixel, shares[j], of);
  return sum / static_cast<double>(iterations * iterations * kIterationSamples);
}

ImageError image_error(const Reference& reference, const Shares& shares, VarianceOf of) {
  ImageError error;
  for (std::size_t i = 0; i < reference.size(); ++i) {
    const PixelIntegrals& pixel = reference[i];
    const double v = variance_after(pixel, &shares[i * kIterations], kIterations, of);
    error.mse += v;
    error.mean_sd += std::sqrt(v);
    error.rel_mse += v / (pixel.mean * pixel.mean + 0.01);
  }
  const auto pixels = static_cast<double>(reference.size());
  return {error.mse / pixels, error.mean_sd / pixels, error.rel_mse / pixels};
}

std::vector<double> rmse_by_iteration(const Reference& reference, const Shares& shares,
                                      VarianceOf of) {
  std::vector<double> rmse;
  for (std::size_t n = 1; n <= kIterations; ++n) {
    double sum = 0;
    for (std::size_t i = 0; i < reference.size(); ++i) {
      sum += variance_after(reference[i], &shares[i * kIterations], n, of);
    }
    rmse.push_back(std::sqrt(sum / static_cast<double>(reference.size())));
  }
  return rmse;
}

double mean_share(const Shares& shares) {
  double sum = 0;
  for (const std::uint8_t k : shares) sum += k;
  return sum / static_cast<double>(kIterationSamples * shares.size());
}

MethodRun method_run(const std::string& method, const Reference& reference, const Shares& shares,
                     VarianceOf counts = VarianceOf::counts) {
  // Optimal weights are the counts' only: they have no mixture whose variance would differ.
  const VarianceOf mixture = counts == VarianceOf::counts ? VarianceOf::mixture : counts;
  return {method, image_error(reference, shares, counts), image_error(reference, shares, mixture),
          rmse_by_iteration(reference, shares, counts), mean_share(shares)};
}

/// The first iteration at `first`, the others at what each pixel is given.
Shares fixed_shares(std::size_t pixels, std::size_t first,
                    const std::function<std::size_t(std::size_t)>& of_pixel) {
  Shares shares;
  shares.reserve(pixels * kIterations);
  for (std::size_t i = 0; i < pixels; ++i) {
    shares.push_back(static_cast<std::uint8_t>(first));
    shares.insert(shares.end(), kIterations - 1, static_cast<std::uint8_t>(of_pixel(i)));
  }
  return shares;
}

std::size_t best_with_optimal_weights(const PixelIntegrals& pixel) {
  std::size_t best = kEqual;
  for (std::size_t k = kIterationSamples / 10; k <= kIterationSamples - kIterationSamples / 10;
       ++k) {
    if (pixel.optimal_weights_variance(k) < pixel.optimal_weights_variance(best)) best = k;
  }
  return best;
}

void write_map(const AllocationScene& scene, const Scene& built, const std::string& method,
               const Shares& shares, const std::filesystem::path& directory) {
  renderer::Image image;
  image.width = built.camera().width();
  image.height = built.camera().height();
  for (std::size_t i = kIterations - 1; i < shares.size(); i += kIterations) {
    const float share = static_cast<float>(shares[i]) / kIterationSamples;
    image.pixels.push_back({share, share, share});
  }
  const auto stem = directory / fmt::format("{}-{}", scene.name, method);
  reports::RenderRecord record;
  record.scene =
      fmt::format("Share of BSDF samples in the last iteration, 0.1 to 0.9: {}", scene.title);
  record.strategy = method;
  record.width = image.width;
  record.height = image.height;
  record.samples_per_pixel = kIterations * kIterationSamples;
  record.image = stem.string() + ".exr";
  output::Files files;
  files.writes("image", record.image).fill([&](const auto& path) { write_exr(path, image); });
  const std::string json = stem.string() + ".json";
  files.writes("record", json).fill([&](const auto& path) {
    write_render_record(path, record, json);
  });
  files.finish();
}

class Experiment {
 public:
  Experiment(const AllocationScene& scene, const AllocationWork& work, double cost_ratio,
             std::filesystem::path maps)
      : description_(scene),
        work_(work),
        scene_(make_scene(load(scene, work))),
        cost_ratio_(cost_ratio),
        maps_(std::move(maps)) {
    const Reference pilot = measure_integrals(scene_, work.reference_samples, kPilotSeed);
    units_ = pixel_units(pilot, scene_.camera().width(), kSamples);
    for (int r = 0; r < work.references; ++r) {
      references_.push_back(measure_integrals(scene_, work.reference_samples,
                                              0x5eed + static_cast<std::uint64_t>(r)));
    }
    pool_references();
  }

  AllocationResults run() {
    AllocationResults results;
    std::vector<RenderErrors> errors(std::size(renderer::kAllocations));
    for (std::size_t r = 0; r < replicates(); ++r) {
      results.replicates.push_back(known_methods(r));
      for (std::size_t p = 0; p < errors.size(); ++p) {
        results.replicates.back().push_back(policy_run(r, renderer::kAllocations[p], errors[p]));
      }
    }
    for (std::size_t p = 0; p < errors.size(); ++p) {
      while (errors[p].renders() < renders_of(renderer::kAllocations[p])) {
        render_policy(static_cast<std::size_t>(errors[p].renders()), renderer::kAllocations[p],
                      errors[p]);
      }
    }
    for (std::size_t p = 0; p < errors.size(); ++p) {
      results.checks.push_back(
          errors[p].result(std::string(name(renderer::kAllocations[p])), errors[kAnchor]));
    }
    return results;
  }

 private:
  void pool_references() {
    const auto n = static_cast<double>(references_.size());
    for (std::size_t i = 0; i < references_[0].size(); ++i) {
      PixelIntegrals sum;
      double squares = 0;
      for (const Reference& reference : references_) {
        sum += reference[i];
        squares += reference[i].mean * reference[i].mean;
      }
      sum /= n;
      pooled_.push_back(sum);
      pooled_error_.push_back(std::max(squares / n - sum.mean * sum.mean, 0.0) / (n - 1));
    }
  }

  std::size_t replicates() const { return static_cast<std::size_t>(work_.replicates); }

  int renders_of(Allocation policy) const {
    if (policy == renderer::kAllocations[kAnchor]) return work_.anchor_renders;
    return policy == Allocation::lu ? work_.lu_renders : work_.replicates;
  }

  /// Methods that need no rendering. What is best is found in the references of the other
  /// replicates: found in the one that judges it, it would owe part of its lead to chance.
  std::vector<MethodRun> known_methods(std::size_t r) const {
    const Reference& judge = references_[r];
    const auto fixed = [&](std::size_t k) {
      return fixed_shares(judge.size(), k, [k](std::size_t) { return k; });
    };
    const auto best = [&](const auto& choose) {
      return fixed_shares(judge.size(), kEqual, [&, choose](std::size_t i) {
        PixelIntegrals others;
        for (std::size_t q = 0; q < replicates(); ++q) {
          if (q != r) others += references_[q][i];
        }
        others /= static_cast<double>(replicates() - 1);
        return choose(others);
      });
    };
    const Shares optimum = best(best_share);
    if (r == 0) write_map(description_, scene_, "optimum", optimum, maps_);
    return {method_run("bsdf", judge, fixed(kIterationSamples)),
            method_run("light", judge, fixed(0)), method_run("optimum", judge, optimum),
            method_run("optimal weights, equal", judge, fixed(kEqual), VarianceOf::optimal_weights),
            method_run("optimal weights, best share", judge, best(best_with_optimal_weights),
                       VarianceOf::optimal_weights)};
  }

  Shares render_policy(std::size_t r, Allocation policy, RenderErrors& errors) const {
    renderer::RenderOptions options;
    options.path.max_depth = 2;
    options.samples_per_pixel = static_cast<std::uint32_t>(kSamples);
    options.seed = r + 1;
    options.allocation = {.policy = policy, .iterations = kIterations, .cost_ratio = cost_ratio_};
    const renderer::RenderResult result = render(scene_, options);
    errors.add(result, units_, pooled_, pooled_error_,
               static_cast<double>(work_.references) * work_.reference_samples);
    return {result.bsdf_counts.begin(), result.bsdf_counts.end()};
  }

  MethodRun policy_run(std::size_t r, Allocation policy, RenderErrors& errors) const {
    const Shares shares = render_policy(r, policy, errors);
    const std::string method(name(policy));
    if (r == 0) write_map(description_, scene_, method, shares, maps_);
    return method_run(method, references_[r], shares);
  }

  AllocationScene description_;
  AllocationWork work_;
  Scene scene_;
  double cost_ratio_;
  std::filesystem::path maps_;
  std::vector<PixelUnit> units_;
  std::vector<Reference> references_;
  Reference pooled_;
  std::vector<double> pooled_error_;  // variance of its means
};

}  // namespace

AllocationResults run_allocation(const AllocationScene& scene, const AllocationWork& work,
                                 double cost_ratio, const std::filesystem::path& maps) {
  std::filesystem::create_directories(maps);
  return Experiment(scene, work, cost_ratio, maps).run();
}

}  // namespace plumbline::bench
