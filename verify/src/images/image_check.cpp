#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include <plumbline/verify/detail/stopwatch.h>
#include <plumbline/verify/image.h>

#include "distributions.h"
#include "images/image_tiles.h"
#include "means/mean_judgement.h"
#include "text.h"

namespace plumbline::verify {

namespace {

constexpr int kHistogramBins = 20;
// Below this many pixels the largest residual always carries a notable share.
constexpr std::size_t kPixelsForShare = 1024;

void require(bool condition, const ImageOptions& options, const char* what) {
  if (!condition) throw std::invalid_argument("image check '" + options.subject + "': " + what);
}

void validate(const ImageOptions& options, const Image& image, const Image& reference) {
  require(image.width > 0 && image.height > 0, options, "the image is empty");
  require(image.width == reference.width && image.height == reference.height, options,
          "image and reference differ in size");
  const std::size_t n =
      static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  for (const Image* i : {&image, &reference}) {
    require(i->mean.size() == n, options, "the mean layer has the wrong length");
    require(i->variance.empty() || i->variance.size() == n, options,
            "the variance layer has the wrong length");
    require(i->variance.empty() == i->count.empty() && (i->count.empty() || i->count.size() == n),
            options, "variance and count come together, one value per pixel");
    require(std::all_of(i->count.begin(), i->count.end(),
                        [](double c) { return c >= 0 && c <= 0x1p53; }),
            options, "a count of samples is no number from 0 to 2^53");
  }
  require(options.looks >= 1 && options.look >= 0 && options.look < options.looks, options,
          "look must be one of looks");
}

double mean_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

bool all_finite(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

/// Pools the pixels into evidence about the global mean.
Evidence pool(const Residuals& r, const ImageOptions& options, double allowance) {
  const double n = static_cast<double>(r.size());
  Evidence e;
  e.estimate = mean_of(r.image);
  e.non_finite = options.non_finite;
  const double bias = mean_of(r.residual);
  double squares = 0, variance = 0, widest = 0, largest_variance = 0, samples = 0;
  for (std::size_t i = 0; i < r.size(); ++i) {
    squares += (r.residual[i] - bias) * (r.residual[i] - bias);
    widest = std::max(widest, std::abs(r.residual[i] - bias));
    if (r.variance.empty()) continue;
    variance += r.variance[i];
    largest_variance = std::max(largest_variance, r.variance[i]);
    samples += r.samples[i];
  }
  const bool from_residuals = r.variance.empty();
  e.samples = static_cast<std::uint64_t>(std::min(from_residuals ? n : samples, 0x1p63));
  e.standard_error =
      from_residuals ? std::sqrt(squares / std::max(1.0, n - 1) / n) : std::sqrt(variance) / n;
  const SumSkewness skew = sum_skewness(r.residual);
  e.skewness = skew.skewness;
  if (r.size() >= kPixelsForShare) e.largest_share = skew.largest_share;
  const bool dark = std::all_of(r.image.begin(), r.image.end(), [](double v) { return v == 0; });
  if (dark) {
    e.smallest = e.largest = 0;
  } else if (!from_residuals && 2 * (widest + std::sqrt(largest_variance)) <= allowance) {
    e.smallest = e.estimate - widest;
    e.largest = e.estimate + widest;
  }
  return e;
}

CheckResult judge_global(const ImageOptions& options, const Residuals& r, double fail_level,
                         double pass_level) {
  MeanQuestion q;
  q.reference = mean_of(r.reference);
  const double scale = std::abs(q.reference);
  q.tolerance = options.tolerance * scale;
  q.rounding_allowance = options.rounding_allowance * scale;
  q.fail_level = q.last_fail_level = fail_level;
  q.pass_level = pass_level;
  const Evidence e = pool(r, options, q.rounding_allowance);
  q.max_samples = std::max<std::uint64_t>(1, e.samples);
  return judge_mean(q, e);
}

/// A tile or pixel beyond its level makes the whole check fail.
void judge_scale(const TileScale& scale, double level, CheckResult& check) {
  double tested = 0;
  std::size_t worst = scale.tests.size();
  for (std::size_t i = 0; i < scale.tests.size(); ++i) {
    if (std::isnan(scale.tests[i].p_safe)) continue;
    ++tested;
    if (worst == scale.tests.size() || scale.tests[i].p_safe < scale.tests[worst].p_safe ||
        (scale.tests[i].p_safe == scale.tests[worst].p_safe &&
         scale.tests[i].z > scale.tests[worst].z)) {
      worst = i;
    }
  }
  if (scale.edge == 1) {
    check.figures.emplace_back(Figure::pixels_judged, tested);
  } else {
    check.figures.emplace_back("tiles of " + std::to_string(scale.edge) + " judged", tested);
  }
  if (tested == 0 || !(scale.tests[worst].p_safe * tested < level)) return;
  const int x = static_cast<int>(worst) % scale.width, y = static_cast<int>(worst) / scale.width;
  const std::string where =
      (scale.edge == 1 ? std::string("pixel (")
                       : std::to_string(scale.edge) + "-pixel tile with corner (") +
      std::to_string(x * scale.edge) + ", " + std::to_string(y * scale.edge) + ") is " +
      number(scale.tests[worst].z) + " standard errors off";
  check.verdict = Verdict::fail;
  check.p_value = std::min(check.p_value.value_or(1), scale.tests[worst].p_safe * tested);
  check.reason += (check.reason.empty() ? "" : "; ") + where;
}

void fill_map(const TileScale& scale, ImageResult& result) {
  result.tile = scale.edge;
  result.map_width = scale.width;
  result.map_height = scale.height;
  result.histogram.assign(kHistogramBins, 0.0);
  double known = 0;
  for (const TileTest& test : scale.tests) {
    result.p_map.push_back(test.p_plain);
    if (std::isnan(test.p_plain)) continue;
    const int bin = std::min(kHistogramBins - 1, static_cast<int>(test.p_plain * kHistogramBins));
    result.histogram[static_cast<std::size_t>(bin)] += 1;
    ++known;
  }
  if (known == 0) return;
  double statistic = 0;
  const double expected = known / kHistogramBins;
  for (double& share : result.histogram) {
    statistic += (share - expected) * (share - expected) / expected;
    share /= known;
  }
  if (expected >= 5) {
    result.check.figures.emplace_back(Figure::histogram_p_value,
                                      chi_square_tail(statistic, kHistogramBins - 1));
  }
}

std::vector<int> tile_edges(int width, int height) {
  std::vector<int> edges;
  for (int edge = 64; edge >= 1; edge /= 2) {
    if (2 * edge <= std::max(width, height)) edges.push_back(edge);
  }
  return edges;
}

}  // namespace

ImageResult check_image(const ImageOptions& options, const Image& image, const Image& reference) {
  validate(options, image, reference);
  const Stopwatch watch;
  ImageResult result;
  CheckResult& check = result.check;
  const bool finite = all_finite(image.mean) && all_finite(reference.mean);
  const double looks = options.looks;
  const double level = options.budget.fail_level() / looks;
  const Residuals residuals = make_residuals(image, reference);
  // Half of the level for the global mean, the other half split evenly over the scales.
  check = judge_global(options, residuals, level / 2, options.budget.pass_level() / looks);
  if (finite) {
    const std::vector<int> edges = tile_edges(image.width, image.height);
    const int map_edge = std::min(image.width, image.height) >= 128 ? 8 : 4;
    for (const int edge : edges) {
      const TileScale scale = test_tiles(residuals, edge, options.rounding_allowance);
      judge_scale(scale, level / 2 / static_cast<double>(edges.size()), check);
      if (edge == map_edge) fill_map(scale, result);
    }
  } else {
    check.verdict = Verdict::fail;
    check.reason = "a pixel of the image or of the reference is not finite";
  }
  if (check.verdict == Verdict::inconclusive) check.advice = "render more samples per pixel";
  check.kind = CheckKind::image;
  check.subject = options.subject;
  check.expected = options.expected;
  check.seed = options.seed;
  check.seconds = watch.seconds();
  return result;
}

}  // namespace plumbline::verify
