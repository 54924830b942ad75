#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <plumbline/renderer/core/errors.h>

#include "document.h"
#include "parts.h"

namespace plumbline::renderer {
namespace {

constexpr std::size_t kMaxMeshBytes = std::size_t{512} << 20;
constexpr std::size_t kMaxCorners = 255;  // what readers hold that count them in a byte
constexpr std::string_view kSpace = " \t\r";

/// Refuses a line, to which the caller knows the way.
template <class... Args>
[[noreturn]] void refuse_line(fmt::format_string<Args...> why, Args&&... args) {
  throw InputError(fmt::format(why, std::forward<Args>(args)...));
}

using Words = std::vector<std::string_view>;

/// @param words  takes the words of the line; one for all lines, as allocations would cost most
void split(std::string_view line, Words& words) {
  words.clear();
  while (true) {
    line.remove_prefix(std::min(line.find_first_not_of(kSpace), line.size()));
    if (line.empty()) return;
    words.push_back(line.substr(0, line.find_first_of(kSpace)));
    line.remove_prefix(words.back().size());
  }
}

Vec3d read_vertex(const Words& words) {
  if (words.size() != 4) refuse_line("a vertex needs three coordinates, not {}", words.size() - 1);
  std::array<double, 3> p{};
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (parse_whole(words[i + 1], p[i]) != std::errc() || !std::isfinite(p[i])) {
      refuse_line("{} is not a finite number", in_quotes(words[i + 1]));
    }
  }
  return {p[0], p[1], p[2]};
}

std::vector<std::uint32_t> read_corners(const Words& words, std::size_t vertices) {
  std::vector<std::uint32_t> corners;
  for (std::size_t i = 1; i < words.size(); ++i) {
    long long index = 0;
    if (parse_whole(words[i].substr(0, words[i].find('/')), index) != std::errc()) {
      refuse_line("{} is not a vertex of a face", in_quotes(words[i]));
    }
    if (index < 1 || index > static_cast<long long>(vertices)) {
      refuse_line("vertex {} does not exist: {} stand above this face", index, vertices);
    }
    corners.push_back(static_cast<std::uint32_t>(index - 1));
  }
  if (corners.size() < 3 || corners.size() > kMaxCorners) {
    refuse_line("a face has 3 to {} vertices, not {}", kMaxCorners, corners.size());
  }
  return corners;
}

/// Triangles without area are left out: no ray meets them and they emit nothing.
void add_triangle(MeshShape& mesh, const std::array<std::uint32_t, 3>& t) {
  const Vec3d& v0 = mesh.vertices[t[0]];
  const Vec3d normal = cross(mesh.vertices[t[1]] - v0, mesh.vertices[t[2]] - v0);
  if (length_squared(normal) > 0) mesh.triangles.push_back(t);
}

/// @return whether the line is a face
bool read_line(const Words& words, const Affine& to_world, MeshShape& mesh) {
  if (words.empty() || words[0][0] == '#') return false;
  if (words[0] == "v") {
    mesh.vertices.push_back(to_world.point(read_vertex(words)));
    return false;
  }
  if (words[0] == "f") {
    const std::vector<std::uint32_t> corners = read_corners(words, mesh.vertices.size());
    for (std::size_t i = 2; i < corners.size(); ++i) {
      add_triangle(mesh, {corners[0], corners[i - 1], corners[i]});
    }
    return true;
  }
  for (const char* ignored : {"vn", "vt", "o", "g", "s", "usemtl", "mtllib"}) {
    if (words[0] == ignored) return false;
  }
  refuse_line("{} is not supported in an obj file", in_quotes(words[0]));
}

/// What it asks for in memory is in proportion to the text.
MeshShape read_obj(std::string_view text, const std::string& file, const Affine& to_world) {
  MeshShape mesh;
  Words words;
  bool has_faces = false;
  for (std::size_t line_number = 1; !text.empty(); ++line_number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    split(text.substr(0, end), words);
    try {
      has_faces |= read_line(words, to_world, mesh);
    } catch (const InputError& error) {
      throw InputError(fmt::format("{}:{}: {}", file, line_number, error.what()));
    }
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  if (!has_faces) throw InputError(fmt::format("{}: holds no faces", file));
  return mesh;
}

}  // namespace

MeshShape read_mesh(const Object& shape, const Reading& in) {
  const std::filesystem::path file = file_of(shape, in);
  std::string text;
  try {
    text = read_text_file(file, kMaxMeshBytes);
  } catch (const InputError& error) {
    fail(shape.at(kFilename), "{}", error.what());
  }
  MeshShape mesh = read_obj(text, file.string(), shape[kToWorld]);
  shape.require(std::all_of(mesh.vertices.begin(), mesh.vertices.end(), is_in_range), kFilename,
                "{} puts a coordinate beyond {:g}", file.c_str(), kMaxLength);
  shape.require(!mesh.triangles.empty(), kFilename, "{} has no triangle with an area",
                file.c_str());
  return mesh;
}

}  // namespace plumbline::renderer
