#include <array>

#include "bsdf_case.h"
#include "bsdf_families.h"
#include "sealed_facets.h"
#include "sealed_switch.h"

namespace plumbline::tests::corpus {
namespace fifth {
namespace {

/// A gloss that was measured over the half vector's angle, finest around the normal: rings of
/// the angle's square root.
template <class T>
struct Goniometer {
  static constexpr std::size_t kRings = 10;
  std::array<T, kRings> d{T(3),   T(2.7),  T(2.2),  T(1.6),  T(1.1),
                          T(0.7), T(0.42), T(0.25), T(0.15), T(0.1)};
  int fault = 0;

  static T edge(std::size_t k) { return pi_v<T> / 2 * sqr(static_cast<T>(k) / kRings); }
  T size(std::size_t k) const {
    if (fault == 1) return 2 * pi_v<T> * (edge(k + 1) - edge(k));
    return 2 * pi_v<T> * (std::cos(edge(k)) - std::cos(edge(k + 1)));
  }
  T all() const {
    T sum = 0;
    for (std::size_t k = 0; k < kRings; ++k) sum += d[k] * size(k);
    return sum;
  }
  static std::size_t ring(const V3<T>& h) {
    const T theta = std::atan2(std::hypot(h.x, h.y), h.z);
    return std::min(kRings - 1, static_cast<std::size_t>(kRings * std::sqrt(2 * theta / pi_v<T>)));
  }
  std::optional<Sampled<T>> sample(const V3<T>& wo, const P2<T>& u) const {
    if (!(wo.z > 0)) return std::nullopt;
    T left = u.x * all();
    std::size_t k = 0;
    while (k + 1 < kRings && left >= d[k] * size(k)) {
      left -= d[k] * size(k);
      ++k;
    }
    const T across = std::clamp(left / (d[k] * size(k)), T(0), T(1));
    const T low = std::cos(edge(k + 1)), high = std::cos(edge(k));
    const V3<T> h = spherical(high - across * (high - low), 2 * pi_v<T> * u.y);
    if (!(dot(wo, h) > 0)) return std::nullopt;
    const V3<T> wi = mirrored_at(wo, h);
    if (!(wi.z > 0)) return std::nullopt;
    const T q = pdf(wo, wi);
    return Sampled<T>{wi, eval(wo, wi) * wi.z / q, q};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    if (!both_above(wo, wi)) return 0;
    const V3<T> h = halfway(wo, wi);
    const std::size_t k = ring(h);
    T total = 0;
    for (std::size_t j = 0; j < kRings; ++j) {
      total += d[j] * 2 * pi_v<T> * (std::cos(edge(j)) - std::cos(edge(j + 1)));
    }
    const T q = d[fault == 2 ? std::min(k + 1, kRings - 1) : k] / total;
    return fault == 3 ? q / 4 : q / (4 * dot(wo, h));
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    return both_above(wo, wi) ? T(0.15) * d[ring(halfway(wo, wi))] : T(0);
  }
};

/// A lobe as a table over the sampled direction: heights evenly, turns about the normal counted
/// from the given direction.
template <class T>
struct Album {
  static constexpr std::size_t kHigh = 6, kRound = 6;
  std::array<std::array<T, kRound>, kHigh> f{};
  int fault = 0;

  explicit Album(int which) : fault(which) {
    for (std::size_t j = 0; j < kHigh; ++j) {
      for (std::size_t i = 0; i < kRound; ++i) {
        f[j][i] =
            T(0.05) + static_cast<T>((i * 2 + j * 3) % 5) * T(0.04) + (i == 3 ? T(0.2) : T(0));
      }
    }
  }
  T row(std::size_t j) const {
    T sum = 0;
    for (const T x : f[j]) sum += x;
    return sum;
  }
  T all() const {
    T sum = 0;
    for (std::size_t j = 0; j < kHigh; ++j) sum += row(j);
    return sum;
  }
  /// Turn of wi as the table counts it, from 0 to 1.
  T turn(const V3<T>& wo, const V3<T>& wi, bool of_pdf) const {
    const T from = of_pdf && fault == 1 ? T(0) : std::atan2(wo.y, wo.x);
    const T t = (std::atan2(wi.y, wi.x) - from) / (2 * pi_v<T>);
    return t - std::floor(t);
  }
  static std::size_t cell(T x, std::size_t n) {
    return std::min(n - 1, static_cast<std::size_t>(x * static_cast<T>(n)));
  }
  std::optional<Sampled<T>> sample(const V3<T>& wo, const P2<T>& u) const {
    if (!(wo.z > 0)) return std::nullopt;
    T down = u.y * all();
    std::size_t j = 0;
    while (j + 1 < kHigh && down >= row(j)) down -= row(j++);
    T along = u.x * row(j);
    std::size_t i = 0;
    while (i + 1 < kRound && along >= f[j][i]) along -= f[j][i++];
    const T z = (static_cast<T>(j) + std::min(T(1), down / row(j))) / kHigh;
    const T t = (static_cast<T>(i) + std::min(T(1), along / f[j][i])) / kRound;
    const V3<T> wi = spherical(z, 2 * pi_v<T> * t + std::atan2(wo.y, wo.x));
    if (!(wi.z > 0)) return std::nullopt;
    const T q = pdf(wo, wi);
    return Sampled<T>{wi, eval(wo, wi) * wi.z / q, q};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    if (!both_above(wo, wi)) return 0;
    std::size_t j = cell(wi.z, kHigh), i = cell(turn(wo, wi, true), kRound);
    if (fault == 2) std::swap(i, j);
    return f[j][i] / all() * kHigh * kRound / (2 * pi_v<T>);
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    if (!both_above(wo, wi)) return 0;
    return f[cell(wi.z, kHigh)][cell(turn(wo, wi, false), kRound)];
  }
};

BsdfOptions album_options(std::vector<double> angles) {
  BsdfOptions options = seen_from(std::move(angles));
  options.reciprocal = false;
  return options;
}

}  // namespace
}  // namespace fifth

void add_sealed_measured_cases(std::vector<Case>& cases) {
  using namespace fifth;
  using D3 = V3<double>;
  const auto goniometer = [](int fault) {
    Goniometer<double> g;
    g.fault = put(fault);
    return g;
  };
  twin<D3>(cases, "fifth goniometer/double", "rings without sine",
           because("sample weighs the rings by their angle, without the sine"), {CauseKind::sine},
           goniometer(1), seen_from({10, 45}));
  twin<D3>(cases, "fifth goniometer/rings/double", "ring after",
           because("pdf reads the ring after the half vector's"), {CauseKind::shifted},
           goniometer(2), seen_from({0, 50}));
  twin<D3>(cases, "fifth goniometer/half vector/double", "wo.h forgotten",
           because("pdf divides by 4, not by 4 wo.h"), {CauseKind::half_vector_jacobian},
           goniometer(3), seen_from({20, 60}));
  twin<D3>(cases, "fifth album/double", "turns from the frame's x",
           because("pdf counts turns from x, sample and f from the given direction"),
           {CauseKind::tangent_frame, CauseKind::shifted}, Album<double>(put(1)),
           album_options({40, 70}));
  twin<D3>(cases, "fifth album/6x6/double", "rows for columns",
           because("pdf reads the table with row and column exchanged"), {CauseKind::mirrored},
           Album<double>(put(2)), album_options({30, 60}));
}

}  // namespace plumbline::tests::corpus
