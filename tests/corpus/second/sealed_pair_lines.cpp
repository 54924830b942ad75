// The second set of faulty twins: kept apart until it had been scored once.
#include "pair_lines.h"
#include "pair_support.h"

namespace plumbline::tests::corpus {

void add_sealed_lines(std::vector<Case>& cases);

/// Lines: twins.
void add_sealed_lines(std::vector<Case>& cases) {
  cases.push_back(twin(
      "truncated exponential/double/clamped", "distances beyond the end set to the end",
      {Kind::on_a_line}, [] {
        return line("truncated exponential", 0.0, 1.5, TruncatedExponential<double>{3, 2, 1.5});
      }));
  cases.push_back(twin("distance or surface/double/density 1 at the surface",
                       "the atom has a density of 1 in the record (B19)", {Kind::atom_as_density},
                       [] { return distance_or_surface<double>(1.3, 2, 1); }));
  cases.push_back(twin(
      "visible wavelengths/float/width missing", "0.0072 missing", {Kind::constant},
      [] { return line("visible wavelengths", 360.0F, 830.0F, VisibleWavelengths<float>{3}); }));
  cases.push_back(twin(
      "visible wavelengths/double/not truncated", "pdf over all wavelengths", {Kind::constant},
      [] { return line("visible wavelengths", 360.0, 830.0, VisibleWavelengths<double>{2}); }));
  cases.push_back(
      twin("trimmed logistic/double/not trimmed", "pdf over the whole line", {Kind::constant}, [] {
        return line("trimmed logistic", -pi_v<double>, pi_v<double>,
                    TrimmedLogistic<double>{2, 0.9, 0.8});
      }));
  cases.push_back(
      twin("trimmed logistic/double/centre forgotten", "pdf around 0", {Kind::shifted}, [] {
        return line("trimmed logistic", -pi_v<double>, pi_v<double>,
                    TrimmedLogistic<double>{4, 0.9, 0.8});
      }));
  cases.push_back(twin("trimmed logistic/float/scale missing", "1/s missing", {Kind::constant}, [] {
    return line("trimmed logistic", -pi_v<float>, pi_v<float>,
                TrimmedLogistic<float>{3, 0.2F, 0.8F});
  }));
  cases.push_back(twin("von Mises/double/2π missing", "2π missing", {Kind::constant}, [] {
    return line("von Mises", -pi_v<double>, pi_v<double>, VonMises<double>{1, 4});
  }));
  cases.push_back(
      twin("von Mises/double/not rejected", "every candidate is kept", {Kind::not_rejected}, [] {
        return line("von Mises", -pi_v<double>, pi_v<double>, VonMises<double>{2, 4});
      }));
  cases.push_back(twin("tent/float/right half reversed",
                       "1 − √u and √u exchanged on the right: fewest in the middle",
                       {Kind::mirrored}, [] {
                         return line("tent", -2.0F, 2.0F, Tent<float>{3, 2});
                       }));
  cases.push_back(twin("tabulated, constant/float/half a cell", "pdf half a cell to the side",
                       {Kind::shifted}, [] {
                         return line("tabulated, constant", 0.0F, 1.0F,
                                     Tabulated<float>(1, false, spectrum_table<float>()));
                       }));
  cases.push_back(twin("tabulated, constant/float/number not stretched",
                       "the number that chose the cell is used again as it is (L6)",
                       {Kind::numbers_reused}, [] {
                         return line("tabulated, constant", 0.0F, 1.0F,
                                     Tabulated<float>(5, false, spectrum_table<float>()));
                       }));
  cases.push_back(
      twin("tabulated, linear/double/half a cell", "nodes taken for centres", {Kind::shifted}, [] {
        return line("tabulated, linear", 0.0, 1.0,
                    Tabulated<double>(1, true, spectrum_table<double>()));
      }));
  cases.push_back(twin("tabulated, linear/double/mirrored", "pdf at 1 − x", {Kind::mirrored}, [] {
    return line("tabulated, linear", 0.0, 1.0,
                Tabulated<double>(3, true, spectrum_table<double>()));
  }));
  cases.push_back(twin("tabulated, linear/double/cells not counted", "number of cells missing",
                       {Kind::constant}, [] {
                         return line("tabulated, linear", 0.0, 1.0,
                                     Tabulated<double>(4, true, spectrum_table<double>()));
                       }));
  cases.push_back(twin("two Gaussians/double/retries not in the pdf",
                       "pdf of the Gaussians over the whole line",
                       {Kind::not_rejected, Kind::lobe_probability},
                       [] { return line("two Gaussians", 0.0, 1.0, TwoGaussians<double>{1}); }));
  cases.push_back(twin("two Gaussians/double/even weights", "pdf of equal weights",
                       {Kind::lobe_probability},
                       [] { return line("two Gaussians", 0.0, 1.0, TwoGaussians<double>{2}); }));
  cases.push_back(twin("two Gaussians/double/nearer lobe only",
                       "pdf of the nearer lobe, without its weight", {Kind::chosen_lobe_only},
                       [] { return line("two Gaussians", 0.0, 1.0, TwoGaussians<double>{4}); }));
}

}  // namespace plumbline::tests::corpus
