#include "examples.h"

#include <cmath>
#include <numbers>

#include <plumbline/calibration/samplers.h>

namespace plumbline::calibration {

namespace {

using std::numbers::pi;
using verify::SampleRecord;
using verify::SamplingPair;
using verify::Uniforms;
using verify::Vec3;

Vec3 cosine_direction(double u, double v) {
  const double radius = std::sqrt(u), phi = 2 * pi * v;
  return {radius * std::cos(phi), radius * std::sin(phi), std::sqrt(1 - u)};
}

double cosine_pdf(const Vec3& w) { return w[2] > 0 ? w[2] / pi : 0; }

SampleRecord at(const Vec3& x) {
  SampleRecord s;
  s.x = x;
  return s;
}

// exp(−k (1 − cosθ)): about 3° wide, and next to nothing of it below the horizon.
constexpr double kLobe = 1000;

Vec3 lobe_direction(double u, double v) {
  const double h = -std::log1p(-u) / kLobe, phi = 2 * pi * v;
  const double radius = std::sqrt(h * (2 - h));
  return {radius * std::cos(phi), radius * std::sin(phi), 1 - h};
}

double lobe_pdf(const Vec3& w) {
  if (!(w[2] > 0)) return 0;
  // 1 − cosθ without cancellation.
  const double h = (w[0] * w[0] + w[1] * w[1]) / (1 + w[2]);
  return kLobe / (2 * pi) * std::exp(-kLobe * h);
}

}  // namespace

SamplingPair tilted_cosine(double epsilon) {
  SamplingPair pair;
  pair.name = "tilted cosine";
  pair.sample = [](const Uniforms& u) { return at(cosine_direction(u[0], u[1])); };
  pair.pdf = [epsilon](const Vec3& w) { return cosine_pdf(w) * (1 + epsilon * (w[2] - 2.0 / 3)); };
  return pair;
}

SamplingPair lobe_mixture(double stated_weight) {
  SamplingPair pair;
  pair.name = "lobe mixture";
  pair.sample = [](const Uniforms& u) {
    return at(u[1] < 0.5 ? cosine_direction(u[0], 2 * u[1]) : lobe_direction(u[0], 2 * u[1] - 1));
  };
  pair.pdf = [stated_weight](const Vec3& w) {
    return stated_weight * lobe_pdf(w) + (1 - stated_weight) * cosine_pdf(w);
  };
  return pair;
}

verify::Image noisy_image(int edge, int samples_per_pixel, double bias, std::uint64_t seed) {
  verify::Image image{edge, edge, {}, {}, {}};
  verify::Random random(seed);
  for (int pixel = 0; pixel < edge * edge; ++pixel) {
    double sum = 0, squares = 0;
    for (int s = 0; s < samples_per_pixel; ++s) {
      const double x = Exponential{}(random);
      sum += x;
      squares += x * x;
    }
    const double n = samples_per_pixel, mean = sum / n;
    image.mean.push_back(bias * mean);
    image.variance.push_back(bias * bias * (squares - n * mean * mean) / (n - 1));
    image.count.push_back(n);
  }
  return image;
}

verify::Image grey_image(int edge) {
  verify::Image image{edge, edge, {}, {}, {}};
  image.mean.assign(static_cast<std::size_t>(edge) * static_cast<std::size_t>(edge), 1.0);
  return image;
}

}  // namespace plumbline::calibration
