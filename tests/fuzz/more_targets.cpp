#include <algorithm>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

#include <plumbline/exchange/npy.h>
#include <plumbline/merging/merge.h>
#include <plumbline/merging/sample_range.h>
#include <plumbline/renderer/image_io/exr.h>
#include <plumbline/reports/history.h>
#include <plumbline/reports/history_report.h>
#include <plumbline/verify/image.h>

#include "../../tools/domain_argument.h"
#include "../../tools/render_values.h"
#include "../../tools/scene_argument.h"
#include "folder.h"
#include "targets.h"

namespace plumbline::tests {
namespace {

verify::Image channel_of(const renderer::Image& image, float renderer::Rgbf::*channel) {
  verify::Image result{image.width, image.height, {}, {}, {}};
  for (const renderer::Rgbf& pixel : image.pixels) {
    result.mean.push_back(double{pixel.*channel});
  }
  if (image.variance.empty() || image.count.empty()) return result;
  for (const renderer::Rgbf& pixel : image.variance) {
    result.variance.push_back(double{pixel.*channel});
  }
  result.count.assign(image.count.begin(), image.count.end());
  return result;
}

/// Bytes that end.
class Bytes : public exchange::ByteSource {
 public:
  explicit Bytes(std::string_view bytes) : bytes_(bytes) {}

  void read(std::byte* to, std::size_t count) override {
    if (count > bytes_.size()) throw exchange::NpyError("ends too soon");
    std::memcpy(to, bytes_.data(), count);
    bytes_.remove_prefix(count);
  }

 private:
  std::string_view bytes_;
};

/// All that `history` reads.
void read_history(const std::filesystem::path& file) {
  const reports::History history(file, reports::History::Access::read);
  for (const reports::HistoryRun& run : history.runs()) {
    history.count_checks(run.id);
    history.checks(run.id);
    history.distributions(run.id);
    history.counters(run.id);
    judge_runs(history, comparable_key(run.environment), run.kind);
  }
}

}  // namespace

void fuzz_compare(std::string_view bytes) {
  const std::filesystem::path file = folder().write("picture.exr", bytes);
  may_refuse([&] {
    const renderer::Image image = renderer::read_exr(file);
    constexpr std::size_t kMostPixels = 4096;
    if (image.pixels.size() > kMostPixels) return;
    renderer::Image grey = image;
    for (renderer::Rgbf& pixel : grey.pixels) pixel = {0.5f, 0.5f, 0.5f};
    for (const auto channel : {&renderer::Rgbf::r, &renderer::Rgbf::b}) {
      try {
        check_image({}, channel_of(image, channel), channel_of(grey, channel));
      } catch (const std::invalid_argument&) {  // counts that are none
      }
    }
    write_exr(folder() / "merged.exr", merging::merge_images({file.string()}));
  });
}

void fuzz_values(std::string_view bytes) {
  bytes = bytes.substr(0, 4096);  // no command line is longer where a person writes it
  for (std::size_t begin = 0; begin <= bytes.size();) {
    const std::size_t end = std::min(bytes.find('\n', begin), bytes.size());
    const std::string value(bytes.substr(begin, end - begin));
    begin = end + 1;
    renderer::PathOptions path;
    may_refuse([&] { tools::parse_size(value); });
    may_refuse([&] { tools::set_counts(value, path); });
    may_refuse([&] { tools::parse_roulette(value); });
    may_refuse([&] { tools::parse_heuristic(value); });
    may_refuse([&] { tools::parse_domain(value); });
    may_refuse([&] { tools::numeric_values(tools::parse_definitions({value})); });
    may_refuse([&] { merging::parse_shard(value); });
    may_refuse([&] { merging::parse_ranges(value); });
  }
}

void fuzz_npy(std::string_view bytes) {
  Bytes source(bytes);
  try {
    exchange::read_npy_header(source);
  } catch (const exchange::NpyError&) {
  }
}

void fuzz_history(std::string_view bytes) {
  for (const char* rest : {"history.db-wal", "history.db-shm"}) {
    std::filesystem::remove(folder() / rest);
  }
  const std::filesystem::path file = folder().write("history.db", bytes);
  may_refuse([&] {
    try {
      read_history(file);
    } catch (const reports::HistoryError&) {
    }
  });
}

}  // namespace plumbline::tests
