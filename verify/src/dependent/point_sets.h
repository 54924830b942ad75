#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <plumbline/verify/dependent.h>

namespace plumbline::verify {

/// A set of points, checked for its size.
class PointSet {
 public:
  /// @throws std::invalid_argument where other than n × dimensions numbers are returned
  PointSet(const PointSets& sets, std::uint64_t replicate, std::size_t n);

  std::size_t size() const { return size_; }
  const double* point(std::size_t i) const { return &numbers_[i * dimensions_]; }
  double at(std::size_t i, std::size_t dimension) const {
    return numbers_[i * dimensions_ + dimension];
  }

  /// "dimension 1 of point 3 is 1, outside [0, 1)"; empty if all are inside.
  std::string outside() const;

 private:
  std::size_t dimensions_, size_;
  std::vector<double> numbers_;
};

/// Replicates are numbered from here.
std::uint64_t first_replicate(std::uint64_t seed);

}  // namespace plumbline::verify
