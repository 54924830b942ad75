#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>

namespace plumbline::reports {

/// What one run of `plumbline render` did: its `--json`. JSON format "plumbline.render/1".
struct RenderRecord {
  std::string scene;
  std::string strategy;
  std::string heuristic;         ///< empty where the strategy has no use for one
  std::string sampler;           ///< "independent", "sobol"
  std::uint64_t replicates = 1;  ///< independent parts that the samples fall into
  std::string light_selection;   ///< "uniform", "area", "power"
  std::string accelerator;       ///< "embree", "brute_force"; empty in records of before
  std::uint64_t samples_per_pixel = 0;
  bool adaptive = false;           ///< so many on average
  std::uint64_t first_sample = 0;  ///< number of the first one of a pixel
  std::uint64_t end_sample = 0;    ///< one past the last: of a pixel that has most; 0: not told
  double seconds = 0;              ///< wall clock, rendering only
  std::uint64_t camera_rays = 0;
  std::uint64_t bounce_rays = 0;
  std::uint64_t shadow_rays = 0;
  std::uint64_t rejected = 0;    ///< samples that a technique could not make
  std::uint64_t non_finite = 0;  ///< samples left out of the mean: NaN or infinite
  std::array<double, 3> mean{};  ///< RGB radiance over the image [W/(m² sr)]
  std::uint64_t seed = 0;
  std::string version;
  int max_depth = -1;  ///< −1: no limit
  int width = 0, height = 0;
  int threads = 0;
  std::filesystem::path image;  ///< the EXR; in the file relative to it; empty if none was kept
  std::map<std::string, std::string> parameters;  ///< scene parameters set by -D

  bool operator==(const RenderRecord&) const = default;
};

std::string to_json(const RenderRecord& record);

/// @throws FormatError
RenderRecord parse_render_record(std::string_view json);

/// Writes the record as a JSON file. `record.image` is taken relative to the working directory and
/// stored relative to the file, so that a results directory can be moved.
///
/// @param target  where the file will be, if not at `path`
/// @throws std::system_error where the file cannot be written
void write_render_record(const std::filesystem::path& path, const RenderRecord& record,
                         const std::filesystem::path& target = {});

/// The record, its image path made relative to the working directory again.
///
/// @throws FormatError, std::system_error where the file cannot be read
RenderRecord read_render_record(const std::filesystem::path& path);

}  // namespace plumbline::reports
