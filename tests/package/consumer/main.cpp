#include <array>
#include <cmath>
#include <cstdio>

#include <plumbline/verify/pair.h>

// A pair of this project's own: right if `scale` is 1.
plumbline::verify::CheckResult check(double scale) {
  using Direction = std::array<double, 3>;
  constexpr double kPi = 3.14159265358979323846;
  return plumbline::verify::check_chi_square<Direction>(
      "cosine", [=](const Direction& w) { return w[2] > 0 ? scale * w[2] / kPi : 0.0; },
      [=](double u, double v) {
        const double radius = std::sqrt(u);
        return Direction{radius * std::cos(2 * kPi * v), radius * std::sin(2 * kPi * v),
                         std::sqrt(1 - u)};
      });
}

int main() {
  const auto right = check(1), wrong = check(1.1);
  std::printf("%s%s", describe(right).c_str(), describe(wrong).c_str());
  using plumbline::verify::Verdict;
  return right.verdict == Verdict::pass && wrong.verdict == Verdict::fail ? 0 : 1;
}
