#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <plumbline/renderer/core/math.h>

namespace plumbline::renderer {

/// A reflectance that is smooth in the cosine, for rendering: cubics between equally spaced cosines
/// instead of a dozen roots and divisions. Other scalars than float go on using the formula, so
/// that what checks float against them checks the table as well.
class ReflectanceTable {
 public:
  ReflectanceTable() = default;

  /// As many pieces as kTolerance takes; empty where kMostPieces are not enough, which is where the
  /// reflectance has a kink.
  ///
  /// @param reflectance  Rgbd of a cosine in [0, 1], each channel ≥ 0
  template <class Reflectance>
  explicit ReflectanceTable(const Reflectance& reflectance) {
    for (int pieces = 16; pieces <= kMostPieces; pieces *= 2) {
      if (!fit(reflectance, pieces)) continue;
      count_ = pieces;
      return;
    }
  }

  bool empty() const { return count_ == 0; }

  /// @param cosine  in [0, 1]
  [[gnu::always_inline]] Rgbf operator()(float cosine) const {
    const float place = cosine * static_cast<float>(count_);
    const int piece = std::min(static_cast<int>(place), count_ - 1);
    return value(pieces_[static_cast<std::size_t>(piece)], place - static_cast<float>(piece));
  }

 private:
  static constexpr double kTolerance = 1e-5;  ///< relative
  static constexpr int kMostPieces = 1024;

  using Channels = std::array<float, 4>;  // red, green, blue and a gap: a register
  using Cubic = std::array<Channels, 4>;  // by power of the place within the piece

  /// The cubic through four values at x = 0, 1/3, 2/3, 1, by Newton's forward differences.
  static Cubic interpolate(const std::array<Rgbd, 4>& values) {
    Cubic cubic{};
    std::size_t c = 0;
    for (double Rgbd::*const channel : {&Rgbd::r, &Rgbd::g, &Rgbd::b}) {
      const double f0 = values[0].*channel, f1 = values[1].*channel, f2 = values[2].*channel;
      const double first = f1 - f0, second = f2 - f1 - first;
      const double third = values[3].*channel - f2 - (f2 - f1) - second;
      cubic[0][c] = static_cast<float>(f0);
      cubic[1][c] = static_cast<float>(3 * (first - second / 2 + third / 3));
      cubic[2][c] = static_cast<float>(9 * (second - third) / 2);
      cubic[3][c] = static_cast<float>(27 * third / 6);
      ++c;
    }
    return cubic;
  }

  [[gnu::always_inline]] static Rgbf value(const Cubic& cubic, float x) {
    Channels sum = cubic[3];
    for (std::size_t power = 3; power-- > 0;) {
      for (std::size_t c = 0; c < 4; ++c) sum[c] = sum[c] * x + cubic[power][c];
    }
    return {sum[0], sum[1], sum[2]};
  }

  /// @return whether every piece is within kTolerance halfway between its nodes
  template <class Reflectance>
  bool fit(const Reflectance& reflectance, int pieces) {
    pieces_.clear();
    for (int i = 0; i < pieces; ++i) {
      const auto at = [&](double x) { return reflectance((i + x) / pieces); };
      pieces_.push_back(interpolate({at(0), at(1.0 / 3), at(2.0 / 3), at(1)}));
      for (const double x : {1.0 / 6, 0.5, 5.0 / 6}) {
        const Rgbd truth = at(x),
                   here = rgb_cast<double>(value(pieces_.back(), static_cast<float>(x)));
        for (double Rgbd::*const channel : {&Rgbd::r, &Rgbd::g, &Rgbd::b}) {
          if (!(std::abs(here.*channel - truth.*channel) <= kTolerance * truth.*channel)) {
            return false;
          }
        }
      }
    }
    return true;
  }

  std::vector<Cubic> pieces_;
  int count_ = 0;  // of pieces
};

}  // namespace plumbline::renderer
