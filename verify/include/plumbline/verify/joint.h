#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include <plumbline/verify/detail/domain.h>
#include <plumbline/verify/detail/many.h>
#include <plumbline/verify/detail/random.h>
#include <plumbline/verify/detail/report.h>
#include <plumbline/verify/detail/vector_access.h>
#include <plumbline/verify/pair.h>

/// Sampling of several things at once: a ray (position × direction), direction × wavelength, a
/// point of a volume, a distance × the direction after it. Their density may depend on all of them
/// together.
namespace plumbline::verify {

/// A point of a product: one of each factor, in their order. Those beyond the last are (0, 0, 0).
using JointPoint = std::array<Vec3, 4>;

/// Random numbers of one sample, in [0, 1): as many as the pair says it uses, the others 0.
using JointUniforms = std::array<double, 8>;

/// A product of one to four continuous domains, with four dimensions at most. Its measure is the
/// product of theirs: of a disk × hemisphere, densities are per area and steradian.
class JointDomain {
 public:
  /// @param factors  of dimension 1 or 2 each
  /// @throws std::invalid_argument for none, more than four dimensions, or a discrete one
  explicit JointDomain(std::vector<Domain> factors);

  /// [low, high] in one to four dimensions, density per length to that power. Its points have as
  /// many factors: (x, ·, ·), (y, ·, ·), …
  ///
  /// @throws std::invalid_argument unless low < high in each
  static JointDomain box(const std::vector<Interval>& sides);

  const std::vector<Domain>& factors() const { return factors_; }
  int dimension() const { return dimension_; }  ///< 1 to 4
  std::string name() const;                     ///< "disk × upper hemisphere"

 private:
  std::vector<Domain> factors_;
  int dimension_ = 0;
};

/// What a sampler of a product returned.
struct JointRecord {
  JointPoint x{};
  Channels weight = {};            ///< value/pdf that the record states; empty: it states none
  std::optional<double> pdf = {};  ///< density that the record states, if it does
};

/// `sample` with its `pdf` over a product of domains.
struct JointPair {
  std::string name;
  JointDomain domain;

  /// How many of the uniform numbers the map uses, 1 to 8: the Jacobian needs as many as the domain
  /// has dimensions.
  int numbers = 4;

  /// Rounding unit of the code under test: 2^-24 for float, 2^-53 for double.
  double epsilon = 0x1p-53;

  // All of these are written for one point, or for spans of them: see many.h.

  /// nullopt: the sample was rejected.
  Many<std::optional<JointRecord>(JointUniforms)> sample = {};

  /// In place of `sample`, for code that takes a random generator. The Jacobian is skipped then.
  std::function<std::optional<JointRecord>(Random&)> draw = {};

  /// Joint density, per product of the factors' measures; 0 outside the support.
  Many<double(JointPoint)> pdf = {};

  /// What weight · pdf must equal. Empty where the pair has no weight.
  Many<Channels(JointPoint)> value = {};

  /// Several u lead to the same point (a mixture, a folded map): the Jacobian is skipped.
  bool many_to_one = false;
};

namespace detail {

template <class... Points>
std::optional<JointRecord> joint_record(const std::tuple<Points...>& points) {
  JointRecord record;
  std::size_t i = 0;
  std::apply([&](const auto&... p) { ((record.x[i++] = to_point(p)), ...); }, points);
  return record;
}

template <class... Points>
std::optional<JointRecord> joint_record(const std::optional<std::tuple<Points...>>& points) {
  if (!points) return std::nullopt;
  return joint_record(*points);
}

template <class... Points, class Pdf, std::size_t... I>
double joint_density(const Pdf& pdf, const JointPoint& x, std::index_sequence<I...>) {
  return static_cast<double>(pdf(from_point<Points>(x[I])...));
}

}  // namespace detail

/// A pair from a plain map and its density.
///
///   joint_pair<4, Point2f, Vec3f>("lens", JointDomain({Domain::disk(r), Domain::hemisphere()}),
///     [](const std::array<float, 4>& u) { return std::tuple(on_lens(u), direction(u)); },
///     [](const Point2f& p, const Vec3f& w) { return pdf(p, w); });
///
/// @tparam Numbers  uniform numbers that the sampler takes, 1 to 8
/// @tparam Points   of the user, one for each factor: a number, or a vector
/// @param sample    std::array of `Numbers` uniform numbers in the first point's scalar type, or
///                  a Random&, to a std::tuple of the points or an optional one
/// @param pdf       of the points
template <std::size_t Numbers, class... Points, class Sample, class Pdf>
JointPair joint_pair(std::string name, JointDomain domain, Sample sample, Pdf pdf) {
  static_assert(Numbers >= 1 && Numbers <= std::tuple_size_v<JointUniforms>);
  static_assert(sizeof...(Points) >= 1 && sizeof...(Points) <= std::tuple_size_v<JointPoint>);
  using T = PointScalar<std::tuple_element_t<0, std::tuple<Points...>>>;
  JointPair pair{std::move(name), std::move(domain)};
  pair.numbers = static_cast<int>(Numbers);
  pair.epsilon = std::is_same_v<T, float> ? 0x1p-24 : 0x1p-53;
  if constexpr (requires(Random & random) { sample(random); }) {
    pair.draw = [sample](Random& random) { return detail::joint_record(sample(random)); };
  } else {
    pair.sample = [sample](const JointUniforms& u) {
      std::array<T, Numbers> numbers{};
      for (std::size_t i = 0; i < Numbers; ++i) numbers[i] = static_cast<T>(u[i]);
      return detail::joint_record(sample(numbers));
    };
  }
  pair.pdf = [pdf](const JointPoint& x) {
    return detail::joint_density<Points...>(pdf, x, std::index_sequence_for<Points...>());
  };
  return pair;
}

/// The whole battery: record and weight pointwise, support, finite, Jacobian, integral, chi-square.
/// Results are named pair/check; a check that the pair has no ground for is left out, one that
/// cannot be made is skipped and says so (inconclusive, as expected).
///
/// All of these throw std::invalid_argument for a pair without a sampler or a density, with both
/// `sample` and `draw`, or with a count of numbers other than 1 to 8.
Report check_pair(const JointPair& pair, const ContractOptions& options = {});

/// The density that the record states equals `pdf`; weight · pdf equals `value`; the density is
/// finite, not negative, and positive wherever the value is; points lie in the domain, also near
/// the corners of the cube of random numbers.
Report check_pointwise(const JointPair& pair, const ContractOptions& options = {});

/// pdf · |∂x/∂u| = 1 in all dimensions at once, by extrapolated differences and the Gram
/// determinant of the coordinates. Skipped where the map takes more numbers than there are
/// dimensions, or a generator.
///
/// @source Ridders 1982 (Adv. Eng. Software 4:2)
CheckResult check_jacobian(const JointPair& pair, const ContractOptions& options = {});

/// ∫pdf + rejected share = 1. The cube of all dimensions is cut into cells where the density is
/// rough; quadratic fits on them are corrected at random nodes, which leaves no error but that of
/// sampling. A pass allows `mass_tolerance`; unless stated 1e-3 where it is known that well, else
/// 5e-3 (jumps across all dimensions, a large rejected share); the result says which.
CheckResult check_integral(const JointPair& pair, const ContractOptions& options = {});

/// Chi-square test of samples against the masses of bins in all dimensions, halved at medians of
/// pilot samples. Masses are estimates at random nodes: their variance enters the statistic, and
/// bins whose mass is not known well enough are pooled.
///
/// A pass proves a relative deviation, root mean square over the 64 bins of the coarsest level, of
/// at most `deviation`, the error of the masses included.
CheckResult check_chi_square(const JointPair& pair, const ContractOptions& options = {});

}  // namespace plumbline::verify
