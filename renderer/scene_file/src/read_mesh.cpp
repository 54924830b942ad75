#include <algorithm>
#include <array>
#include <cmath>

#include "parts.h"

namespace plumbline::renderer {
namespace {

constexpr std::string_view kSpace = " \t";
const std::vector<std::string> kReadOver = {"o", "g", "s", "usemtl", "mtllib"};

struct Line {
  std::ptrdiff_t at = 0;  ///< where it begins in the text
  std::vector<std::string_view> words;

  /// A carriage return elsewhere than at the end is a line break to some programs and none to
  /// others, which would read another mesh.
  void split(std::string_view line) {
    words.clear();
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    if (line.find('\r') != std::string_view::npos) {
      refuse(at, "a carriage return stands within a line: end lines with \\n or \\r\\n");
    }
    while (true) {
      line.remove_prefix(std::min(line.find_first_not_of(kSpace), line.size()));
      if (line.empty()) return;
      words.push_back(line.substr(0, line.find_first_of(kSpace)));
      line.remove_prefix(words.back().size());
    }
  }
};

Vec3d read_vertex(const Line& line) {
  const std::size_t count = line.words.size() - 1;
  if (count != 3) refuse(line.at, "a vertex needs three coordinates, not {}", count);
  std::array<double, 3> p{};
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (parse_whole(line.words[i + 1], p[i]) != std::errc() || !std::isfinite(p[i])) {
      refuse(line.at, "{} is not a finite number", in_quotes(line.words[i + 1]));
    }
  }
  return {p[0], p[1], p[2]};
}

/// What a corner of a face counts: vertices, texture coordinates and normals above the face.
struct Counts {
  std::array<std::size_t, 3> of{};
  static constexpr std::array<const char*, 3> kTags = {"v", "vt", "vn"};
  static constexpr std::array<const char*, 3> kNames = {"vertex", "texture coordinate", "normal"};
};

/// `v`, `v/vt`, `v//vn` or `v/vt/vn`: each of what stands above the face.
/// @return index of the vertex, from 0
std::uint32_t read_corner(const Line& line, std::string_view word, const Counts& counts) {
  std::uint32_t vertex = 0;
  std::string_view rest = word;
  for (std::size_t i = 0; i < counts.of.size(); ++i) {
    const std::string_view digits = rest.substr(0, rest.find('/'));
    const bool is_last = digits.size() == rest.size();
    long long index = 1;
    const bool left_out = i == 1 && digits.empty() && !is_last;
    if (!left_out && parse_whole(digits, index) != std::errc()) break;
    if (!left_out && (index < 1 || index > static_cast<long long>(counts.of[i]))) {
      refuse(line.at, "{} {} does not exist: {} stand above this face{}", Counts::kNames[i], index,
             counts.of[i], index < 0 ? "; count from 1 in place of back from it" : "");
    }
    if (i == 0) vertex = static_cast<std::uint32_t>(index - 1);
    if (is_last) return vertex;
    rest.remove_prefix(digits.size() + 1);
  }
  refuse(line.at, "{} is not a vertex of a face: write v, v/vt, v//vn or v/vt/vn", in_quotes(word));
}

std::vector<std::uint32_t> read_corners(const Line& line, const Counts& counts) {
  std::vector<std::uint32_t> corners;
  for (std::size_t i = 1; i < line.words.size(); ++i) {
    corners.push_back(read_corner(line, line.words[i], counts));
  }
  if (corners.size() < 3 || corners.size() > kMaxFaceCorners) {
    refuse(line.at, "a face has 3 to {} vertices, not {}", kMaxFaceCorners, corners.size());
  }
  return corners;
}

/// Triangles without area are left out: no ray meets them and they emit nothing.
void add_triangle(MeshShape& mesh, const std::array<std::uint32_t, 3>& t) {
  const Vec3d& v0 = mesh.vertices[t[0]];
  const Vec3d normal = cross(mesh.vertices[t[1]] - v0, mesh.vertices[t[2]] - v0);
  if (length_squared(normal) > 0) mesh.triangles.push_back(t);
}

void read_line(const Line& line, const Affine& to_world, Counts& counts, MeshShape& mesh) {
  for (std::size_t i = 0; i < counts.of.size(); ++i) {
    if (line.words[0] == Counts::kTags[i]) ++counts.of[i];
  }
  if (line.words[0] == "v") {
    mesh.vertices.push_back(to_world.point(read_vertex(line)));
  } else if (line.words[0] == "f") {
    const std::vector<std::uint32_t> corners = read_corners(line, counts);
    for (std::size_t i = 2; i < corners.size(); ++i) {
      add_triangle(mesh, {corners[0], corners[i - 1], corners[i]});
    }
  } else if (line.words[0][0] != '#' && line.words[0] != "vt" && line.words[0] != "vn" &&
             !contains(kReadOver, line.words[0])) {
    refuse(line.at, "{} is not supported in an obj file", in_quotes(line.words[0]));
  }
}

/// What it asks for in memory is in proportion to the text.
MeshShape read_obj(std::string_view text, const Affine& to_world) {
  MeshShape mesh;
  Counts counts;
  Line line;  // one for all, as allocations would cost most
  bool has_faces = false;
  for (std::size_t at = 0, end = 0; at < text.size(); at = end + 1) {
    end = std::min(text.find('\n', at), text.size());
    line.at = static_cast<std::ptrdiff_t>(at);
    line.split(text.substr(at, end - at));
    if (line.words.empty()) continue;
    read_line(line, to_world, counts, mesh);
    has_faces |= line.words[0] == "f";
  }
  if (!has_faces) refuse(kNowhere, "holds no faces");
  return mesh;
}

}  // namespace

MeshShape read_mesh(const Object& shape, Reading& in) {
  const std::filesystem::path file = file_of(shape, in);
  in.scene.files.push_back(file);
  std::string text;
  MeshShape mesh;
  try {
    text = read_text_file(file, kMaxMeshBytes);
    mesh = read_obj(text, shape[kToWorld]);
  } catch (const Refusal& refusal) {
    throw refusal.in(file, text);
  } catch (const InputError& error) {
    fail(shape.at(kFilename), "{}", error.what());
  }
  shape.require(std::all_of(mesh.vertices.begin(), mesh.vertices.end(), is_in_range), kFilename,
                "{} puts a coordinate beyond {:g}", file.c_str(), kMaxLength);
  shape.require(!mesh.triangles.empty(), kFilename, "{} has no triangle with an area",
                file.c_str());
  return mesh;
}

}  // namespace plumbline::renderer
