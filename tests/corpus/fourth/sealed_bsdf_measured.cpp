#include <array>

#include "bsdf_case.h"
#include "bsdf_families.h"
#include "bsdf_math.h"
#include "sealed_switch.h"

namespace plumbline::tests::corpus {

namespace {

using fourth::on;
using fourth::said;

/// Readings of an instrument that went round half a turn only: the other half is its mirror image.
/// Rows go by the height of wi, columns by its azimuth from that of wo, 0 to pi. The first number
/// chooses a cell and places the sample across its rows, the second chooses the half.
template <class T>
class HalfTurnTable {
 public:
  static constexpr std::size_t kRows = 6, kColumns = 5, kCells = kRows * kColumns;

  explicit HalfTurnTable(int fault) : fault_(fault) {
    T sum = 0;
    for (std::size_t r = 0; r < kRows; ++r) {
      for (std::size_t c = 0; c < kColumns; ++c) {
        const T reading = T(0.3) + T(r) / 3 + T((r * 2 + c * 3) % 5) / 3;
        f_[r * kColumns + c] = reading;
        sum += reading;
      }
    }
    for (std::size_t k = 0; k < kCells; ++k) p_[k] = f_[k] / sum;
  }
  std::optional<Sampled<T>> sample(const V3<T>& wo, T u, T v) const {
    if (!(wo.z > 0)) return std::nullopt;
    std::size_t k = 0;
    T rest = u;
    while (k + 1 < kCells && rest >= p_[k]) rest -= p_[k++];
    const T left = below_one(std::max(T(0), rest / p_[k]));
    bool mirrored = v < T(0.5);
    T across = mirrored ? 2 * v : 2 * v - 1;
    if (fault_ == 1 || fault_ == 5) {
      mirrored = fault_ == 5 && u < T(0.5);
      across = v;
    }
    if (fault_ == 4) k = (k + kColumns) % kCells;
    const T z = (T(k / kColumns) + left) / kRows;
    const T turn = (T(k % kColumns) + across) / kColumns * pi_v<T>;
    const V3<T> wi = spherical(z, std::atan2(wo.y, wo.x) + (mirrored ? -turn : turn));
    if (!(wi.z > 0)) return std::nullopt;
    const T q = pdf(wo, wi);
    return Sampled<T>{wi, eval(wo, wi) * wi.z / q, q};
  }
  T pdf(const V3<T>& wo, const V3<T>& wi) const {
    if (!(wo.z > 0) || !(wi.z > 0)) return 0;
    std::size_t k = cell(wo, wi);
    if (fault_ == 3) k = (kRows - 1 - k / kColumns) * kColumns + k % kColumns;
    return p_[k] * kCells / (fault_ == 2 ? pi_v<T> : 2 * pi_v<T>);
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
    T turn = (std::atan2(wi.y, wi.x) - std::atan2(wo.y, wo.x)) / pi_v<T>;
    turn -= 2 * std::floor(turn / 2);
    return place(wi.z, kRows) * kColumns + place(turn > 1 ? 2 - turn : turn, kColumns);
  }
  int fault_;
  std::array<T, kCells> f_{}, p_{};
};

/// It is told from wo, whatever comes the other way, and its readings are in units of their own.
BsdfOptions half_turn_options() {
  BsdfOptions options = seen_from({30, 70});
  options.reciprocal = false;
  options.conserves_energy = false;
  return options;
}

}  // namespace

void add_sealed_measured_cases(std::vector<Case>& cases) {
  using F3 = V3<float>;
  using D3 = V3<double>;
  twin<D3>(cases, "fourth half-turn table/double", "half never chosen",
           said("sample does not choose the half, all lies on the one that was measured"),
           {CauseKind::support}, HalfTurnTable<double>(on(1)), half_turn_options());
  twin<F3>(cases, "fourth half-turn table/float", "half not in pdf",
           said("pdf lacks the 1/2 of the choice between the halves"), {CauseKind::constant},
           HalfTurnTable<float>(on(2)), half_turn_options());
  twin<D3>(cases, "fourth half-turn table/double", "rows from the other end",
           said("pdf reads the rows from the normal down, they go from the horizon up"),
           {CauseKind::mirrored}, HalfTurnTable<double>(on(3)), half_turn_options());
  twin<D3>(cases, "fourth half-turn table/double", "one row on",
           said("sample lands in the row above that of the cell that was chosen"),
           {CauseKind::shifted}, HalfTurnTable<double>(on(4)), half_turn_options());
  twin<D3>(cases, "fourth half-turn table/double", "half by the cell's number",
           said("the number that chose the cell chooses the half too"), {CauseKind::numbers_reused},
           HalfTurnTable<double>(on(5)), half_turn_options());
}

}  // namespace plumbline::tests::corpus
