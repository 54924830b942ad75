#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <system_error>
#include <vector>

#include <plumbline/analytic/known_scene.h>
#include <plumbline/renderer/core/errors.h>
#include <plumbline/renderer/image_io/exr.h>
#include <plumbline/verify/image.h>

#include "command.h"
#include "progress.h"
#include "scene_argument.h"

namespace plumbline::tools {
namespace {

struct CompareArguments {
  std::vector<std::string> images;
  std::string scene;
  double tolerance = 0.01;
  bool exact = false;
  std::optional<int> max_depth;
  std::vector<std::string> definitions;
};

constexpr std::array kChannels = {&renderer::Rgbf::r, &renderer::Rgbf::g, &renderer::Rgbf::b};
constexpr std::array kExactChannels = {&analytic::Colour::r, &analytic::Colour::g,
                                       &analytic::Colour::b};
constexpr std::array kChannelNames = {"R", "G", "B"};

bool is_grey(const renderer::Image& image) {
  for (const renderer::Rgbf& pixel : image.pixels) {
    if (!(pixel.r == pixel.g && pixel.g == pixel.b)) return false;
  }
  return true;
}

/// Whether the image says how noisy it is. One sample has no variance: what the layer holds then is
/// not an estimate.
bool knows_noise(const renderer::Image& image) {
  return !image.variance.empty() && !image.count.empty() &&
         std::all_of(image.count.begin(), image.count.end(),
                     [](float n) { return n >= 2 && n <= 0x1p53f; });
}

/// @param with_noise  whether to keep the variance layer
verify::Image channel(const renderer::Image& image, float renderer::Rgbf::*member,
                      bool with_noise) {
  verify::Image result{image.width, image.height, {}, {}, {}};
  for (const renderer::Rgbf& pixel : image.pixels) {
    result.mean.push_back(static_cast<double>(pixel.*member));
  }
  if (!with_noise) return result;
  for (const renderer::Rgbf& variance : image.variance) {
    result.variance.push_back(static_cast<double>(variance.*member));
  }
  result.count.assign(image.count.begin(), image.count.end());
  return result;
}

/// The closed form of one channel.
verify::Image channel(const std::vector<analytic::Colour>& exact, double analytic::Colour::*member,
                      int width, int height) {
  verify::Image result{width, height, {}, {}, {}};
  for (const analytic::Colour& pixel : exact) result.mean.push_back(pixel.*member);
  return result;
}

std::string header_value(const renderer::Image& image, const std::string& key) {
  const auto found = image.metadata.find(key);
  return found == image.metadata.end() ? std::string() : found->second;
}

/// A whole number that the header states, or nothing where it has none of that name.
///
/// @throws renderer::InputError where it is no whole number, or not between the bounds
std::optional<std::int64_t> header_number(const renderer::Image& image, const std::string& key,
                                          std::int64_t low, std::int64_t high,
                                          const std::string& what_to_do) {
  const std::string text = header_value(image, key);
  if (text.empty()) return std::nullopt;
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error == std::errc() && end == text.data() + text.size() && number >= low && number <= high) {
    return number;
  }
  throw renderer::InputError(
      fmt::format("the image's header has {}={:.40}, not a whole number from "
                  "{} to {}: {}",
                  key, text, low, high, what_to_do));
}

/// Samples that the renderer left out of the image's mean, if its header says so.
std::uint64_t non_finite_samples(const renderer::Image& image) {
  const auto count = header_number(image, "non_finite", 0, std::numeric_limits<std::int64_t>::max(),
                                   "render it again");
  return static_cast<std::uint64_t>(count.value_or(0));
}

int report_verdict(const verify::CheckResult& check) {
  fmt::print("{}", describe(check));
  return check.as_expected() ? kExitFine : kExitUnexpectedVerdict;
}

/// The parameters that an image of ours was rendered with, overridden by -D.
std::map<std::string, std::string> parameters_of(const renderer::Image& image,
                                                 const CompareArguments& arguments) {
  std::map<std::string, std::string> parameters = parse_definitions(arguments.definitions);
  if (header_value(image, "scene") != arguments.scene) return parameters;
  const std::string prefix = "parameter.";
  for (const auto& [key, value] : image.metadata) {
    if (key.rfind(prefix, 0) == 0) parameters.emplace(key.substr(prefix.size()), value);
  }
  return parameters;
}

/// The depth given, else the one that an image of ours was rendered with, else the scene's.
std::optional<int> max_depth_of(const renderer::Image& image, const CompareArguments& arguments) {
  if (arguments.max_depth || header_value(image, "scene") != arguments.scene) {
    return arguments.max_depth;
  }
  constexpr int kDeepest = 1'000'000;  // no path of a render that ends has gone further
  const auto depth =
      header_number(image, "max_depth", -1, kDeepest, "say --max-depth, -1 where it was unlimited");
  return depth ? std::optional(static_cast<int>(*depth)) : std::nullopt;
}

/// The closed form of every pixel: minutes, where it is by quadrature and the image is large.
std::vector<analytic::Colour> exact_image(const analytic::PixelOracle& oracle) {
  const auto [width, height] = oracle.film();
  const std::size_t size = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  Progress progress(0, true);
  std::vector<analytic::Colour> image;
  image.reserve(size);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image.push_back(oracle.pixel_mean(x, y).value);
      progress.update(static_cast<double>(image.size()) / static_cast<double>(size));
    }
  }
  return image;
}

/// Is this image, whoever rendered it, unbiased against the closed form of a known scene?
int compare_with_closed_form(const CompareArguments& arguments) {
  const analytic::KnownScene& scene = known_scene(arguments.scene);
  const renderer::Image image = renderer::read_exr(arguments.images[0]);
  const auto oracle =
      make_oracle(scene, numeric_values(parameters_of(image, arguments)),
                  analytic::FilmSize{image.width, image.height}, max_depth_of(image, arguments));
  const std::vector<analytic::Colour> exact = exact_image(*oracle);
  const bool grey =
      is_grey(image) &&
      std::all_of(exact.begin(), exact.end(), [](const auto& colour) { return colour.is_grey(); });
  verify::ImageOptions options;
  options.tolerance = arguments.tolerance;
  options.non_finite = non_finite_samples(image);
  int exit_code = kExitFine;
  const std::size_t channels = grey ? 1 : kChannels.size();
  for (std::size_t i = 0; i < channels; ++i) {
    options.subject = fmt::format("{} against {}{}{}", arguments.images[0], arguments.scene,
                                  channels == 1 ? "" : ", ", channels == 1 ? "" : kChannelNames[i]);
    const verify::Image seen = channel(image, kChannels[i], knows_noise(image));
    const verify::Image right = channel(exact, kExactChannels[i], image.width, image.height);
    exit_code = std::max(exit_code, report_verdict(check_image(options, seen, right).check));
  }
  return exit_code;
}

void require_same_size(const renderer::Image& a, const renderer::Image& b) {
  if (a.width == b.width && a.height == b.height) return;
  throw renderer::InputError(fmt::format("the images differ in size: {}x{} and {}x{}", a.width,
                                         a.height, b.width, b.height));
}

bool same_bits(float a, float b) {
  return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}

bool same_bits(const renderer::Rgbf& a, const renderer::Rgbf& b) {
  return same_bits(a.r, b.r) && same_bits(a.g, b.g) && same_bits(a.b, b.b);
}

std::string shown(float value) { return fmt::format("{}", value); }
std::string shown(const renderer::Rgbf& p) { return fmt::format("{} {} {}", p.r, p.g, p.b); }

/// What the headers of two images of the same thing may differ in: when, where and by which build
/// they were made. Ours, and what other programs write.
const std::set<std::string> kMayDiffer = {"seconds",  "version", "capDate", "Date",
                                          "date",     "Time",    "time",    "RenderTime",
                                          "Software", "host",    "Host",    "hostname"};

/// Prints in which pixels a layer of two images differs, if it does.
/// @return whether it is the same, bit for bit
template <class T>
bool same_layer(const char* layer, const std::vector<T>& a, const std::vector<T>& b, int width) {
  if (a.size() != b.size()) {
    fmt::print("only the {} image has the layer {}\n", a.empty() ? "second" : "first", layer);
    return false;
  }
  std::size_t different = 0, first = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (same_bits(a[i], b[i])) continue;
    if (different++ == 0) first = i;
  }
  if (different == 0) return true;
  const auto across = static_cast<std::size_t>(width);
  fmt::print("{}: {} of {} pixels differ, the first at ({}, {}): {} and {}\n", layer, different,
             a.size(), first % across, first / across, shown(a[first]), shown(b[first]));
  return false;
}

/// Prints in which texts the headers of two images differ, if they do.
/// @return whether they are the same, but for what may differ
bool same_header(const renderer::Image& a, const renderer::Image& b) {
  bool same = true;
  const auto print_if_not_in = [&](const renderer::Image& one, const renderer::Image& other,
                                   bool swapped) {
    for (const auto& [key, value] : one.metadata) {
      const auto found = other.metadata.find(key);
      const bool there = found != other.metadata.end();
      if (kMayDiffer.count(key) > 0 || (there && (swapped || found->second == value))) continue;
      const std::string second = there ? found->second : "nothing";
      fmt::print("header: {}: {:.60} and {:.60}\n", key, swapped ? second : value,
                 swapped ? value : second);
      same = false;
    }
  };
  print_if_not_in(a, b, false);
  print_if_not_in(b, a, true);
  return same;
}

/// Do two images hold the same in every layer, bit for bit, and in the header?
int compare_exactly(const renderer::Image& a, const renderer::Image& b) {
  bool same = same_layer("R, G, B", a.pixels, b.pixels, a.width);
  same &= same_layer("variance", a.variance, b.variance, a.width);
  same &= same_layer("count", a.count, b.count, a.width);
  same &= same_header(a, b);
  if (!same) return kExitUnexpectedVerdict;
  fmt::print("the images are identical: {} pixels in every layer, bit for bit, and the header\n",
             a.pixels.size());
  return kExitFine;
}

/// Do two renders have the same mean everywhere?
int compare_renders(const CompareArguments& arguments) {
  const renderer::Image a = renderer::read_exr(arguments.images[0]);
  const renderer::Image b = renderer::read_exr(arguments.images[1]);
  require_same_size(a, b);
  if (arguments.exact) return compare_exactly(a, b);
  verify::ImageOptions options;
  options.tolerance = arguments.tolerance;
  options.non_finite = non_finite_samples(a) + non_finite_samples(b);
  // Where one image does not know its noise, the residuals know the noise of both.
  const bool with_noise = knows_noise(a) && knows_noise(b);
  int exit_code = kExitFine;
  const std::size_t channels = is_grey(a) && is_grey(b) ? 1 : kChannels.size();
  for (std::size_t i = 0; i < channels; ++i) {
    options.subject = fmt::format("{} against {}{}{}", arguments.images[0], arguments.images[1],
                                  channels == 1 ? "" : ", ", channels == 1 ? "" : kChannelNames[i]);
    const verify::ImageResult result = check_image(options, channel(a, kChannels[i], with_noise),
                                                   channel(b, kChannels[i], with_noise));
    exit_code = std::max(exit_code, report_verdict(result.check));
  }
  return exit_code;
}

int run_compare(const CompareArguments& arguments) {
  const bool with_scene = !arguments.scene.empty();
  if (with_scene == (arguments.images.size() == 2)) {
    throw renderer::InputError("compare needs either two images, or one image and --scene");
  }
  if (!with_scene && (!arguments.definitions.empty() || arguments.max_depth)) {
    throw renderer::InputError("-D and --max-depth belong to --scene");
  }
  if (with_scene && arguments.exact) {
    throw renderer::InputError("--exact compares two images, not an image with a scene");
  }
  return with_scene ? compare_with_closed_form(arguments) : compare_renders(arguments);
}

}  // namespace

void add_compare_command(options::CommandLine& line) {
  const auto arguments = std::make_shared<CompareArguments>();
  options::Command command =
      line.add_command("compare", "Hold an image against a closed form, or against another image");
  command.add("images", arguments->images, "One image with --scene, or two images")
      .required()
      .count(1, 2)
      .type("");
  command.add("--scene", arguments->scene, "Known scene whose closed form is the reference")
      .type("NAME");
  command
      .add("--tolerance", arguments->tolerance,
           "Largest relative bias that passes; 0.01 without it")
      .positive_number()
      .type("E");
  command.add_flag("--exact", arguments->exact,
                   "Two images must be equal bit for bit in every layer, and in the header");
  command
      .add("--max-depth", arguments->max_depth,
           "Depth that the image was rendered with, if not the scene's")
      .whole_number(-1, std::numeric_limits<int>::max())
      .type("N");
  command
      .add("-D", arguments->definitions,
           "Value that the image was rendered with, if not the scene's; repeatable")
      .one_value_each()
      .type("NAME=VALUE");
  command.footer(fmt::format(
      R"(Images of plumbline carry their parameters and depth in the header; others need -D and --max-depth
where they differ from the scene file. --exact compares R, G, B, variance and count, and every text of the
header but for when, where and by which build it was made:
{}.

Examples:
  plumbline compare image.exr --scene furnace_sphere --tolerance 0.005
  plumbline compare mis.exr light.exr
  plumbline compare before.exr after.exr --exact)",
      fmt::join(kMayDiffer, ", ")));
  command.runs([arguments] { return run_compare(*arguments); });
}

}  // namespace plumbline::tools
