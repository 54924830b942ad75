#include <array>
#include <memory>

#include "bsdf_case.h"
#include "bsdf_families.h"
#include "bsdf_math.h"
#include "sealed_switch.h"

namespace plumbline::tests::corpus {

namespace {

using fresh::on;
using fresh::said;

/// A goniometer's table: rows of equal cosine, columns of azimuth from the plane of wo, constant in
/// a cell.
template <class T>
class Gonio {
 public:
  static constexpr std::size_t kRows = 6, kColumns = 8, kCells = kRows * kColumns;

  explicit Gonio(int fault) : fault_(fault) {
    for (std::size_t r = 0; r < kRows; ++r) {
      for (std::size_t c = 0; c < kColumns; ++c) {
        const T reading = T(0.2) + T((r * 5 + c * 3) % 7) / 4 + (c == 4 ? T(1.5) : T(0));
        f_[r * kColumns + c] = reading;
        total_ += reading;
        cdf_[r * kColumns + c] = total_;
      }
    }
  }
  std::optional<Sampled<T>> sample(const V3<T>& wo, T u, T v) const {
    if (!(wo.z > 0)) return std::nullopt;
    const T target = u * total_;
    std::size_t k = 0;
    while (k + 1 < kCells && target >= cdf_[k]) ++k;
    const T begin = k == 0 ? T(0) : cdf_[k - 1];
    const T left = below_one(std::max(T(0), (target - begin) / (cdf_[k] - begin)));
    std::size_t row = k / kColumns, column = k % kColumns;
    if (fault_ == 1) column = (column + 1) % kColumns;
    if (fault_ == 6) column = kColumns - 1 - column;
    const T z = (T(row) + (fault_ == 3 ? u : left)) / kRows;
    const T turn = (T(column) + v) / kColumns * 2 * pi_v<T>;
    const V3<T> wi = spherical(z, turn + (fault_ == 2 ? T(0) : std::atan2(wo.y, wo.x)));
    if (!(wi.z > 0)) return std::nullopt;
    const T q = density(wo, wi);
    if (fault_ == 4) *last_ = q;
    return Sampled<T>{wi, eval(wo, wi) * wi.z / q, q};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    if (fault_ == 4 && *last_ > 0) return *last_;
    return density(wo, wi);
  }
  T eval(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    return f_[cell(wo, wi)] / (4 * pi_v<T>);
  }

 private:
  static std::size_t place(T x, std::size_t n) {
    return std::min(static_cast<std::size_t>(std::max(T(0), x) * T(n)), n - 1);
  }
  std::size_t cell(const V3<T>& wo, const V3<T>& wi) const {
    T turn = (std::atan2(wi.y, wi.x) - std::atan2(wo.y, wo.x)) / (2 * pi_v<T>);
    turn -= std::floor(turn);
    return place(wi.z, kRows) * kColumns + place(turn, kColumns);
  }
  T density(const V3<T>& wo, const V3<T>& wi) const {
    const T cells = fault_ == 5 ? T(1) : T(kCells);
    return f_[cell(wo, wi)] / total_ * cells / (2 * pi_v<T>);
  }
  int fault_;
  std::array<T, kCells> f_{}, cdf_{};
  T total_ = 0;
  std::shared_ptr<T> last_ = std::make_shared<T>(T(0));
};

/// It is told from wo, whatever comes the other way, and its readings are in units of their own.
BsdfOptions gonio_options() {
  BsdfOptions options = seen_from({35, 65});
  options.reciprocal = false;
  options.conserves_energy = false;
  return options;
}

}  // namespace

void add_sealed_measured_cases(std::vector<Case>& cases) {
  using F3 = V3<float>;
  using D3 = V3<double>;
  twin<D3>(cases, "fresh goniometer/double", "next column sampled",
           said("sample lands one column further than the cell that was chosen"),
           {CauseKind::shifted, CauseKind::tangent_frame}, Gonio<double>(on(1)), gonio_options());
  twin<D3>(cases, "fresh goniometer/double", "pdf remembered",
           said("pdf gives what was right for the last sample, whatever it is asked for"),
           {CauseKind::stale_state}, Gonio<double>(on(4)), gonio_options());
  twin<F3>(cases, "fresh goniometer/float", "cells without their number",
           said("pdf has the cell's probability without the number of cells"),
           {CauseKind::constant}, Gonio<float>(on(5)), gonio_options());
}

}  // namespace plumbline::tests::corpus
