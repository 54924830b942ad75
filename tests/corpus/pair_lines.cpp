#include "pair_lines.h"
#include "pair_support.h"

namespace plumbline::tests::corpus {

void add_lines(std::vector<Case>& cases);

/// Lines: correct ones, and twins with one edit.
void add_lines(std::vector<Case>& cases) {
  cases.push_back(correct("truncated exponential/double", [] {
    return line("truncated exponential", 0.0, 1.5, TruncatedExponential<double>{0, 2, 1.5});
  }));
  cases.push_back(twin(
      "truncated exponential/double/not truncated", "pdf over the half-line", {Kind::constant}, [] {
        return line("truncated exponential", 0.0, 1.5, TruncatedExponential<double>{1, 2, 1.5});
      }));
  cases.push_back(correct("truncated exponential/float", [] {
    return line("truncated exponential", 0.0F, 1.5F, TruncatedExponential<float>{0, 2, 1.5F});
  }));
  cases.push_back(
      twin("truncated exponential/float/σ missing", "exp(−σt) without σ", {Kind::constant}, [] {
        return line("truncated exponential", 0.0F, 1.5F, TruncatedExponential<float>{2, 2, 1.5F});
      }));
  cases.push_back(
      correct("distance or surface/double", [] { return distance_or_surface<double>(1.3, 2); }));
  cases.push_back(twin("distance or surface/double/mass of the others",
                       "the atom's mass is 1 − exp(−σd)", {Kind::atom_as_density},
                       [] { return distance_or_surface<double>(1.3, 2, 2); }));
  cases.push_back(twin("distance or surface/double/just before the surface",
                       "who gets through is set just before the surface", {Kind::on_a_line},
                       [] { return distance_or_surface<double>(1.3, 2, 3); }));
  cases.push_back(
      correct("distance or surface/float", [] { return distance_or_surface<float>(1.3F, 2); }));
  cases.push_back(correct("delta tracking/double", [] {
    return line("delta tracking", 0.0, 3.0, DeltaTracking<double>{0, 3});
  }));
  cases.push_back(twin("delta tracking/double/retries not in the pdf",
                       "who gets through starts again", {Kind::not_rejected, Kind::constant}, [] {
                         return line("delta tracking", 0.0, 3.0, DeltaTracking<double>{1, 3});
                       }));
  cases.push_back(twin("delta tracking/double/as if truncated",
                       "pdf given that there is a collision, sampler rejects",
                       {Kind::not_rejected, Kind::constant}, [] {
                         return line("delta tracking", 0.0, 3.0, DeltaTracking<double>{2, 3});
                       }));
  cases.push_back(twin("delta tracking/double/medium reversed",
                       "density of the medium looked up from the far end", {Kind::mirrored}, [] {
                         return line("delta tracking", 0.0, 3.0, DeltaTracking<double>{3, 3});
                       }));
  cases.push_back(correct("equi-angular/double", [] {
    return line("equi-angular", 0.0, 4.0, EquiAngular<double>{0, 1.2, 0.3, 4});
  }));
  cases.push_back(twin("equi-angular/double/from the origin",
                       "distance along the ray from its start, not from the nearest point",
                       {Kind::shifted}, [] {
                         return line("equi-angular", 0.0, 4.0, EquiAngular<double>{1, 1.2, 0.3, 4});
                       }));
  cases.push_back(twin("equi-angular/double/height missing", "the light's distance missing",
                       {Kind::constant}, [] {
                         return line("equi-angular", 0.0, 4.0, EquiAngular<double>{2, 1.2, 0.3, 4});
                       }));
  cases.push_back(twin("equi-angular/double/whole line", "π in place of the segment's angle",
                       {Kind::constant}, [] {
                         return line("equi-angular", 0.0, 4.0, EquiAngular<double>{3, 1.2, 0.3, 4});
                       }));
  cases.push_back(correct("equi-angular/float", [] {
    return line("equi-angular", 0.0F, 4.0F, EquiAngular<float>{0, 1.2F, 0.05F, 4});
  }));
  cases.push_back(correct("visible wavelengths/float", [] {
    return line("visible wavelengths", 360.0F, 830.0F, VisibleWavelengths<float>{0});
  }));
  cases.push_back(twin(
      "visible wavelengths/float/other centre", "pdf around 558 nm", {Kind::shifted},
      [] { return line("visible wavelengths", 360.0F, 830.0F, VisibleWavelengths<float>{1}); }));
  cases.push_back(correct("visible wavelengths/double", [] {
    return line("visible wavelengths", 360.0, 830.0, VisibleWavelengths<double>{0});
  }));
  cases.push_back(correct("trimmed logistic/double", [] {
    return line("trimmed logistic", -pi_v<double>, pi_v<double>,
                TrimmedLogistic<double>{0, 0.9, 0.8});
  }));
  cases.push_back(twin("trimmed logistic/double/mirrored", "pdf at φ + centre for φ − centre",
                       {Kind::mirrored, Kind::shifted}, [] {
                         return line("trimmed logistic", -pi_v<double>, pi_v<double>,
                                     TrimmedLogistic<double>{1, 0.9, 0.8});
                       }));
  cases.push_back(correct("trimmed logistic/float", [] {
    return line("trimmed logistic", -pi_v<float>, pi_v<float>,
                TrimmedLogistic<float>{0, 0.2F, 0.8F});
  }));
  cases.push_back(correct("von Mises/double", [] {
    return line("von Mises", -pi_v<double>, pi_v<double>, VonMises<double>{0, 4});
  }));
  cases.push_back(correct("tent/float", [] {
    return line("tent", -2.0F, 2.0F, Tent<float>{0, 2});
  }));
  cases.push_back(twin("tent/float/1/r missing", "height of the tent 1", {Kind::constant}, [] {
    return line("tent", -2.0F, 2.0F, Tent<float>{1, 2});
  }));
  cases.push_back(correct("smoothstep/float", [] {
    return line("smoothstep", 1.0F, 3.0F, SmoothStep<float>{0, 1, 3});
  }));
  cases.push_back(twin("smoothstep/float/half", "half the density", {Kind::constant}, [] {
    return line("smoothstep", 1.0F, 3.0F, SmoothStep<float>{1, 1, 3});
  }));
  cases.push_back(
      twin("smoothstep/float/downwards", "pdf of the step downwards", {Kind::mirrored}, [] {
        return line("smoothstep", 1.0F, 3.0F, SmoothStep<float>{2, 1, 3});
      }));
  cases.push_back(correct("tabulated, constant/float", [] {
    return line("tabulated, constant", 0.0F, 1.0F,
                Tabulated<float>(0, false, spectrum_table<float>()));
  }));
  cases.push_back(
      twin("tabulated, constant/float/next cell", "pdf of the next cell", {Kind::shifted}, [] {
        return line("tabulated, constant", 0.0F, 1.0F,
                    Tabulated<float>(2, false, spectrum_table<float>()));
      }));
  cases.push_back(correct("tabulated, linear/double", [] {
    return line("tabulated, linear", 0.0, 1.0,
                Tabulated<double>(0, true, spectrum_table<double>()));
  }));
  cases.push_back(correct("two Gaussians/double",
                          [] { return line("two Gaussians", 0.0, 1.0, TwoGaussians<double>{0}); }));
  cases.push_back(twin("two Gaussians/double/clamped", "clamped to the interval, not retried",
                       {Kind::on_a_line},
                       [] { return line("two Gaussians", 0.0, 1.0, TwoGaussians<double>{3}); }));
}

}  // namespace plumbline::tests::corpus
