#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace plumbline::reports {

/// One point of a curve of error against time. JSON format "plumbline.speed/1".
struct SpeedPoint {
  std::string scene;
  std::string strategy;
  std::string heuristic;  ///< empty where the strategy has no use for one
  std::string sampler;    ///< "independent", …
  std::uint64_t samples_per_pixel = 0;
  double seconds = 0;      ///< wall clock of one replicate, mean
  std::uint64_t rays = 0;  ///< of all kinds in one replicate, mean
  double rel_mse = 0;      ///< luminance relMSE: mean over pixels of (x − r)²/(r² + 0.01)
  double rel_mse_low = 0;  ///< 95 % confidence interval over the replicates
  double rel_mse_high = 0;
  std::uint64_t replicates = 0;  ///< independent renders behind the numbers

  bool operator==(const SpeedPoint&) const = default;
};

/// What a shadow ray costs: the same rays asked "is anything in the way?" and "what is nearest?".
/// JSON format "plumbline.ray_cost/1".
struct RayCost {
  std::string scene;
  std::string rays;              ///< which rays were recorded: "light samples of the mis strategy"
  double occluded_fraction = 0;  ///< of the rays, in [0, 1]
  int width = 1;                 ///< rays per Embree call: 1, 4, 8 or 16
  std::uint64_t count = 0;       ///< rays per repetition
  double intersect_ns = 0;       ///< rtcIntersect, per ray, median [ns]
  double occluded_ns = 0;        ///< rtcOccluded, per ray, median [ns]
  double ratio = 0;              ///< occluded over intersect, median of interleaved repetitions
  double ratio_low = 0;          ///< 95 % confidence interval
  double ratio_high = 0;

  bool operator==(const RayCost&) const = default;
};

std::string to_json(const SpeedPoint& point);
std::string to_json(const RayCost& cost);

/// @throws FormatError
SpeedPoint parse_speed_point(std::string_view json);
/// @throws FormatError
RayCost parse_ray_cost(std::string_view json);

}  // namespace plumbline::reports
