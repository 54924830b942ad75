#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "pairs/branches.h"
#include "pairs/differences.h"

/// A sampler that goes one of two ways, with a probability that depends on its other numbers: glass
/// chooses by the Fresnel reflectance of the normal that it has drawn.
namespace plumbline::verify {

class TwoWays {
 public:
  /// Of a pair that can be taken apart.
  explicit TwoWays(const SamplingPair& pair);
  TwoWays(const TwoWays&) = delete;
  TwoWays& operator=(const TwoWays&) = delete;

  /// A number does nothing but choose, at one border for each value of the others.
  bool found() const { return chooser_.has_value(); }

  /// One way's map of the other numbers, and how likely it is for these.
  const Map& way(std::size_t which) const { return maps_[which]; }
  std::vector<double> probabilities(std::size_t which, const std::vector<Uniforms>& others) const;

 private:
  Uniforms all_numbers(const Uniforms& others, double choice) const;
  std::vector<std::optional<SampleRecord>> at(const std::vector<Uniforms>& others,
                                              const std::vector<double>& choices) const;
  std::vector<std::optional<double>> borders(const std::vector<Uniforms>& others) const;
  bool chooses(std::size_t number);

  const SamplingPair& pair_;
  std::optional<std::size_t> chooser_;
  std::array<Map, 2> maps_;
};

}  // namespace plumbline::verify
