#include <plumbline/output/checkpoint.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <charconv>
#include <cstddef>
#include <fstream>
#include <istream>
#include <ostream>
#include <span>
#include <sstream>
#include <string_view>
#include <type_traits>
#include <utility>

#include <plumbline/output/failure.h>
#include <plumbline/renderer/core/errors.h>
#include <plumbline/renderer/image_io/budgets.h>

#include "hash.h"

namespace plumbline::output {
namespace {

namespace fs = std::filesystem;
using renderer::PixelMoments;
using renderer::RenderState;

constexpr std::string_view kFormat = "plumbline.checkpoint/2";

// All that goes on from there is kept, in the order of memory, and read by the same kind of
// machine.
static_assert(std::endian::native == std::endian::little);
static_assert(std::is_trivially_copyable_v<PixelMoments> && sizeof(PixelMoments) == 56,
              "another field of the moments is another format");
static_assert(std::is_trivially_copyable_v<renderer::PathCounters>);

/// Told from other texts in a row.
void add_text(Hash& hash, std::string_view text) {
  hash.add(fmt::format("{}:", text.size()));
  hash.add(text);
}

template <class T>
std::string_view bytes_of(std::span<const T> values) {
  return {reinterpret_cast<const char*>(values.data()), values.size_bytes()};
}

template <class T>
std::string_view bytes_of(const T& value) {
  return bytes_of(std::span<const T>(&value, 1));
}

class Writer {
 public:
  explicit Writer(std::ostream& out) : out_(out) {}

  void put(std::string_view bytes) {
    hash_.add(bytes);
    out_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  }

  void finish() {
    const std::uint64_t hash = hash_.value();
    put(bytes_of(hash));
  }

 private:
  std::ostream& out_;
  Hash hash_;
};

/// A file that is read, and its size.
struct OpenFile {
  explicit OpenFile(const fs::path& path) : stream(path, std::ios::binary) {
    if (!stream) throw_errno(path.string(), "cannot be read", errno);
    std::error_code error;
    bytes = fs::file_size(path, error);
    if (error) throw_errno(path.string(), "cannot be read", error.value());
  }

  std::ifstream stream;
  std::uintmax_t bytes = 0;
};

class Reader {
 public:
  /// @param name   for messages
  /// @param bytes  all that there are
  Reader(std::istream& in, std::string name, std::uintmax_t bytes)
      : name_(std::move(name)), in_(in), left_(bytes) {}

  [[noreturn]] void refuse(const std::string& why) const {
    throw renderer::InputError(fmt::format("{}: {}", name_, why));
  }

  std::string line() {
    std::string text;
    constexpr std::size_t kLongest = 1 << 16;
    for (char c = 0; text.size() < kLongest && in_.get(c);) {
      --left_;
      if (c == '\n') {
        hash_.add(text + c);
        return text;
      }
      text += c;
    }
    refuse("is no checkpoint, or torn");
  }

  /// Memory is taken for what the file has alone.
  template <class T>
  std::vector<T> values(std::uint64_t count) {
    if (count > left_ / sizeof(T)) refuse("is torn: it ends too soon");
    std::vector<T> values(count);
    read(std::as_writable_bytes(std::span(values)));
    return values;
  }

  template <class T>
  T value() {
    return values<T>(1).front();
  }

  void finish() {
    const std::uint64_t hash = hash_.value();
    if (value<std::uint64_t>() != hash || left_ != 0) refuse("is torn, or was changed");
  }

 private:
  void read(std::span<std::byte> bytes) {
    in_.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    if (!in_) refuse("cannot be read to its end");
    left_ -= bytes.size();
    hash_.add({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  }

  std::string name_;
  std::istream& in_;
  std::uintmax_t left_;
  Hash hash_;
};

/// How many there are of each, before them.
struct Counts {
  std::uint32_t width = 0, height = 0;
  std::uint64_t nets = 0, bsdf_counts = 0, needs = 0;  // of all pixels
};

CheckpointSettings read_settings(Reader& in) {
  if (in.line() != kFormat) in.refuse("is no checkpoint of this version of the format");
  CheckpointSettings settings;
  for (std::string line = in.line(); !line.empty(); line = in.line()) {
    const std::size_t equals = line.find('=');
    if (equals == std::string::npos) in.refuse("is no checkpoint, or was changed");
    settings[line.substr(0, equals)] = line.substr(equals + 1);
  }
  return settings;
}

/// A name or value in one line.
std::string in_line(std::string text) {
  for (char& c : text) {
    if (c == '\n') c = ' ';
  }
  return text;
}

void put_settings(Writer& out, const CheckpointSettings& settings) {
  out.put(fmt::format("{}\n", kFormat));
  for (const auto& [name, value] : settings) {
    out.put(fmt::format("{}={}\n", in_line(name), in_line(value)));
  }
  out.put("\n");
}

void put_state(Writer& out, const RenderState& state) {
  const Counts counts{
      static_cast<std::uint32_t>(state.width), static_cast<std::uint32_t>(state.height),
      std::uint64_t{state.nets} * state.drawn.size(), state.bsdf_counts.size(), state.needs.size()};
  out.put(bytes_of(counts));
  out.put(bytes_of(std::span<const std::uint32_t>(state.drawn)));
  out.put(bytes_of(std::span<const PixelMoments>(state.moments)));
  out.put(bytes_of(std::span<const std::uint32_t>(state.bsdf_counts)));
  out.put(bytes_of(std::span<const renderer::SampleNeed>(state.needs)));
  out.put(bytes_of(state.counters));
  out.put(bytes_of(state.seconds));
}

RenderState read_state(Reader& in, const Counts& counts) {
  const std::uint64_t pixels = std::uint64_t{counts.width} * counts.height;
  const std::uint64_t nets = pixels > 0 ? counts.nets / pixels : 0;
  if (nets * pixels != counts.nets || nets > std::numeric_limits<std::uint32_t>::max()) {
    in.refuse("does not hold what it says");
  }
  RenderState state;
  state.width = static_cast<int>(counts.width);
  state.height = static_cast<int>(counts.height);
  state.nets = static_cast<std::uint32_t>(nets);
  state.drawn = in.values<std::uint32_t>(pixels);
  state.moments = in.values<PixelMoments>(std::max(counts.nets, pixels));
  state.bsdf_counts = in.values<std::uint32_t>(counts.bsdf_counts);
  state.needs = in.values<renderer::SampleNeed>(counts.needs);
  state.counters = in.value<renderer::PathCounters>();
  state.seconds = in.value<double>();
  return state;
}

}  // namespace

std::uint32_t most_drawn(const std::vector<std::uint32_t>& drawn) {
  std::uint32_t most = 0;
  for (const std::uint32_t samples : drawn) {
    if (is_here(samples)) most = std::max(most, samples);
  }
  return most;
}

void write_checkpoint(const fs::path& path, const CheckpointSettings& settings,
                      const RenderState& state) {
  std::ofstream file(path, std::ios::binary);
  if (!file) throw_errno(path.string(), "cannot be written to", errno);
  Writer out(file);
  put_settings(out, settings);
  put_state(out, state);
  out.finish();
  file.close();
  if (!file) throw renderer::MachineError(path.string() + ": cannot be written; is the disk full?");
}

CheckpointSettings read_checkpoint_settings(const fs::path& path) {
  OpenFile file(path);
  Reader in(file.stream, path.string(), file.bytes);
  return read_settings(in);
}

Checkpoint read_checkpoint(const fs::path& path) {
  OpenFile file(path);
  Reader in(file.stream, path.string(), file.bytes);
  Checkpoint checkpoint;
  checkpoint.settings = read_settings(in);
  const auto counts = in.value<Counts>();
  constexpr std::uint32_t kMaxSide = renderer::kMaxImageSide;
  if (counts.width > kMaxSide || counts.height > kMaxSide) in.refuse("has an unreasonable size");
  checkpoint.state = read_state(in, counts);
  in.finish();
  return checkpoint;
}

std::string bytes_of_state(const RenderState& state) {
  std::ostringstream bytes;
  Writer out(bytes);
  put_state(out, state);
  out.finish();
  return std::move(bytes).str();
}

std::string bytes_of_settings(const CheckpointSettings& settings) {
  std::ostringstream bytes;
  Writer out(bytes);
  put_settings(out, settings);
  return std::move(bytes).str();
}

CheckpointSettings settings_of_bytes(const std::string& bytes) {
  std::istringstream stream(bytes);
  Reader in(stream, "settings of a render", bytes.size());
  return read_settings(in);
}

RenderState state_of_bytes(const std::string& bytes) {
  std::istringstream stream(bytes);
  Reader in(stream, "a part of a render", bytes.size());
  RenderState state = read_state(in, in.value<Counts>());
  in.finish();
  return state;
}

void require_same(const fs::path& path, const CheckpointSettings& kept,
                  const CheckpointSettings& given) {
  std::string differences;
  const auto differs = [&](const std::string& name, const std::string& a, const std::string& b) {
    differences += fmt::format("\n  {}: kept of {}, asked for {}", name, a, b);
  };
  for (const auto& [name, value] : given) {
    const auto found = kept.find(name);
    if (found == kept.end()) {
      differs(name, "none", value);
    } else if (found->second != in_line(value)) {
      differs(name, found->second, value);
    }
  }
  for (const auto& [name, value] : kept) {
    if (!given.contains(name)) differs(name, value, "none");
  }
  if (differences.empty()) return;
  throw renderer::InputError(
      fmt::format("{}: is of another render:{}", path.string(), differences));
}

std::uint64_t content_hash(const std::vector<fs::path>& files,
                           const std::map<std::string, std::string>& parameters) {
  Hash hash;
  for (const fs::path& file : files) {
    std::ifstream in(file, std::ios::binary);
    if (!in) throw_errno(file.string(), "cannot be read", errno);
    std::array<char, 1 << 16> buffer;
    std::uint64_t size = 0;
    while (in.read(buffer.data(), buffer.size()), in.gcount() > 0) {
      hash.add({buffer.data(), static_cast<std::size_t>(in.gcount())});
      size += static_cast<std::uint64_t>(in.gcount());
    }
    add_text(hash, fmt::format("{} bytes", size));
  }
  for (const auto& [name, value] : parameters) {
    add_text(hash, name);
    add_text(hash, value);
  }
  return hash.value();
}

}  // namespace plumbline::output
