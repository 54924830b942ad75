#include "bsdf_case.h"
#include "bsdf_families.h"
#include "bsdf_measured.h"

namespace plumbline::tests::corpus {

namespace {

using F3 = V3<float>;
using D3 = V3<double>;

/// The measured lobe comes as it was measured, whatever its albedo.
[[maybe_unused]] BsdfOptions theta_options(std::vector<double> angles) {
  BsdfOptions options = seen_from(std::move(angles));
  options.conserves_energy = false;
  return options;
}

}  // namespace

void add_sealed_measured_cases(std::vector<Case>& cases) {
  twin<D3>(cases, "measured lobe/double", "table without its sine",
           "neither the table that is inverted nor pdf has sin of theta h", {CauseKind::sine},
           ThetaTable<double>(1), theta_options({20, 60}));
  twin<F3>(cases, "measured lobe/float", "pdf without 1/(2 pi)",
           "pdf lacks the density of the azimuth", {CauseKind::constant}, ThetaTable<float>(4),
           theta_options({20, 60}));
  twin<D3>(cases, "half-vector image/double", "azimuth negated in pdf",
           "pdf reads the image with the azimuth negated", {CauseKind::mirrored}, HalfImage(5),
           seen_from({0, 50}));
  twin<D3>(cases, "elevation table/double", "table not symmetric",
           "what was measured one way is a tenth less the other way", {CauseKind::asymmetric},
           ElevationTable<double>(1), seen_from({20, 60}));
  twin<D3>(cases, "elevation table/double", "number not stretched",
           "L6: the number that chose the row is used as it is", {CauseKind::numbers_reused},
           ElevationTable<double>(2), seen_from({20, 60}));
  twin<D3>(cases, "elevation table/double", "pdf with the sine",
           "pdf has the sine of the polar angle too many", {CauseKind::sine},
           ElevationTable<double>(5), seen_from({20, 60}));
}

}  // namespace plumbline::tests::corpus
