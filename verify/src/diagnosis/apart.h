#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "diagnosis/evidence.h"
#include "diagnosis/observations.h"
#include "diagnosis/parts.h"
#include "diagnosis/two_ways.h"

namespace plumbline::verify {

/// What one part adds to the density at a point.
struct PartThere {
  double q = 0;                    ///< density of the part by itself, over pdf()
  double probability = 0;          ///< that it is chosen
  std::optional<Uniforms> u = {};  ///< the numbers that lead there, if they are the only ones

  double contribution() const { return probability * q; }
};

/// What samples are like at a point: Σ probability q, which is 1 for correct code.
struct Equation {
  Vec3 x{};
  double pdf = 0;
  std::vector<PartThere> parts;
  double error = 0;

  double sum() const;
};

/// A search for the ways to a point misses one of them, or a fold is between differences, at so
/// many of the points.
inline constexpr double kMissed = 0.06;

/// A view's sampler in parts, and the densities of all of them at points of each.
class Apart {
 public:
  explicit Apart(const ViewEvidence& of);
  Apart(const Apart&) = delete;
  Apart& operator=(const Apart&) = delete;

  const ViewEvidence& view() const { return view_; }
  std::size_t count() const { return two_ways_ ? 2 : maps_.size(); }
  bool known() const { return count() > 1 && equations_.size() >= 5 * count(); }

  /// The parts have probabilities that do not depend on the other numbers.
  bool fixed() const { return !two_ways_; }
  const Parts& parts() const { return parts_; }
  const std::vector<std::unique_ptr<PartMap>>& maps() const { return maps_; }

  const std::vector<Equation>& equations() const { return equations_; }

  /// The density of the samples at all points, over pdf(): known as well as differences are.
  std::vector<ExactPoint> densities() const;

  /// The same of some parts only, over what is left of pdf() without all the others; nothing if
  /// that is negative where these parts have a good share.
  std::optional<std::vector<ExactPoint>> densities_of(const std::vector<bool>& chosen) const;

  /// ∫ of what pdf() has of some parts, less ∫ of their densities, if their densities are so many
  /// times what pdf() has: by samples of the parts, with its standard error.
  struct Excess {
    double value = 0, error = 0;
  };
  Excess excess_of(const std::vector<bool>& chosen, const Prediction& times,
                   std::span<const double> numbers) const;

  /// "the part that is chosen with probability 0.35".
  std::string name_of(const std::vector<bool>& chosen) const;

 private:
  void add_points_of_parts();
  void add_points_of_two_ways();
  ExactPoint exact(const Equation& e, double base, double density) const;

  const ViewEvidence& view_;
  Parts parts_;
  std::vector<std::unique_ptr<PartMap>> maps_;
  std::unique_ptr<TwoWays> two_ways_;
  std::vector<Equation> equations_;
};

}  // namespace plumbline::verify
