#pragma once

#include <array>
#include <memory>
#include <utility>
#include <vector>

#include "bsdf_math.h"

/// Tabulated data: a lobe over θh, an image over half vectors, reflectance between elevations.
namespace plumbline::tests::corpus {

/// A density that is linear between nodes, not normalised, with its running integral.
template <class T>
class PiecewiseLinear {
 public:
  PiecewiseLinear() = default;
  PiecewiseLinear(std::vector<T> nodes, std::vector<T> values)
      : x_(std::move(nodes)), p_(std::move(values)), cdf_{0} {
    for (std::size_t k = 0; k + 1 < x_.size(); ++k) {
      cdf_.push_back(cdf_.back() + (x_[k + 1] - x_[k]) * (p_[k] + p_[k + 1]) / 2);
    }
  }
  T total() const { return cdf_.back(); }
  T operator()(T x) const {
    const std::size_t k = bin(x_, x);
    return p_[k] + (p_[k + 1] - p_[k]) * (x - x_[k]) / (x_[k + 1] - x_[k]);
  }
  T sample(T u) const {
    const std::size_t k = bin(cdf_, u * total());
    const T w = x_[k + 1] - x_[k], m = (u * total() - cdf_[k]) / w;
    const T root = p_[k] + safe_sqrt(p_[k] * p_[k] + 2 * (p_[k + 1] - p_[k]) * m);
    return x_[k] + w * std::clamp(root > 0 ? 2 * m / root : T(0), T(0), T(1));
  }

 private:
  static std::size_t bin(const std::vector<T>& edges, T x) {
    const auto above = std::upper_bound(edges.begin() + 1, edges.end() - 1, x);
    return static_cast<std::size_t>(above - edges.begin()) - 1;
  }
  std::vector<T> x_, p_, cdf_;
};

/// A measured isotropic lobe: a table over θh, denser near 0, sampled by inversion.
template <class T>
class ThetaTable {
 public:
  explicit ThetaTable(int fault = 0) : fault_(fault) {
    constexpr int kNodes = 33;
    std::vector<T> theta, density;
    for (int i = 0; i < kNodes; ++i) {
      const T s = T(i) / (kNodes - 1), t = s * s * pi_v<T> / 2;
      // A sharp core on a wide foot, as such measurements are.
      const T d = std::exp(-sqr(t / T(0.12))) + T(0.15) * std::exp(-sqr(t / T(0.6)));
      theta.push_back(t);
      density.push_back(d * std::max(T(0), std::cos(t)) * (fault == 1 ? T(1) : std::sin(t)));
      table_.push_back(d);
      if (i == 1) slope_ = density.back() / t;
    }
    if (fault == 2) {
      std::vector<T> moved(density.begin() + 1, density.end());
      moved.push_back(0);
      shifted_ = PiecewiseLinear<T>(theta, std::move(moved));
    }
    nodes_ = theta;
    theta_ = PiecewiseLinear<T>(theta, density);
  }
  std::optional<Sampled<T>> sample(const V3<T>& wo, T u, T v) const {
    if (!(wo.z > 0)) return std::nullopt;
    const T theta = theta_.sample(u), phi = 2 * pi_v<T> * v, s = std::sin(theta);
    const V3<T> h{s * std::cos(phi), s * std::sin(phi), std::cos(theta)};
    const V3<T> wi = mirrored_at(wo, h);
    if (!(wi.z > 0) || !(dot(wo, h) > 0)) return std::nullopt;
    const T q = pdf(wo, wi);
    if (!(q > 0)) return std::nullopt;
    return Sampled<T>{wi, eval(wo, wi) * wi.z / q, q};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    const V3<T> h = unit(wo + wi);
    const T sine = std::sqrt(h.x * h.x + h.y * h.y), theta = std::atan2(sine, h.z);
    if (fault_ == 2) return shifted_(theta) / theta_.total() / (8 * pi_v<T> * sine * dot(wo, h));
    T per_solid_angle = slope_;
    if (sine > T(1e-6)) per_solid_angle = theta_(theta) / (fault_ == 3 || fault_ == 1 ? 1 : sine);
    const T turn = fault_ == 4 ? 1 : 2 * pi_v<T>;
    return per_solid_angle / (theta_.total() * turn * 4 * dot(wo, h));
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    const V3<T> h = unit(wo + wi);
    const T theta = std::atan2(std::sqrt(h.x * h.x + h.y * h.y), h.z);
    const T x = std::sqrt(std::clamp(theta / (pi_v<T> / 2), T(0), T(1))) * T(table_.size() - 1);
    const std::size_t i = std::min(static_cast<std::size_t>(x), table_.size() - 2);
    const T d = table_[i] + (table_[i + 1] - table_[i]) * (x - T(i));
    return d / std::max(wo.z, wi.z) * schlick(T(0.5), dot(wo, h));
  }

 private:
  int fault_;
  std::vector<T> nodes_, table_;
  PiecewiseLinear<T> theta_, shifted_;
  T slope_ = 0;
};

/// An image of brushed metal over the half vector: rows by θh, columns by φh, constant in a cell.
class HalfImage {
 public:
  static constexpr std::size_t kRows = 24, kColumns = 32;

  explicit HalfImage(int fault = 0) : fault_(fault), last_(std::make_shared<std::size_t>(0)) {
    double masses = 0;
    for (std::size_t r = 0; r < kRows; ++r) {
      const double theta = (static_cast<double>(r) + 0.5) / kRows * pi_v<double> / 2;
      for (std::size_t c = 0; c < kColumns; ++c) {
        const double phi = (static_cast<double>(c) + 0.5) / kColumns * 2 * pi_v<double>;
        const double across = theta * std::cos(phi), along = theta * std::sin(phi - 0.3);
        const double d = std::exp(-sqr(across / 0.25) - sqr(along / 0.7)) * std::cos(theta);
        value_.push_back(d);
        const double area = (edge(r) - edge(r + 1)) * 2 * pi_v<double> / kColumns;
        norm_ += d * area;
        masses += d * (fault_ == 1 ? 1 : area);
        cdf_.push_back(masses);
      }
    }
  }
  std::optional<Sampled<double>> sample(const V3<double>& wo, const P2<double>& u) const {
    if (!(wo.z > 0)) return std::nullopt;
    const auto above = std::upper_bound(cdf_.begin(), cdf_.end() - 1, u.x * cdf_.back());
    const auto cell = static_cast<std::size_t>(above - cdf_.begin());
    const double below = cell == 0 ? 0 : cdf_[cell - 1];
    double again = below_one((u.x * cdf_.back() - below) / (cdf_[cell] - below));
    if (fault_ == 2) again = u.x;
    const std::size_t r = cell / kColumns, c = cell % kColumns;
    const double cosine = edge(r) + (edge(r + 1) - edge(r)) * std::max(0.0, again);
    const double shift = fault_ == 3 ? 0.5 : 0;
    const double phi = (static_cast<double>(c) + u.y + shift) * 2 * pi_v<double> / kColumns;
    const V3<double> h = spherical(cosine, phi), wi = mirrored_at(wo, h);
    if (!(wi.z > 0) || !(dot(wo, h) > 0)) return std::nullopt;
    *last_ = cell;
    const double q = value_[cell] / norm_ / (4 * dot(wo, h));
    return Sampled<double>{wi, eval(wo, wi) * wi.z / q, q};
  }
  double pdf(const V3<double>& wo, const V3<double>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    const V3<double> h = unit(wo + wi);
    if (fault_ == 7) return value_[*last_] / norm_ / (4 * dot(wo, h));
    return value_[cell_of(h, fault_)] / norm_ / (4 * dot(wo, h));
  }
  double eval(const V3<double>& wo, const V3<double>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    const V3<double> h = unit(wo + wi);
    return 0.9 * value_[cell_of(h, 0)] / norm_ / (4 * dot(wo, h) * std::max(wo.z, wi.z));
  }

 private:
  static double edge(std::size_t row) {
    return row == kRows ? 0 : std::cos(static_cast<double>(row) / kRows * pi_v<double> / 2);
  }
  static std::size_t cell_of(const V3<double>& h, int fault) {
    const double theta = std::atan2(std::sqrt(h.x * h.x + h.y * h.y), h.z);
    double phi = std::atan2(fault == 5 ? -h.y : h.y, h.x);
    if (phi < 0) phi += 2 * pi_v<double>;
    const double row = theta / (pi_v<double> / 2) * kRows + (fault == 4 ? 1 : 0);
    const double column = phi / (2 * pi_v<double>)*kColumns + (fault == 6 ? 0.5 : 0);
    const std::size_t r = std::min(static_cast<std::size_t>(row), kRows - 1);
    return r * kColumns + static_cast<std::size_t>(column) % kColumns;
  }

  int fault_;
  std::vector<double> value_, cdf_;
  double norm_ = 0;
  std::shared_ptr<std::size_t> last_;
};

/// Reflectance between elevations, symmetric, interpolated between the table's nodes in both; the
/// density is that of the two nearest rows, of which one is chosen by the number that is used
/// again.
template <class T>
class ElevationTable {
 public:
  static constexpr std::size_t kNodes = 12;

  explicit ElevationTable(int fault = 0) : fault_(fault) {
    std::vector<T> nodes;
    for (std::size_t k = 0; k < kNodes; ++k) nodes.push_back(T(k) / (kNodes - 1));
    for (std::size_t o = 0; o < kNodes; ++o) {
      std::vector<T> density;
      for (std::size_t i = 0; i < kNodes; ++i) {
        const T a = nodes[o], b = nodes[i];
        f_[o][i] = (T(0.2) + T(0.5) * std::exp(-sqr((a - b) / T(0.3))) * (1 - a * b)) / pi_v<T>;
        if (fault == 1 && i > o) f_[o][i] *= T(0.9);
        density.push_back(f_[o][i] * std::max(b, T(0.02)));
      }
      row_[o] = PiecewiseLinear<T>(nodes, density);
    }
  }
  std::optional<Sampled<T>> sample(const V3<T>& wo, const P2<T>& u) const {
    if (!(wo.z > 0)) return std::nullopt;
    const auto [o, t] = place(wo.z);
    const bool second = u.x < t;
    const T again = second ? u.x / t : (u.x - t) / (1 - t);
    const T cosine = row_[second ? o + 1 : o].sample(fault_ == 2 ? u.x : below_one(again));
    if (!(cosine > 0)) return std::nullopt;
    const V3<T> wi = spherical(cosine, 2 * pi_v<T> * u.y);
    const T q = pdf(wo, wi);
    return Sampled<T>{wi, eval(wo, wi) * wi.z / q, q};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    auto [o, t] = place(wo.z);
    if (fault_ == 3) t = 1 - t;
    if (fault_ == 4) t = T(1);
    const T low = row_[o](wi.z) / row_[o].total(), high = row_[o + 1](wi.z) / row_[o + 1].total();
    const T p = (1 - t) * low + t * high;
    return fault_ == 5 ? p * safe_sqrt(1 - wi.z * wi.z) / (2 * pi_v<T>) : p / (2 * pi_v<T>);
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    const auto [o, s] = place(wo.z);
    const auto [i, t] = place(wi.z);
    return (1 - s) * ((1 - t) * f_[o][i] + t * f_[o][i + 1]) +
           s * ((1 - t) * f_[o + 1][i] + t * f_[o + 1][i + 1]);
  }

 private:
  static std::pair<std::size_t, T> place(T cosine) {
    const T x = std::clamp(cosine, T(0), T(1)) * (kNodes - 1);
    const std::size_t k = std::min(static_cast<std::size_t>(x), kNodes - 2);
    return {k, x - T(k)};
  }
  int fault_;
  std::array<std::array<T, kNodes>, kNodes> f_{};
  std::array<PiecewiseLinear<T>, kNodes> row_;
};

}  // namespace plumbline::tests::corpus
