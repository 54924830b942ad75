#include <plumbline/reports/render_record.h>

#include "files.h"

namespace plumbline::reports {
namespace {

/// The directory that a file is in, never empty.
std::filesystem::path directory_of(const std::filesystem::path& path) {
  return std::filesystem::absolute(path).parent_path();
}

}  // namespace

void write_render_record(const std::filesystem::path& path, const RenderRecord& record,
                         const std::filesystem::path& target) {
  RenderRecord stored = record;
  if (!record.image.empty()) {
    stored.image = std::filesystem::relative(std::filesystem::absolute(record.image),
                                             directory_of(target.empty() ? path : target));
  }
  detail::write_file(path, to_json(stored) + "\n");
}

RenderRecord read_render_record(const std::filesystem::path& path) {
  RenderRecord record = parse_render_record(detail::read_file(path));
  if (!record.image.empty()) record.image = path.parent_path() / record.image;
  return record;
}

}  // namespace plumbline::reports
