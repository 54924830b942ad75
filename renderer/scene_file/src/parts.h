#pragma once

#include <algorithm>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <tuple>

#include <plumbline/renderer/assembly/bsdf.h>
#include <plumbline/renderer/assembly/description.h>
#include <plumbline/renderer/image_io/budgets.h>

#include "object.h"

/// The parts of a scene file: the types of each element, and the scene that they are put into.
namespace plumbline::renderer {

/// What those that nest a BSDF need to know of it.
struct BsdfContext {
  double ext_ior = 1;     ///< index outside
  double int_ior = 1e30;  ///< index inside, of a dielectric
  int depth = 0;          ///< levels of BSDFs below it
};

/// A scene file, or one that it includes.
struct Source {
  std::filesystem::path file;
  std::string text;
  pugi::xml_document xml = {};
  std::ptrdiff_t at = 0;  ///< up to where lines have been counted
  std::size_t line = 1;   ///< there

  /// Of elements in the order of the file: the text is gone through once.
  std::size_t line_of(Node node) {
    const auto from = text.begin() + at, to = text.begin() + node.offset_debug();
    line += static_cast<std::size_t>(std::count(from, to, '\n'));
    at = node.offset_debug();
    return line;
  }
};

/// The camera's planes that clip in Mitsuba and not here, with what gives them [m].
struct Clips {
  std::optional<std::pair<Node, double>> near, far;
};

/// What is wrong, with the source and the offset in it for the order.
using Problem = std::tuple<std::size_t, std::ptrdiff_t, std::string>;

/// A scene as far as it has been read.
struct Reading {
  std::map<std::string, std::string> overrides;  ///< of parameters, as far as nothing has used them
  std::optional<FilmSize> size;                  ///< in place of the file's
  std::optional<std::set<Problem>> problems;  ///< where all are to be found, not the first thrown
  std::vector<std::unique_ptr<Source>> sources = {};  ///< the scene file, then what it includes
  std::vector<std::filesystem::path> including = {};  ///< files that are being read, outer first
  std::vector<std::filesystem::path> folders = {};    ///< of <path>s
  std::size_t bytes = 0;                              ///< of the sources
  std::size_t put_in = 0;                             ///< by parameters [bytes]
  std::map<std::string, Node> ids = {};               ///< elements, by the id that only they have
  std::set<std::string> once = {};                    ///< tags of elements that a scene has once
  Clips clips = {};
  SceneDescription scene = {};
  std::shared_ptr<BsdfSet> bsdfs = std::make_shared<BsdfSet>();  ///< nested ones before their nests
  std::vector<BsdfContext> contexts = {};                        ///< of each BSDF
  std::map<std::string, std::uint32_t> bsdfs_by_id = {};
  std::optional<std::uint32_t> default_bsdf = {};             ///< of shapes without one
  std::vector<std::pair<std::size_t, Node>> references = {};  ///< shapes with their <ref>s

  /// Says of a shape or light where it stands.
  template <class Described>
  void place(Node node, Described& described) {
    const std::size_t source = source_of(node.root());
    described.line = sources[source]->line_of(node);
    if (source > 0) described.file = sources[source]->file;
  }

  /// Which of the sources an element or a refusal is of.
  std::size_t source_of(Node document) const;

  /// "file:line: why"
  InputError error_of(const Refusal& refusal) const;

  /// @return its index
  std::uint32_t add_bsdf(Bsdf bsdf, const BsdfContext& context = {}) {
    contexts.push_back(context);
    return bsdfs->add(std::move(bsdf));
  }
};

/// Does a part of the reading. Where all problems are to be found, one in it is noted.
///
/// @return whether there was none
template <class Part>
bool attempt(Reading& in, const Part& part) {
  if (!in.problems) return part(), true;
  try {
    return part(), true;
  } catch (const Refusal& refusal) {
    if (in.problems->size() == kMaxProblems) return false;
    in.problems->emplace(in.source_of(refusal.document), refusal.offset,
                         in.error_of(refusal).what());
  } catch (const InputError& error) {
    if (in.problems->size() < kMaxProblems) {
      in.problems->emplace(in.sources.size(), 0, error.what());
    }
  }
  return false;
}

// What a scene file may hold, by element: every type with its properties and its reader.
extern const Named<ObjectType> kIntegratorTypes, kSensorTypes, kFilmTypes, kFilterTypes,
    kSamplerTypes, kBsdfTypes, kShapeTypes, kAreaEmitterTypes, kSceneEmitterTypes;

inline const Property kFilename{kString, "filename", kRequired};
inline const Property kToWorld{kTransform, "to_world", "identity"};

/// A file by its name in a scene: from the folders of <path>s, the last first, or from the scene
/// file's.
std::filesystem::path find_file(const std::string& name, const Reading& in);

/// The file that an object names.
std::filesystem::path file_of(const Object& object, const Reading& in);

/// @return why a film of that size is refused; empty if it is not
std::string film_size_error(const FilmSize& size);

/// Reads a <bsdf> and those in it.
/// @return its index
std::uint32_t read_bsdf(Node node, Reading& in);

/// Index of the BSDF that a <ref> names, among those read.
///
/// @param where  for the message: where it was looked for
/// @throws Refusal if there is none with its id
std::uint32_t resolve_bsdf(Node ref, const Reading& in, const char* where = "");

/// Reads a <shape> with what it holds. Its <ref> to a BSDF may stand before that: it is resolved
/// when all is read.
void read_shape(Node node, Reading& in);

/// The triangles of the obj file that a shape names, moved to world space.
///
/// @throws InputError "file:line: why" for what is wrong in the file; else it is the shape's error
MeshShape read_mesh(const Object& shape, Reading& in);

/// Refuses planes of the camera that would clip something.
void check_clipping(const Reading& in);

/// Largest coordinate and length [m]; 1/kMaxLength is the smallest length. Squares of both are
/// normal numbers in single precision.
inline constexpr double kMaxLength = 1e18;

/// Largest distance of a shape from the origin of the file, in its own sizes: 1e-5 of its size is
/// what double precision rounds there.
inline constexpr double kMaxDistance = 1e11;

/// Whether single precision can work with a point.
bool is_in_range(const Vec3d& point);

}  // namespace plumbline::renderer
