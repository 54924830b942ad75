#pragma once

#include <string>
#include <vector>

#include <plumbline/verify/pair.h>

#include "diagnosis/diagnosis.h"

namespace plumbline::verify {

/// A factor that is constant for each wo may be a function of wo: cosθo, G1(wo).
class ConstantByView {
 public:
  void add(const Vec3& wo, const Diagnosis& cause);

  /// Empty where fewer than three different constants were found, or no function of wo fits them.
  std::string diagnosis() const;

 private:
  struct Point {
    Vec3 wo;
    double ratio;
  };
  std::vector<Point> points_;
};

}  // namespace plumbline::verify
