#include <fmt/format.h>
#include <tiny_obj_loader.h>

#include <charconv>
#include <cstddef>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <plumbline/renderer/core/errors.h>

#include "read_parts.h"
#include "text_file.h"

namespace plumbline::renderer {
namespace {

constexpr std::size_t kMaxMeshBytes = std::size_t{512} << 20;
constexpr int kMaxCorners = 255;  // tinyobjloader counts a face's corners in a byte
constexpr std::string_view kSpace = " \t\r";

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

/// Goes through an obj file before tinyobjloader does, which reads what it does not understand as
/// zero, drops faces with vertices that do not exist, and grants any size that the file asks for.
class ObjCheck {
 public:
  ObjCheck(const std::filesystem::path& file, std::string_view text) : file_(file), text_(text) {}

  void run() {
    std::string_view rest = text_;
    while (!rest.empty()) {
      ++line_number_;
      const std::size_t end = std::min(rest.find('\n'), rest.size());
      check_line(rest.substr(0, end));
      rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    if (faces_ == 0) {
      throw InputError(fmt::format("{}: holds no faces", file_.string()));
    }
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw InputError(fmt::format("{}:{}: {}", file_.string(), line_number_, message));
  }

  void check_line(std::string_view line) {
    const std::string_view keyword = take_word(line);
    if (keyword.empty() || keyword[0] == '#') return;
    if (keyword == "v") return check_vertex(line);
    if (keyword == "f") return check_face(line);
    for (const std::string_view ignored : {"vn", "vt", "o", "g", "s", "usemtl", "mtllib"}) {
      if (keyword == ignored) return;
    }
    fail(fmt::format("{} is not supported in an obj file", in_quotes(keyword)));
  }

  void check_vertex(std::string_view line) {
    ++vertices_;
    int count = 0;
    for (std::string_view word = take_word(line); !word.empty(); word = take_word(line)) {
      double value = 0;
      if (!parses_whole(word, value) || !std::isfinite(value)) {
        fail(fmt::format("{} is not a finite number", in_quotes(word)));
      }
      ++count;
    }
    if (count != 3) fail(fmt::format("a vertex needs three coordinates, not {}", count));
  }

  void check_face(std::string_view line) {
    ++faces_;
    int corners = 0;
    for (std::string_view word = take_word(line); !word.empty(); word = take_word(line)) {
      long long index = 0;
      if (!parses_whole(word.substr(0, word.find('/')), index)) {
        fail(fmt::format("{} is not a vertex of a face", in_quotes(word)));
      }
      if (index < 1 || index > vertices_) {
        fail(fmt::format("vertex {} does not exist: {} stand above this face", index, vertices_));
      }
      ++corners;
    }
    if (corners < 3 || corners > kMaxCorners) {
      fail(fmt::format("a face has 3 to {} vertices, not {}", kMaxCorners, corners));
    }
  }

  std::filesystem::path file_;
  std::string_view text_;
  std::size_t line_number_ = 0;
  long long vertices_ = 0;
  std::size_t faces_ = 0;
};

struct ParsedObj {
  tinyobj::attrib_t attributes;
  std::vector<tinyobj::shape_t> shapes;
};

ParsedObj parse_obj(const std::filesystem::path& file, const std::string& text) {
  ParsedObj parsed;
  std::vector<tinyobj::material_t> materials;
  std::string warning, error;
  std::istringstream in(text);
  const bool ok = tinyobj::LoadObj(&parsed.attributes, &parsed.shapes, &materials, &warning, &error,
                                   &in, nullptr, /*triangulate=*/false,
                                   /*default_vcols_fallback=*/false);
  if (!ok) throw InputError(fmt::format("{}: {}", file.string(), error));
  return parsed;
}

bool has_area(const MeshShape& mesh, const std::array<std::uint32_t, 3>& t) {
  const Vec3d& v0 = mesh.vertices[t[0]];
  const Vec3d normal = cross(mesh.vertices[t[1]] - v0, mesh.vertices[t[2]] - v0);
  return length_squared(normal) > 0;
}

/// Polygons become fans around their first vertex, as in Mitsuba. Triangles without area are left
/// out: no ray meets them and they emit nothing.
void add_fan(const std::vector<std::uint32_t>& corners, MeshShape& mesh) {
  for (std::size_t i = 2; i < corners.size(); ++i) {
    const std::array<std::uint32_t, 3> triangle{corners[0], corners[i - 1], corners[i]};
    if (has_area(mesh, triangle)) mesh.triangles.push_back(triangle);
  }
}

MeshShape make_mesh(const ParsedObj& parsed, const Affine& to_world) {
  MeshShape mesh;
  const auto& coordinates = parsed.attributes.vertices;
  for (std::size_t i = 0; i + 2 < coordinates.size(); i += 3) {
    mesh.vertices.push_back(
        to_world.point({coordinates[i], coordinates[i + 1], coordinates[i + 2]}));
  }
  std::vector<std::uint32_t> corners;
  for (const tinyobj::shape_t& shape : parsed.shapes) {
    std::size_t next = 0;
    for (const auto corner_count : shape.mesh.num_face_vertices) {
      corners.clear();
      for (std::size_t i = 0; i < corner_count; ++i) {
        corners.push_back(static_cast<std::uint32_t>(shape.mesh.indices[next++].vertex_index));
      }
      add_fan(corners, mesh);
    }
  }
  return mesh;
}

}  // namespace

MeshShape read_mesh(const Object& shape) {
  const std::filesystem::path& file = shape[kFilename];
  std::string text;
  try {
    text = read_text_file(file, kMaxMeshBytes);
  } catch (const InputError& error) {
    shape.fail(kFilename, error.what());
  }
  ObjCheck(file, text).run();
  MeshShape mesh = make_mesh(parse_obj(file, text), shape[kToWorld]);
  for (const Vec3d& vertex : mesh.vertices) {
    if (!is_in_range(vertex)) {
      shape.fail(kFilename,
                 fmt::format("{} puts a coordinate beyond {:g}", file.string(), kMaxLength));
    }
  }
  if (mesh.triangles.empty()) {
    shape.fail(kFilename, fmt::format("{} has no triangle with an area", file.string()));
  }
  return mesh;
}

}  // namespace plumbline::renderer
