// The second set of faulty twins: kept apart until it had been scored once.
#include "pair_phase.h"
#include "pair_support.h"

namespace plumbline::tests::corpus {

void add_sealed_phase(std::vector<Case>& cases);

/// Phase functions and spherical lobes: twins.
void add_sealed_phase(std::vector<Case>& cases) {
  cases.push_back(twin("Henyey–Greenstein/0.9/double/record without 4π",
                       "the record's pdf lacks 1/(4π), pdf() is right", {Kind::record_pdf}, [] {
                         return recorded_pair_of<Xyz<double>>(
                             "Henyey–Greenstein", Domain::sphere(),
                             HenyeyGreenstein<double>{4, 0.9, medium_axis<double>()});
                       }));
  cases.push_back(
      twin("Henyey–Greenstein/0/double/2π for 4π", "twice the density", {Kind::constant}, [] {
        return recorded_pair_of<Xyz<double>>(
            "Henyey–Greenstein", Domain::sphere(),
            HenyeyGreenstein<double>{2, 0.0, medium_axis<double>()});
      }));
  cases.push_back(twin("double Henyey–Greenstein/double/record of the chosen lobe",
                       "the record holds the chosen lobe's pdf (B7)",
                       {Kind::chosen_lobe_only, Kind::record_pdf},
                       [] { return double_henyey_greenstein<double>(false, 1); }));
  cases.push_back(twin("double Henyey–Greenstein/double/one share missing",
                       "probability of the second lobe missing", {Kind::lobe_probability},
                       [] { return double_henyey_greenstein<double>(false, 5); }));
  cases.push_back(twin("double Henyey–Greenstein with lobes stated/float/even shares",
                       "pdf of equal shares", {Kind::lobe_probability},
                       [] { return double_henyey_greenstein<float>(true, 2); }));
  cases.push_back(twin("Rayleigh/double/8π for 16π", "twice the density", {Kind::constant}, [] {
    return light("Rayleigh", Rayleigh<double>{1, medium_axis<double>()});
  }));
  cases.push_back(
      twin("von Mises–Fisher/200/float/sinh overflows",
           "normalised by sinh κ, which is infinite in float", {Kind::not_finite}, [] {
             return light("von Mises–Fisher", VonMisesFisher<float>{1, 200, medium_axis<float>()});
           }));
  cases.push_back(
      twin("von Mises–Fisher/200/float/around z", "samples lie around z, pdf around the axis",
           {Kind::tangent_frame}, [] {
             return light("von Mises–Fisher", VonMisesFisher<float>{3, 200, medium_axis<float>()});
           }));
  cases.push_back(
      twin("spherical Gaussians/double/weights one on", "each lobe with the next one's weight",
           {Kind::lobe_probability, Kind::shifted},
           [] { return light("spherical Gaussians", SphericalGaussians<double>::made(2)); }));
  cases.push_back(
      twin("spherical Gaussians/double/largest lobe",
           "pdf of the largest lobe alone, without its weight", {Kind::chosen_lobe_only},
           [] { return light("spherical Gaussians", SphericalGaussians<double>::made(3)); }));
  cases.push_back(twin("Kent/60, 20/double/rejected, not retried",
                       "candidates are rejected, the pdf is that of retrying",
                       {Kind::not_rejected, Kind::constant}, [] {
                         return light("Kent", Kent<double>(2, 60, 20, {0.48, -0.6, 0.64}));
                       }));
  cases.push_back(twin("Kent/60, 20/double/axes exchanged", "x and y of the ellipse exchanged",
                       {Kind::mirrored}, [] {
                         return light("Kent", Kent<double>(3, 60, 20, {0.48, -0.6, 0.64}));
                       }));
  cases.push_back(
      twin("transformed cosine/double/determinant missing", "|M| missing", {Kind::constant}, [] {
        return light("transformed cosine", TransformedCosine<double>{1, 0.3, 0.4, 0.5, -0.2});
      }));
  cases.push_back(
      twin("transformed cosine/double/cosine missing", "the cosine of the original lobe missing",
           {Kind::cosine}, [] {
             return light("transformed cosine", TransformedCosine<double>{2, 0.3, 0.4, 0.5, -0.2});
           }));
}

}  // namespace plumbline::tests::corpus
