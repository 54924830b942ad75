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
  double seconds = 0;      ///< time of one replicate, mean
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

/// A figure that a benchmark is held against. JSON format "plumbline.bar/1".
struct Bar {
  std::string name;       ///< "Cornell box, equal error"
  std::string unit;       ///< of all numbers below: "relMSE × s"; may be empty
  bool at_least = false;  ///< whether the limit is the smallest or the largest that will do
  double limit = 0;       ///< the bar
  double measured = 0;
  double low = 0;  ///< 95 % confidence interval
  double high = 0;
  bool indicative = false;  ///< measured on less than what the bar asks for: no verdict
  std::string comparison;   ///< what others reach, may be empty: "pbrt-v4, zsobol: 0.075"
  std::string note;         ///< how it was measured

  bool operator==(const Bar&) const = default;
};

/// "met" or "missed" where the whole interval lies on one side of the limit, "open" where the limit
/// is inside, "indicative" where the measurement cannot tell; never "met" for what is not a number.
std::string_view verdict(const Bar& bar);

std::string to_json(const SpeedPoint& point);
std::string to_json(const RayCost& cost);
std::string to_json(const Bar& bar);

/// @throws FormatError
SpeedPoint parse_speed_point(std::string_view json);
/// @throws FormatError
RayCost parse_ray_cost(std::string_view json);
/// @throws FormatError
Bar parse_bar(std::string_view json);

}  // namespace plumbline::reports
