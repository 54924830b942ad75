#include <gtest/gtest.h>

#include <array>
#include <bitset>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <plumbline/renderer/assembly/description.h>
#include <plumbline/renderer/assembly/names.h>
#include <plumbline/renderer/assembly/render.h>
#include <plumbline/renderer/core/sampling/sampler.h>
#include <plumbline/verify/mean.h>
#include <plumbline/verify/pair.h>
#include <plumbline_tests/support.h>
#include "net_law.h"
#include "scenes.h"

/// Nets as dealt by the render loop are as good as nets are: N·Var of the mean of N points is what
/// the theory of nested scrambling says, for every pixel, and what pairs of one sample have to do
/// with each other is what shuffling leaves. Squares of errors are averaged, never errors, whose
/// signs could cancel between nets.
namespace plumbline::tests {
namespace {

using renderer::Backend;
using renderer::Sampler;
using renderer::SamplerType;
using renderer::Vec2f;
using verify::Verdict;

/// The band that efficiency is held to: a loss of 15 % fails, and so does a gain, which asks for a
/// new number here.
constexpr double kBand = 0.15;

/// Whether squared errors over what they must be on the average have the mean 1.
///
/// @param ratio  of the i-th net, or pixel
void expect_law(const std::string& subject, const std::function<double(std::uint64_t)>& ratio,
                Verdict expected = Verdict::pass) {
  verify::MeanOptions options;
  options.subject = subject;
  options.reference = 1;
  options.tolerance = kBand;
  // Of 1,024 points the error of a pixel is 6e-6 of its value, and each sample is rounded at 6e-8.
  options.rounding_allowance = 1e-2;
  options.max_samples = 1 << 15;
  options.expected = expected;
  options.seed = check_seed(subject);
  expect_verdict(check_mean(options, [&](std::uint64_t begin, std::uint64_t count) {
    verify::Moments moments;
    for (std::uint64_t i = begin; i < begin + count; ++i) moments.add(ratio(i));
    return moments;
  }));
}

/// A scene, and what nets of each of its pixels must vary by.
struct KnownImage {
  renderer::Scene scene;
  std::vector<NetLaw> laws;  ///< by pixel
};

constexpr int kSide = 4;  // of the images [pixels]
constexpr std::size_t kPixels = kSide * kSide;

/// The floor z = 0, with the camera 1 m above the origin.
///
/// @param half_width  that the image shows [m]; left in it is −x, down −y
renderer::SceneDescription floor_from_above(double half_width) {
  renderer::SceneDescription scene = empty_scene(kSide, kSide);
  scene.camera.origin = {0, 0, 1};
  scene.camera.forward = {0, 0, -1};
  scene.camera.tan_half_fov_x = half_width;
  scene.shapes.push_back(
      {renderer::RectangleShape{{-2, -2, 0}, {4, 0, 0}, {0, 4, 0}, false}, 0, {}, false, false});
  return scene;
}

const renderer::Vec3d kLamp{0.3, -0.2, 0.6};  // [m]

/// Under a lamp without size: albedo/π · I cosθ/d² = albedo/π · I h/d³ at the place (x, y) of a
/// pixel.
double under_lamp(std::size_t pixel, double x, double y) {
  const auto column = static_cast<double>(pixel % kSide);
  const auto row = static_cast<double>(pixel / kSide);
  const double across = 2 * (column + x) / kSide - 1, up = 1 - 2 * (row + y) / kSide;
  const double square = length_squared(kLamp - renderer::Vec3d{across, up, 0});
  return 0.5 * kLamp.z / (square * std::sqrt(square));
}

/// Radiance is a smooth function of the place in the image, and of no other random number.
KnownImage lamp_over_floor() {
  renderer::SceneDescription scene = floor_from_above(1);
  const double intensity = renderer::pi<double>();
  scene.points.push_back({kLamp, {intensity, intensity, intensity}});
  KnownImage image{renderer::make_scene(scene), {}};
  for (std::size_t pixel = 0; pixel < kPixels; ++pixel) {
    image.laws.emplace_back([&](double x, double y) { return under_lamp(pixel, x, y); });
  }
  return image;
}

/// Two windows of 1 m² above the floor, of which every sample is on one: all pixels see one spot,
/// and radiance is a function of the second pair of numbers. Each half of the first number, spread
/// out again, is a number on one window.
KnownImage windows_over_floor() {
  const std::array<renderer::Vec3d, 2> corners{{{0.5, -0.5, 1.2}, {-1.6, -0.3, 0.8}}};
  renderer::SceneDescription scene = floor_from_above(1e-5);
  for (const renderer::Vec3d& corner : corners) {
    scene.shapes.push_back({renderer::RectangleShape{corner, {1, 0, 0}, {0, 1, 0}, true}, 0,
                            renderer::Rgbd{1, 1, 1}, false, false});
  }
  // albedo/π · cosθ cosθ_light/d² over the density, half a window.
  const NetLaw law([&](double x, double y) {
    const renderer::Vec3d& corner = corners[x < 0.5 ? 0 : 1];
    const renderer::Vec3d point = corner + renderer::Vec3d{2 * x - (x < 0.5 ? 0 : 1), y, 0};
    return 2 * 0.5 / renderer::pi<double>() * renderer::sqr(point.z / length_squared(point));
  });
  return {renderer::make_scene(scene), std::vector<NetLaw>(kPixels, law)};
}

struct Dealing {
  std::size_t log_points;  ///< of a replicate
  std::uint32_t replicates;
  Backend backend;
};

/// Pixels of images with consecutive seeds, over what their nets must vary by.
class DealtPixels {
 public:
  DealtPixels(const KnownImage& image, const Dealing& dealing, std::uint64_t seed)
      : image_(image), dealing_(dealing), seed_(seed) {}

  /// The variance that a pixel states of its replicates; NaN, which fails, where some are missing.
  double stated(std::uint64_t i) {
    const renderer::PixelMoments& pixel = pixel_at(i);
    if (pixel.count != dealing_.replicates) return std::numeric_limits<double>::quiet_NaN();
    return pixel.variance().g * points() / law_of(i).of_net(dealing_.log_points);
  }

  /// The squared error of a pixel.
  double seen(std::uint64_t i) {
    const renderer::PixelMoments& pixel = pixel_at(i);
    const double error = pixel.mean.g - law_of(i).mean();
    return error * error * dealing_.replicates * points() / law_of(i).of_net(dealing_.log_points);
  }

 private:
  double points() const { return std::ldexp(1.0, static_cast<int>(dealing_.log_points)); }
  const NetLaw& law_of(std::uint64_t i) const { return image_.laws[i % kPixels]; }

  const renderer::PixelMoments& pixel_at(std::uint64_t i) {
    while (pixels_.size() <= i) {
      renderer::RenderOptions options;
      options.path.strategy = renderer::Strategy::light;
      options.path.max_depth = 2;
      options.samples_per_pixel = dealing_.replicates << dealing_.log_points;
      options.sampler = SamplerType::sobol;
      options.replicates = dealing_.replicates;
      options.seed = seed_ + pixels_.size();
      options.threads = 2;
      options.backend = dealing_.backend;
      const renderer::Film film = render(image_.scene, options).film;
      pixels_.insert(pixels_.end(), film.pixels().begin(), film.pixels().end());
    }
    return pixels_[i];
  }

  const KnownImage& image_;
  Dealing dealing_;
  std::uint64_t seed_;
  std::vector<renderer::PixelMoments> pixels_;
};

void expect_law_of_nets(const std::string& what, const KnownImage& image, const Dealing& dealing) {
  std::string subject = what + "/" + std::to_string(dealing.replicates) + " of ";
  subject.append(std::to_string(1u << dealing.log_points)).append(" points/");
  subject.append(name(dealing.backend));
  DealtPixels pixels(image, dealing, check_seed(subject));
  expect_law(subject + "/between replicates", [&](std::uint64_t i) { return pixels.stated(i); });
  expect_law(subject + "/squared error", [&](std::uint64_t i) { return pixels.seen(i); });
}

TEST(RenderedNets, ReplicatesAndTheirMeanVaryAsNestedScramblingSays) {
  const KnownImage image = lamp_over_floor();
  for (const Dealing& dealing :
       {Dealing{4, 4, Backend::batched}, Dealing{6, 3, Backend::scalar},
        Dealing{8, 4, Backend::batched}, Dealing{10, 2, Backend::batched}}) {
    expect_law_of_nets("rendered nets", image, dealing);
  }
}

TEST(RenderedNets, EachOfTwoLightsGetsANetOfItsOwn) {
  const KnownImage image = windows_over_floor();
  for (const Dealing& dealing : {Dealing{4, 3, Backend::scalar}, Dealing{8, 2, Backend::batched}}) {
    expect_law_of_nets("nets on two lights", image, dealing);
  }
}

/// Sobol' points under Owen's scrambling by the book: each digit is flipped by a coin of its own
/// for every way that the digits before it can be. Shares no code with the renderer's.
class NetByTheBook {
 public:
  /// @param m  2^m points at most
  NetByTheBook(std::size_t m, verify::Random& random) : m_(m), random_(random) {
    for (auto& axis : flips_) {
      for (std::size_t i = 0; i < std::size_t{1} << m; ++i)
        axis.push_back((random.bits() & 1) != 0);
    }
  }

  std::array<double, 2> point(std::size_t index) {
    std::array<double, 2> result{};
    for (std::size_t axis = 0; axis < 2; ++axis) {
      std::size_t path = 1;  // the digits so far, behind a 1
      for (std::size_t digit = 0; digit < m_; ++digit) {
        const bool one = (axis == 0 ? (index >> digit & 1) != 0 : second(index, digit));
        const bool flipped = one != flips_[axis][path];
        result[axis] += flipped ? std::ldexp(1.0, -1 - static_cast<int>(digit)) : 0;
        path = 2 * path + (one ? 1 : 0);
      }
      result[axis] += std::ldexp(random_.uniform(), -static_cast<int>(m_));
    }
    return result;
  }

 private:
  /// Row `digit` of Pascal's triangle mod 2: C(k, digit) is odd where k has all bits of `digit`.
  bool second(std::size_t index, std::size_t digit) const {
    bool odd = false;
    for (std::size_t k = digit; k < m_; ++k) {
      odd = odd != ((index >> k & 1) != 0 && (k & digit) == digit);
    }
    return odd;
  }

  std::size_t m_;
  verify::Random& random_;
  std::array<std::vector<bool>, 2> flips_;
};

/// The squared error of every `stride`-th point of a net, 2^m of them, over the law.
double squared_error_by_the_book(std::size_t m, std::size_t log_stride, std::uint64_t seed,
                                 std::uint64_t i) {
  constexpr std::size_t kPixel = 6;
  static const NetLaw law([](double x, double y) { return under_lamp(kPixel, x, y); });
  verify::Random random(seed, i);
  NetByTheBook net(m + log_stride, random);
  double sum = 0;
  const std::size_t points = std::size_t{1} << m;
  for (std::size_t k = 0; k < points; ++k) {
    const auto p = net.point(k << log_stride);
    sum += under_lamp(kPixel, p[0], p[1]);
  }
  const auto n = static_cast<double>(points);
  const double error = sum / n - law.mean();
  return error * error * n / law.of_net(m);
}

TEST(NetLaw, HoldsForNetsByTheBookAndNotWherePointsAreSkipped) {
  for (const std::size_t m : {0u, 1u, 4u, 7u}) {
    const std::string subject = "nets by the book/" + std::to_string(1u << m);
    const std::uint64_t seed = check_seed(subject);
    expect_law(subject, [&](std::uint64_t i) { return squared_error_by_the_book(m, 0, seed, i); });
  }
  const std::uint64_t seed = check_seed("skipped points");
  expect_law(
      "control/16 points of a net, every other one skipped",
      [&](std::uint64_t i) { return squared_error_by_the_book(4, 1, seed, i); }, Verdict::fail);
}

/// The signs that the digits of two padded pairs have together, over one net of 1,024 points.
class DigitsOfPairs {
 public:
  static constexpr std::size_t kDigits = 10;

  DigitsOfPairs(std::uint64_t seed, std::uint64_t net) {
    for (std::size_t i = 0; i < kPoints; ++i) {
      Sampler random(SamplerType::sobol, seed, net, i);
      for (auto& pair : digits_) {
        const Vec2f u = random.next_2d();
        for (std::size_t axis = 0; axis < 2; ++axis) {
          const auto bits =
              static_cast<std::uint32_t>((axis == 0 ? u.x : u.y) * static_cast<float>(kPoints));
          for (std::size_t digit = 0; digit < kDigits; ++digit) {
            pair[axis][digit][i] = (bits >> (kDigits - 1 - digit) & 1) != 0;
          }
        }
      }
    }
  }

  /// N times the squared mean over the net of the product of two signs, (−1)^digit, one of each
  /// pair; the mean over all pairs of pairs and of axes.
  double squared_mean(std::size_t first, std::size_t second) const {
    double sum = 0;
    for (const auto& [p, q] : {std::pair{0, 1}, std::pair{0, 2}, std::pair{1, 2}}) {
      for (const auto& a : digits_[static_cast<std::size_t>(p)]) {
        for (const auto& b : digits_[static_cast<std::size_t>(q)]) {
          const auto unlike = static_cast<double>((a[first] ^ b[second]).count());
          const double mean = 1 - 2 * unlike / kPoints;
          sum += kPoints * mean * mean / 12;
        }
      }
    }
    return sum;
  }

 private:
  static constexpr std::size_t kPoints = 1u << kDigits;
  using Pair = std::array<std::array<std::bitset<kPoints>, kDigits>, 2>;

  std::array<Pair, 3> digits_;
};

/// Two points whose shuffled indices first differ, from above, in bit d agree in no digit d, and in
/// those before it by chance: E[sign·sign'] is −2^-d for digit d and 0 for every other. So products
/// of the same digit of two pairs, shuffled on their own, have N·Var = 1 + 2^d 4^-d, the number of
/// such partners times their correlation, and products of different digits 1.
double law_of_digits(std::size_t first, std::size_t second) {
  return first == second ? 1 + std::ldexp(1.0, -static_cast<int>(first)) : 1;
}

TEST(SobolSampler, PairsOfOneSampleAreAsIndependentWithinEveryNetAsShufflingMakesThem) {
  constexpr std::size_t kDigits = DigitsOfPairs::kDigits;
  const std::uint64_t seed = check_seed("digits of padded pairs");
  std::vector<std::array<std::array<double, 2>, kDigits>> nets;  // by digit: the same, the next
  const auto net = [&](std::uint64_t i) {
    while (nets.size() <= i) {
      const DigitsOfPairs digits(seed, nets.size());
      auto& means = nets.emplace_back();
      for (std::size_t digit = 0; digit < kDigits; ++digit) {
        means[digit] = {digits.squared_mean(digit, digit),
                        digits.squared_mean(digit, (digit + 1) % kDigits)};
      }
    }
    return nets[i];
  };
  for (std::size_t digit = 0; digit < kDigits; ++digit) {
    const std::string subject = "padded pairs/digit " + std::to_string(digit);
    expect_law(subject + " against the same of another pair",
               [&](std::uint64_t i) { return net(i)[digit][0] / law_of_digits(digit, digit); });
    expect_law(subject + " against the next of another pair",
               [&](std::uint64_t i) { return net(i)[digit][1] / law_of_digits(digit, digit + 1); });
  }
  expect_law(
      "control/first digits held to pairs in full independence",
      [&](std::uint64_t i) { return net(i)[0][0]; }, Verdict::fail);
}

}  // namespace
}  // namespace plumbline::tests
