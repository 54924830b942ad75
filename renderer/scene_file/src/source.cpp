#include "source.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include <plumbline/renderer/scene_file/nearest_name.h>

namespace plumbline::renderer {

InputError Refusal::in(const std::filesystem::path& file, std::string_view text) const {
  const std::string line = offset < 0 ? "" : fmt::format(":{}", line_at(text, offset));
  return InputError(fmt::format("{}{}: {}", file.string(), line, what()));
}

std::size_t line_at(std::string_view text, std::ptrdiff_t offset) {
  return 1 + static_cast<std::size_t>(std::count(text.begin(), text.begin() + offset, '\n'));
}

std::string read_text_file(const std::filesystem::path& file, std::uintmax_t max_bytes) {
  std::string text;
  const auto require = [&](bool good, const std::string& why, std::ptrdiff_t at = kNowhere) {
    if (!good) throw Refusal(at, why).in(file, text);
  };
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  require(status.type() != std::filesystem::file_type::not_found, "there is no such file");
  require(!error, error.message());
  require(!std::filesystem::is_directory(status), "is a directory, not a file");
  require(std::filesystem::is_regular_file(status), "is not a regular file");
  const std::uintmax_t bytes = std::filesystem::file_size(file, error);
  require(!error, error.message());
  require(bytes > 0, "is empty");
  require(
      bytes <= max_bytes,
      fmt::format("has {} bytes, more than the {} that such a file may have", bytes, max_bytes));
  std::ifstream in(file, std::ios::binary);
  require(in.is_open(), fmt::format("cannot be opened: {}", std::strerror(errno)));
  text.resize(bytes);
  in.read(text.data(), static_cast<std::streamsize>(bytes));
  require(in.good(), "cannot be read to its end");
  const std::size_t zero = text.find('\0');
  require(zero == std::string::npos, "holds a zero byte, so it is not UTF-8 text",
          static_cast<std::ptrdiff_t>(zero));
  return text;
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kLongest = 60;
  std::string shown(text.substr(0, kLongest));
  const auto is_control = [](unsigned char c) { return c < 0x20 || c == 0x7f; };
  std::replace_if(shown.begin(), shown.end(), is_control, '?');
  return fmt::format("\"{}{}\"", shown, text.size() > kLongest ? "…" : "");
}

std::string tag_of(Node node) { return fmt::format("<{:.60}>", node.name()); }

std::string label(Node node) {
  for (const char* key : {"name", "type", "id"}) {
    if (const pugi::xml_attribute found = node.attribute(key)) {
      return fmt::format("<{:.60} {}={}>", node.name(), key, in_quotes(found.value()));
    }
  }
  return tag_of(node);
}

void refuse_name(Node at, const std::string& message, std::string_view name,
                 const std::vector<std::string>& known) {
  refuse(at, "{}{}{}", message, known.empty() ? "" : "; ", name_hint(name, known));
}

void refuse_unsupported(Node at, const std::string& message, std::string_view name,
                        const std::vector<std::string>& known) {
  const std::string advice = advice_for(name);
  if (advice.empty()) refuse_name(at, message, name, known);
  refuse(at, "{}: {}", message, advice);
}

std::string attribute(Node node, const char* name) {
  const pugi::xml_attribute found = node.attribute(name);
  if (!found) refuse(node, "{} needs the attribute \"{}\"", label(node), name);
  return found.value();
}

void allow_attributes(Node node, const std::vector<std::string>& allowed) {
  for (const pugi::xml_attribute given : node.attributes()) {
    const std::string name = given.name();
    if (contains(allowed, name)) continue;
    refuse_name(node, fmt::format("{} has no attribute {}", label(node), in_quotes(name)), name,
                allowed);
  }
}

void allow_only_attributes(Node node, const std::vector<std::string>& allowed) {
  allow_attributes(node, allowed);
  if (const Node child = node.first_child()) refuse(child, "{} may hold nothing", label(node));
}

}  // namespace plumbline::renderer
