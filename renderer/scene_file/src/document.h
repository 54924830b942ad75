#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include "node.h"

namespace plumbline::renderer {

/// The whole of a regular text file. Pipes and devices are refused: they may never end.
///
/// @throws InputError "file: why" where it is missing, not a regular file, not readable, empty,
///         larger than `max_bytes`, or holds a zero byte
std::string read_text_file(const std::filesystem::path& file, std::uintmax_t max_bytes);

/// @return line that holds the offset, counted from 1
std::size_t line_at(std::string_view text, std::size_t offset);

/// Bytes of a scene file, and of the parameters put into one.
inline constexpr std::size_t kMaxSceneBytes = std::size_t{16} << 20;

/// A well-formed XML file of bounded size and depth, without anything that reaches outside it
/// (document types, entities, processing instructions).
class Document {
 public:
  /// @param overrides  values for its <default> parameters
  /// @throws Refusal for what is no such file
  Document(std::string_view text, std::map<std::string, std::string> overrides);

  Node root() const { return xml_.document_element(); }

  /// To be called for one child of the root after the other, before it is read: puts parameters in,
  /// so that they hold from their <default> on, and registers ids.
  void prepare(Node node);

  /// To be called when the file has been read.
  /// @throws Refusal if an override has had no effect
  void check_overrides() const;

  /// Every <default> so far with the value in force.
  const std::map<std::string, std::string>& parameters() const { return parameters_; }

  /// Elements so far by their id, which only they have.
  const std::map<std::string, Node>& ids() const { return ids_; }

 private:
  void declare(Node node);
  void put_parameters_in(Node node);
  std::string with_parameters(Node node, std::string_view text);
  void register_id(Node node);

  std::string_view text_;
  pugi::xml_document xml_;
  std::map<std::string, std::string> parameters_;
  std::map<std::string, std::string> overrides_;  ///< that nothing has used
  std::size_t put_in_ = 0;                        ///< by parameters [bytes]
  std::map<std::string, Node> ids_;
};

}  // namespace plumbline::renderer
