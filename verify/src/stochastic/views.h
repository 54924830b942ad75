#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <plumbline/verify/mean.h>
#include <plumbline/verify/stochastic.h>

#include "pairs/regions.h"

namespace plumbline::verify {

/// A BSDF that answers at random, looked at from one direction.
struct StochasticView {
  StochasticView(const StochasticBsdf& of, const StochasticOptions& how, const Vec3& from,
                 std::string name, std::uint64_t seed_of_its_own);

  const StochasticBsdf& bsdf;
  const StochasticOptions& options;
  Vec3 wo;
  std::string subject;
  std::uint64_t seed;
  bool black = true;         ///< no pilot sample at all, atoms included
  std::size_t channels = 0;  ///< of `eval`
  std::vector<Vec3> pilot;   ///< sampled directions that are no atoms'; sets both above
  Regions regions;

 private:
  /// Draws the pilot samples too.
  std::vector<Vec3> draw_pilot();
};

/// Of an agreement check on the view.
MeanOptions mean_options(const StochasticView& view, const std::string& check);

CheckResult check_eval_mean(const StochasticView& view);
CheckResult check_pdf_mean(const StochasticView& view);
CheckResult check_mis_mean(const StochasticView& view);
CheckResult check_known_albedo(const StochasticView& view);
CheckResult check_stochastic_reciprocity(const StochasticBsdf& bsdf,
                                         const StochasticOptions& options);

/// A direction that is a sample of an atom, of whatever probability.
inline bool is_atom(const SampleRecord& sample) { return sample.mass != 0; }

/// What pdf returned, or NaN, which fails, where that is no density.
double pdf_or_nan(double pdf);

}  // namespace plumbline::verify
