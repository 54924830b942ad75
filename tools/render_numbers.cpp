#include "render_numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>

namespace plumbline::tools {
namespace {

constexpr auto kLargest = static_cast<double>(std::numeric_limits<float>::max());

bool check_samples(const renderer::Scene& scene, const renderer::RenderOptions& options,
                   const renderer::RenderResult& result) {
  const auto first = renderer::first_non_finite(scene, options, result);
  if (!first) return true;
  const std::uint64_t count = result.film.non_finite();
  const std::string sample = first->sample ? fmt::format("sample {} of ", *first->sample) : "";
  fmt::print(stderr,
             "plumbline: {} sample{} NOT FINITE and left out of the image, which is written: the "
             "first is {}pixel ({}, {})\n",
             count, count == 1 ? " was" : "s were", sample, first->x, first->y);
  return false;
}

bool check_variances(const renderer::Film& film) {
  const auto& pixels = film.pixels();
  const auto too_large = [](const renderer::PixelMoments& pixel) {
    return !(max_component(pixel.variance()) <= kLargest);
  };
  const auto found = std::find_if(pixels.begin(), pixels.end(), too_large);
  if (found == pixels.end()) return true;
  const auto index = found - pixels.begin();
  fmt::print(stderr,
             "plumbline: the variance of {} pixels is beyond what an image holds ({:.2g}) and "
             "written as infinity: the first is pixel ({}, {})\n",
             std::count_if(pixels.begin(), pixels.end(), too_large), kLargest, index % film.width(),
             index / film.width());
  return false;
}

}  // namespace

bool check_numbers(const renderer::Scene& scene, const renderer::RenderOptions& options,
                   const renderer::RenderResult& result) {
  const bool finite = check_samples(scene, options, result);
  return check_variances(result.film) && finite;
}

}  // namespace plumbline::tools
