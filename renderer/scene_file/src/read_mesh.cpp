#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <plumbline/renderer/core/errors.h>

#include "read_parts.h"
#include "text_file.h"

namespace plumbline::renderer {
namespace {

constexpr std::size_t kMaxMeshBytes = std::size_t{512} << 20;
constexpr std::size_t kMaxCorners = 255;  // what readers hold that count them in a byte
constexpr std::string_view kSpace = " \t\r";

/// Empty at the end of the line.
std::string_view take_word(std::string_view& line) {
  line.remove_prefix(std::min(line.find_first_not_of(kSpace), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(kSpace));
  line.remove_prefix(word.size());
  return word;
}

template <class T>
bool parses_whole(std::string_view word, T& value) {
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && end == word.data() + word.size();
}

/// Reads an obj file line by line. What it asks for in memory is in proportion to its text.
class ObjReader {
 public:
  ObjReader(const std::filesystem::path& file, const Affine& to_world)
      : file_(file), to_world_(to_world) {}

  MeshShape read(std::string_view text) {
    bool has_faces = false;
    while (!text.empty()) {
      ++line_number_;
      const std::size_t end = std::min(text.find('\n'), text.size());
      has_faces = read_line(text.substr(0, end)) || has_faces;
      text.remove_prefix(std::min(end + 1, text.size()));
    }
    if (!has_faces) throw InputError(fmt::format("{}: holds no faces", file_.string()));
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw InputError(fmt::format("{}:{}: {}", file_.string(), line_number_, message));
  }

  /// @return whether it is a face
  bool read_line(std::string_view line) {
    const std::string_view keyword = take_word(line);
    if (keyword.empty() || keyword[0] == '#') return false;
    if (keyword == "v") {
      read_vertex(line);
      return false;
    }
    if (keyword == "f") {
      read_face(line);
      return true;
    }
    for (const std::string_view ignored : {"vn", "vt", "o", "g", "s", "usemtl", "mtllib"}) {
      if (keyword == ignored) return false;
    }
    fail(fmt::format("{} is not supported in an obj file", in_quotes(keyword)));
  }

  void read_vertex(std::string_view line) {
    std::array<double, 3> p{};
    std::size_t count = 0;
    for (std::string_view word = take_word(line); !word.empty(); word = take_word(line)) {
      double value = 0;
      if (!parses_whole(word, value) || !std::isfinite(value)) {
        fail(fmt::format("{} is not a finite number", in_quotes(word)));
      }
      if (count < p.size()) p[count] = value;
      ++count;
    }
    if (count != p.size()) fail(fmt::format("a vertex needs three coordinates, not {}", count));
    mesh_.vertices.push_back(to_world_.point({p[0], p[1], p[2]}));
  }

  void read_face(std::string_view line) {
    corners_.clear();
    for (std::string_view word = take_word(line); !word.empty(); word = take_word(line)) {
      long long index = 0;
      if (!parses_whole(word.substr(0, word.find('/')), index)) {
        fail(fmt::format("{} is not a vertex of a face", in_quotes(word)));
      }
      if (index < 1 || index > static_cast<long long>(mesh_.vertices.size())) {
        fail(fmt::format("vertex {} does not exist: {} stand above this face", index,
                         mesh_.vertices.size()));
      }
      corners_.push_back(static_cast<std::uint32_t>(index - 1));
    }
    if (corners_.size() < 3 || corners_.size() > kMaxCorners) {
      fail(fmt::format("a face has 3 to {} vertices, not {}", kMaxCorners, corners_.size()));
    }
    for (std::size_t i = 2; i < corners_.size(); ++i) {
      add_triangle({corners_[0], corners_[i - 1], corners_[i]});
    }
  }

  /// Triangles without area are left out: no ray meets them and they emit nothing.
  void add_triangle(const std::array<std::uint32_t, 3>& t) {
    const Vec3d& v0 = mesh_.vertices[t[0]];
    const Vec3d normal = cross(mesh_.vertices[t[1]] - v0, mesh_.vertices[t[2]] - v0);
    if (length_squared(normal) > 0) mesh_.triangles.push_back(t);
  }

  const std::filesystem::path& file_;
  const Affine& to_world_;
  MeshShape mesh_;
  std::size_t line_number_ = 0;
  std::vector<std::uint32_t> corners_;  ///< of the face that is being read
};

}  // namespace

MeshShape read_mesh(const Object& shape) {
  const std::filesystem::path& file = shape[kFilename];
  std::string text;
  try {
    text = read_text_file(file, kMaxMeshBytes);
  } catch (const InputError& error) {
    shape.fail(kFilename, error.what());
  }
  MeshShape mesh = ObjReader(file, shape[kToWorld]).read(text);
  if (!std::all_of(mesh.vertices.begin(), mesh.vertices.end(), is_in_range)) {
    shape.fail(kFilename,
               fmt::format("{} puts a coordinate beyond {:g}", file.string(), kMaxLength));
  }
  if (mesh.triangles.empty()) {
    shape.fail(kFilename, fmt::format("{} has no triangle with an area", file.string()));
  }
  return mesh;
}

}  // namespace plumbline::renderer
