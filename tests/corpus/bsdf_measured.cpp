#include "bsdf_measured.h"
#include "bsdf_case.h"
#include "bsdf_families.h"

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

void add_measured_cases(std::vector<Case>& cases) {
  correct<D3>(cases, "measured lobe/double", ThetaTable<double>(), theta_options({0, 60}));
  correct<F3>(cases, "measured lobe/float", ThetaTable<float>(), theta_options({30, 75}));
  correct<D3>(cases, "half-vector image/double", HalfImage(), seen_from({0, 50}));
  correct<D3>(cases, "elevation table/double", ElevationTable<double>(), seen_from({0, 60, 85}));
  correct<F3>(cases, "elevation table/float", ElevationTable<float>(), seen_from({40, 70}));

  twin<D3>(cases, "measured lobe/double", "pdf one node further",
           "pdf reads the next node of the table", {CauseKind::shifted}, ThetaTable<double>(2),
           theta_options({20, 60}));
  twin<D3>(cases, "measured lobe/double", "pdf per angle",
           "pdf is per angle, not divided by sin of theta h", {CauseKind::sine},
           ThetaTable<double>(3), theta_options({20, 60}));
  twin<D3>(cases, "half-vector image/double", "cells without their area",
           "cells are chosen without their solid angle", {CauseKind::sine}, HalfImage(1),
           seen_from({0, 50}));
  twin<D3>(cases, "half-vector image/double", "number not stretched",
           "L6: the number that chose the cell places the sample in it",
           {CauseKind::numbers_reused}, HalfImage(2), seen_from({0, 50}));
  twin<D3>(cases, "half-vector image/double", "half a cell aside", "samples are half a column off",
           {CauseKind::shifted}, HalfImage(3), seen_from({0, 50}));
  twin<D3>(cases, "half-vector image/double", "pdf one row further", "pdf reads the next row",
           {CauseKind::shifted}, HalfImage(4), seen_from({0, 50}));
  twin<D3>(cases, "half-vector image/double", "column rounded in pdf",
           "pdf rounds to the nearest column where sample rounds down", {CauseKind::shifted},
           HalfImage(6), seen_from({0, 50}));
  twin<D3>(cases, "half-vector image/double", "cell of the last sample",
           "pdf reads the cell that was sampled last", {CauseKind::stale_state}, HalfImage(7),
           seen_from({0, 50}));
  twin<D3>(cases, "elevation table/double", "rows exchanged in pdf",
           "pdf interpolates with the weights of the two rows exchanged",
           {CauseKind::lobe_probability, CauseKind::shifted}, ElevationTable<double>(3),
           seen_from({10, 86}));
  twin<D3>(cases, "elevation table/double", "row rounded up in pdf",
           "pdf is that of the next row, not interpolated",
           {CauseKind::shifted, CauseKind::lobe_probability}, ElevationTable<double>(4),
           seen_from({10, 86}));
}

}  // namespace plumbline::tests::corpus
