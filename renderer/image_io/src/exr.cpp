#include <plumbline/renderer/image_io/exr.h>

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <ImfVersion.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <new>
#include <string>
#include <system_error>

#include <plumbline/renderer/image_io/budgets.h>

namespace plumbline::renderer {
namespace {

/// OpenEXR swallows write errors in its destructor, where the line table is written. This stream
/// remembers them.
class CheckedStream : public Imf::OStream {
 public:
  explicit CheckedStream(const std::filesystem::path& path)
      : Imf::OStream(path.c_str()), out_(path, std::ios::binary | std::ios::trunc) {}

  bool opened() const { return out_.is_open(); }
  void write(const char c[], int n) override { out_.write(c, n); }
  std::uint64_t tellp() override { return static_cast<std::uint64_t>(out_.tellp()); }
  void seekp(std::uint64_t position) override {
    out_.seekp(static_cast<std::ofstream::off_type>(position));
  }
  bool close() {
    out_.close();
    return !out_.fail();
  }

 private:
  std::ofstream out_;
};

/// OpenEXR takes memory for what an attribute claims before it reads it, and its two readers do not
/// agree on where attributes begin in a damaged header. What is read in one piece of four bytes
/// behind the end of a name is such a claim, or the type of a channel, which is a small number.
class HeaderBudget : public Imf::IStream {
 public:
  explicit HeaderBudget(const std::filesystem::path& path)
      : Imf::IStream(path.c_str()), in_(path, std::ios::binary) {}

  bool read(char c[], int n) override {
    if (!in_.read(c, n)) throw InputError("is cut off");
    std::uint32_t size = 0;
    if (is_behind_name_ && n == sizeof(size)) std::memcpy(&size, c, sizeof(size));
    if (size > kMaxExrAttributeBytes) {
      throw BudgetError("its header has an attribute of " + std::to_string(size) + " bytes");
    }
    is_behind_name_ = n == 1 && *c == 0;
    return true;
  }
  std::uint64_t tellg() override { return static_cast<std::uint64_t>(in_.tellg()); }
  void seekg(std::uint64_t to) override {
    in_.seekg(static_cast<std::ifstream::off_type>(to));
    is_behind_name_ = false;
  }

 private:
  std::ifstream in_;
  bool is_behind_name_ = false;
};

constexpr const char* kColor[] = {"R", "G", "B"};
constexpr const char* kVariance[] = {"variance.R", "variance.G", "variance.B"};
constexpr const char* kCount = "count";

/// Describes one channel of a full-width buffer to OpenEXR, which wants the address of pixel (0, 0)
/// and mutable bytes even for output.
///
/// @param corner  of the window's first pixel: y·width + x
Imf::Slice slice(const float* first, std::size_t stride, int width, std::ptrdiff_t corner = 0) {
  const auto* bytes = reinterpret_cast<const char*>(first);
  return Imf::Slice(Imf::FLOAT,
                    const_cast<char*>(bytes) - corner * static_cast<std::ptrdiff_t>(stride), stride,
                    stride * static_cast<std::size_t>(width));
}

void insert_rgb(Imf::FrameBuffer& buffer, const char* const (&names)[3],
                const std::vector<Rgbf>& pixels, int width, std::ptrdiff_t corner = 0) {
  const Rgbf& first = pixels.front();
  const float* channels[] = {&first.r, &first.g, &first.b};
  for (int i = 0; i < 3; ++i) {
    buffer.insert(names[i], slice(channels[i], sizeof(Rgbf), width, corner));
  }
}

Imf::Header header_of(const Image& image) {
  Imf::Header header(image.width, image.height);
  header.compression() = Imf::ZIPS_COMPRESSION;
  for (const char* name : kColor) header.channels().insert(name, Imf::Channel(Imf::FLOAT));
  if (!image.variance.empty()) {
    for (const char* name : kVariance) header.channels().insert(name, Imf::Channel(Imf::FLOAT));
  }
  if (!image.count.empty()) header.channels().insert(kCount, Imf::Channel(Imf::FLOAT));
  for (const auto& [key, value] : image.metadata) {
    header.insert(key.c_str(), Imf::StringAttribute(value));
  }
  return header;
}

void write_pixels(Imf::OStream& stream, const Image& image) {
  Imf::FrameBuffer buffer;
  insert_rgb(buffer, kColor, image.pixels, image.width);
  if (!image.variance.empty()) insert_rgb(buffer, kVariance, image.variance, image.width);
  if (!image.count.empty()) {
    buffer.insert(kCount, slice(image.count.data(), sizeof(float), image.width));
  }
  Imf::OutputFile file(stream, header_of(image));
  file.setFrameBuffer(buffer);
  file.writePixels(image.height);
}

void check_target(const std::filesystem::path& path) {
  std::error_code ignored;
  const auto status = std::filesystem::status(path, ignored);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
    throw InputError(path.string() + ": not a regular file, refusing to replace it");
  }
}

/// Room for more pixels, by at least as much as there is: in step with what has been decoded, for
/// a file may claim what it does not hold.
template <class T>
void grow(std::vector<T>& values, std::size_t size, std::size_t whole) {
  if (values.capacity() < size) values.reserve(std::min(whole, std::max(size, 2 * values.size())));
  values.resize(size);
}

/// What the reader for C++ takes of the header, before it takes memory for that.
ExrHeader seen_in(HeaderBudget& stream) {
  std::array<std::int32_t, 2> magic_and_version{};
  stream.read(reinterpret_cast<char*>(magic_and_version.data()), sizeof(magic_and_version));
  Imf::Header header;
  header.readFrom(stream, magic_and_version[1]);
  stream.seekg(0);
  const Imath::Box2i& window = header.dataWindow();
  ExrHeader seen{window.min.x, window.min.y, window.max.x, window.max.y, 0, header.compression()};
  for (auto c = header.channels().begin(); c != header.channels().end(); ++c) ++seen.channels;
  if (!Imf::isTiled(magic_and_version[1])) return seen;
  seen.tile_width = header.tileDescription().xSize;
  seen.tile_height = header.tileDescription().ySize;
  return seen;
}

void read_channels(Imf::InputFile& file, Image& image) {
  const Imf::ChannelList& channels = file.header().channels();
  const auto has = [&](const char* name) { return channels.findChannel(name) != nullptr; };
  const bool is_rgb = has("R") && has("G") && has("B");
  if (!is_rgb && !has("Y")) throw InputError("has neither the channels R, G, B nor Y");
  const bool has_variance = has(kVariance[0]) && has(kVariance[1]) && has(kVariance[2]);

  const auto width = static_cast<std::size_t>(image.width);
  const auto whole = width * static_cast<std::size_t>(image.height);
  const Imath::Box2i window = file.header().dataWindow();
  const auto corner = static_cast<std::ptrdiff_t>(window.min.y) * image.width + window.min.x;
  const int strip = static_cast<int>(std::max(kExrStripPixels / image.width, std::int64_t{1}));
  Imf::FrameBuffer buffer;
  for (int done = 0, end = 0; done < image.height; done = end) {
    end = std::min(done + strip, image.height);
    const std::size_t size = width * static_cast<std::size_t>(end);
    grow(image.pixels, size, whole);
    if (is_rgb) {
      insert_rgb(buffer, kColor, image.pixels, image.width, corner);
    } else {
      buffer.insert("Y", slice(&image.pixels.front().r, sizeof(Rgbf), image.width, corner));
    }
    if (has_variance) {
      grow(image.variance, size, whole);
      insert_rgb(buffer, kVariance, image.variance, image.width, corner);
    }
    if (has(kCount)) {
      grow(image.count, size, whole);
      buffer.insert(kCount, slice(image.count.data(), sizeof(float), image.width, corner));
    }
    file.setFrameBuffer(buffer);
    file.readPixels(window.min.y + done, window.min.y + end - 1);
  }
  if (!is_rgb) {
    for (Rgbf& pixel : image.pixels) pixel = {pixel.r, pixel.r, pixel.r};
  }
}

}  // namespace

Image to_image(const Film& film) {
  Image image{film.width(), film.height(), {}, {}, {}, {}};
  image.pixels.reserve(film.pixels().size());
  image.variance.reserve(film.pixels().size());
  image.count.reserve(film.pixels().size());
  for (const PixelMoments& pixel : film.pixels()) {
    image.pixels.push_back(rgb_cast<float>(pixel.mean));
    image.variance.push_back(rgb_cast<float>(pixel.variance()));
    image.count.push_back(static_cast<float>(pixel.count));
  }
  return image;
}

void write_exr(const std::filesystem::path& path, const Image& image) {
  check_target(path);
  CheckedStream stream(path);
  if (!stream.opened()) throw InputError(path.string() + ": cannot be written to");
  try {
    write_pixels(stream, image);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw MachineError(path.string() + ": " + error.what());
  }
  if (!stream.close()) throw MachineError(path.string() + ": writing failed; is the disk full?");
}

Image read_exr(const std::filesystem::path& path) {
  if (!std::filesystem::is_regular_file(path)) {
    throw InputError(path.string() + ": no such image");
  }
  try {
    const ExrHeader claimed = check_exr_claims(path);
    HeaderBudget stream(path);
    if (seen_in(stream) != claimed) throw InputError("has a damaged header");
    Imf::InputFile file(stream);
    const Imath::Box2i window = file.header().dataWindow();
    Image image{window.max.x - window.min.x + 1, window.max.y - window.min.y + 1, {}, {}, {}, {}};
    read_channels(file, image);
    for (auto it = file.header().begin(); it != file.header().end(); ++it) {
      if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&it.attribute())) {
        image.metadata[it.name()] = text->value();
      }
    }
    return image;
  } catch (const BudgetError& error) {
    throw BudgetError(path.string() + ": " + error.what());
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw InputError(path.string() + ": " + error.what());
  }
}

}  // namespace plumbline::renderer
