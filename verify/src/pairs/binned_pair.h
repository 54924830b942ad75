#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <plumbline/verify/pair.h>

#include "pairs/bin_tree.h"

/// A sampling pair cut into bins: what the pdf expects of each, and what the sampler put there.
namespace plumbline::verify {

/// Whether pdf() is positive somewhere within rounding of a point, for a domain with a chart.
std::vector<bool> positive_near(const SamplingPair& pair, const std::vector<Vec3>& points);

/// Integral of a function of the domain, with samples of the pair as nodes where it is not smooth:
/// the pair's f·|cosθ|.
///
/// @param error  of the integral at 99.9 %, after which nothing more is spent
MassIntegral integrate_over_domain(const SamplingPair& pair, const Many<double(Vec3)>& function,
                                   const ContractOptions& options, double error);

/// Error at 99.9 % to which masses have to be known for the chi-square test, whatever
/// `mass_tolerance` allows.
double resolved_mass_error(const ContractOptions& options);

/// Error at 99.9 % to which masses have to be known for the promise of the integral check.
double promised_mass_error(const ContractOptions& options);

/// The same for both checks.
double mass_error(const ContractOptions& options);

struct AtomCount {
  Atom atom;
  std::uint64_t drawn = 0;
};

struct BinCounts {
  std::vector<std::uint64_t> bins;
  std::vector<AtomCount> atoms;  ///< those of the pair, then those met on the way
  std::uint64_t rejected = 0;
  std::uint64_t stray = 0;  ///< samples outside the domain or where the density is 0 all around
  std::uint64_t not_finite = 0;  ///< samples, or densities at them, not finite or negative
  std::uint64_t drawn = 0;
  std::vector<Vec3> strays;           ///< the first of them
  std::optional<Vec3> not_finite_at;  ///< an example
};

class BinnedPair {
 public:
  /// Draws pilot samples, cuts the domain where they fall, and integrates the density over each
  /// bin. The bins of a discrete set are its points.
  ///
  /// @param mass_error  of the integral at 99.9 %, after which nothing more is spent
  BinnedPair(const SamplingPair& pair, const ContractOptions& options, double mass_error);

  /// Draws more samples and counts them.
  void draw(std::uint64_t count);

  const SamplingPair& pair() const { return pair_; }
  int depth() const { return depth_; }  ///< 2^depth finest bins; merged in pairs, coarser ones
  const MassIntegral& expected() const { return expected_; }  ///< mass per finest bin
  const BinCounts& counts() const { return counts_; }

  /// By how much, relative to itself and on average over the samples, the density changes where its
  /// point is rounded: what rounding may do to the mass. About epsilon, and far more for narrow
  /// lobes in float.
  double rounding() const { return rounding_; }

  /// Variance of the mass that samples find in a finest bin, by where they are rounded to: only
  /// lattice points lie in it, and how many is off by what lies at its borders.
  double rounding_of(std::size_t bin) const { return bin < lattice_.size() ? lattice_[bin] : 0; }

  /// A point of a finest bin with about the mass that lies around it, and the measure.
  struct Node {
    Vec3 x;
    double mass, measure;
  };
  std::vector<std::vector<Node>> nodes() const;  ///< of every finest bin

  /// The square's part that a bin of a depth takes; of a discrete set, its points.
  Box box_of(int depth, std::size_t bin) const;

  /// Middle of a bin of a depth, in the domain.
  Vec3 center(int depth, std::size_t bin) const;

  /// Share of the pilot samples that lie on lines along which a coordinate of the square is the
  /// same, or in a point.
  double on_lines() const { return on_lines_; }

 private:
  void integrate_density(const ContractOptions& options, double mass_error);
  void tabulate_discrete();
  void measure_rounding(std::uint64_t seed);
  void measure_lattice();
  void count_atom(const SampleRecord& sample);
  void count(std::span<const std::optional<SampleRecord>> samples);
  bool inside(const Vec3& x) const;
  void count_points(const std::vector<Vec3>& points, const std::vector<double>& densities);
  void count_in_bins(const std::vector<Vec3>& points);

  const SamplingPair& pair_;
  Random random_;
  int depth_;
  double rounding_ = 0, on_lines_ = 0;
  std::optional<BinTree> tree_;
  MassIntegral expected_;
  std::vector<double> lattice_;  // variance per finest bin
  BinCounts counts_;
  // Of the batch that is counted; kept, so that not every batch makes them anew.
  std::vector<Vec3> points_, inside_;
  std::vector<double> densities_;
  std::vector<Point2> squares_;
  std::vector<std::size_t> bins_;
};

}  // namespace plumbline::verify
