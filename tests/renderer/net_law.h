#pragma once

#include <array>
#include <cmath>
#include <cstddef>

/// What a mean over a scrambled net must vary by, for one integrand.
namespace plumbline::tests {

/// The variance of the mean over a (0, m, 2)-net in base 2 under Owen's nested scrambling, from the
/// integrand's variance by levels of detail: those that the boxes of the net resolve cost nothing,
/// those just below count twice, since both points of a box then deviate alike, and all finer ones
/// count as in independent samples.
///
/// @source Owen 1997 (SIAM J. Numer. Anal. 34:5), "Monte Carlo variance of scrambled net
///         quadrature", Theorem 2 and the gain coefficients of (0, m, 2)-nets
class NetLaw {
 public:
  /// @param integrand  double of (x, y) in [0, 1)², smooth: beyond 64 boxes a side its variance
  ///                   is taken to fall by 4 from level to level, which is then right to 1e-3
  template <class Integrand>
  explicit NetLaw(const Integrand& integrand) {
    tabulate_means(integrand);
    std::array<std::array<double, kLevels + 1>, kLevels + 1> resolved{};
    for (std::size_t a = 0; a <= kLevels; ++a) {
      for (std::size_t b = 0; b <= kLevels; ++b) resolved[a][b] = mean_square(a, b);
    }
    const auto below = [&](std::size_t a, std::size_t b, std::size_t i, std::size_t j) {
      return a < i || b < j ? 0.0 : resolved[a - i][b - j];
    };
    for (std::size_t a = 0; a <= kLevels; ++a) {
      for (std::size_t b = 0; b <= kLevels; ++b) {
        variance_[a][b] =
            resolved[a][b] - below(a, b, 1, 0) - below(a, b, 0, 1) + below(a, b, 1, 1);
      }
    }
  }

  double mean() const { return mean_; }

  /// N times the variance of the mean over N = 2^m points of a net.
  double of_net(std::size_t m) const {
    double sum = 0;
    for (std::size_t a = 0; a <= kDeepest; ++a) {
      for (std::size_t b = 0; b <= kDeepest; ++b) sum += gain(a, b, m) * level(a, b);
    }
    return sum;
  }

 private:
  static constexpr std::size_t kLevels = 6, kSide = 1u << kLevels, kDeepest = 30;

  template <class Integrand>
  void tabulate_means(const Integrand& integrand) {
    constexpr std::size_t kPoints = 4;  // a side of a box
    for (std::size_t i = 0; i < kSide * kPoints; ++i) {
      for (std::size_t j = 0; j < kSide * kPoints; ++j) {
        const auto at = [](std::size_t k) {
          return (static_cast<double>(k) + 0.5) / (kSide * kPoints);
        };
        means_[i / kPoints][j / kPoints] += integrand(at(i), at(j)) / (kPoints * kPoints);
      }
    }
    for (const auto& row : means_) {
      for (const double value : row) mean_ += value / (kSide * kSide);
    }
    for (auto& row : means_) {
      for (double& value : row) value -= mean_;
    }
  }

  /// Of the integrand's means over 2^a by 2^b boxes, without its own mean.
  double mean_square(std::size_t a, std::size_t b) const {
    const std::size_t columns = 1u << a, rows = 1u << b;
    double sum = 0;
    for (std::size_t i = 0; i < columns; ++i) {
      for (std::size_t j = 0; j < rows; ++j) {
        const double mean = mean_over(i, kSide / columns, j, kSide / rows);
        sum += mean * mean;
      }
    }
    return sum / static_cast<double>(columns * rows);
  }

  double mean_over(std::size_t column, std::size_t width, std::size_t row,
                   std::size_t height) const {
    double sum = 0;
    for (std::size_t i = column * width; i < (column + 1) * width; ++i) {
      for (std::size_t j = row * height; j < (row + 1) * height; ++j) sum += means_[i][j];
    }
    return sum / static_cast<double>(width * height);
  }

  /// Variance of the details of 2^-a by 2^-b; 0 stands for no detail along an axis.
  double level(std::size_t a, std::size_t b) const {
    const std::size_t i = a < kLevels ? a : kLevels, j = b < kLevels ? b : kLevels;
    return std::ldexp(variance_[i][j], -2 * static_cast<int>(a - i + b - j));
  }

  static double gain(std::size_t a, std::size_t b, std::size_t m) {
    if (a + b <= m) return 0;
    return a > 0 && b > 0 && a + b == m + 1 ? 2 : 1;
  }

  std::array<std::array<double, kSide>, kSide> means_{};
  std::array<std::array<double, kLevels + 1>, kLevels + 1> variance_{};
  double mean_ = 0;
};

}  // namespace plumbline::tests
