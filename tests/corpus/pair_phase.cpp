#include "pair_phase.h"
#include "pair_support.h"

namespace plumbline::tests::corpus {

void add_phase(std::vector<Case>& cases);

/// Phase functions and spherical lobes: correct ones, and twins with one edit.
void add_phase(std::vector<Case>& cases) {
  cases.push_back(correct("Henyey–Greenstein/0.9/double", [] {
    return recorded_pair_of<Xyz<double>>("Henyey–Greenstein", Domain::sphere(),
                                         HenyeyGreenstein<double>{0, 0.9, medium_axis<double>()});
  }));
  cases.push_back(twin("Henyey–Greenstein/0.9/double/sign of g", "pdf for cosθ of the other sign",
                       {Kind::mirrored}, [] {
                         return recorded_pair_of<Xyz<double>>(
                             "Henyey–Greenstein", Domain::sphere(),
                             HenyeyGreenstein<double>{1, 0.9, medium_axis<double>()});
                       }));
  cases.push_back(
      twin("Henyey–Greenstein/0.9/double/2π for 4π", "twice the density", {Kind::constant}, [] {
        return recorded_pair_of<Xyz<double>>(
            "Henyey–Greenstein", Domain::sphere(),
            HenyeyGreenstein<double>{2, 0.9, medium_axis<double>()});
      }));
  cases.push_back(correct("Henyey–Greenstein/0.9/float", [] {
    return recorded_pair_of<Xyz<float>>("Henyey–Greenstein", Domain::sphere(),
                                        HenyeyGreenstein<float>{0, 0.9F, medium_axis<float>()});
  }));
  cases.push_back(twin(
      "Henyey–Greenstein/0.9/float/weight is the value",
      "weight is the phase function, not divided by the density", {Kind::weight}, [] {
        return recorded_pair_of<Xyz<float>>("Henyey–Greenstein", Domain::sphere(),
                                            HenyeyGreenstein<float>{5, 0.9F, medium_axis<float>()});
      }));
  cases.push_back(correct("Henyey–Greenstein/-0.5/float", [] {
    return recorded_pair_of<Xyz<float>>("Henyey–Greenstein", Domain::sphere(),
                                        HenyeyGreenstein<float>{0, -0.5F, medium_axis<float>()});
  }));
  cases.push_back(twin("Henyey–Greenstein/-0.5/float/around z",
                       "samples lie around z, pdf around the axis", {Kind::tangent_frame}, [] {
                         return recorded_pair_of<Xyz<float>>(
                             "Henyey–Greenstein", Domain::sphere(),
                             HenyeyGreenstein<float>{3, -0.5F, medium_axis<float>()});
                       }));
  cases.push_back(correct("Henyey–Greenstein/0/double", [] {
    return recorded_pair_of<Xyz<double>>("Henyey–Greenstein", Domain::sphere(),
                                         HenyeyGreenstein<double>{0, 0.0, medium_axis<double>()});
  }));
  cases.push_back(correct("double Henyey–Greenstein/double",
                          [] { return double_henyey_greenstein<double>(false); }));
  cases.push_back(twin("double Henyey–Greenstein/double/even shares", "pdf of equal shares",
                       {Kind::lobe_probability},
                       [] { return double_henyey_greenstein<double>(false, 2); }));
  cases.push_back(twin("double Henyey–Greenstein/double/number not stretched",
                       "the number that chose the lobe is used again as it is (L6)",
                       {Kind::numbers_reused},
                       [] { return double_henyey_greenstein<double>(false, 3); }));
  cases.push_back(twin("double Henyey–Greenstein/double/weight of the chosen lobe",
                       "weight of the chosen lobe over the pdf of both (B8)",
                       {Kind::chosen_lobe_only, Kind::weight},
                       [] { return double_henyey_greenstein<double>(false, 4); }));
  cases.push_back(correct("double Henyey–Greenstein with lobes stated/float",
                          [] { return double_henyey_greenstein<float>(true); }));
  cases.push_back(correct("Rayleigh/double", [] {
    return light("Rayleigh", Rayleigh<double>{0, medium_axis<double>()});
  }));
  cases.push_back(correct("Rayleigh/float", [] {
    return light("Rayleigh", Rayleigh<float>{0, medium_axis<float>()});
  }));
  cases.push_back(correct("Schlick phase function/float", [] {
    return light("Schlick phase function", SchlickPhase<float>{0, 0.7F, medium_axis<float>()});
  }));
  cases.push_back(twin(
      "Schlick phase function/float/sign of k", "pdf for the other sign of k", {Kind::mirrored},
      [] {
        return light("Schlick phase function", SchlickPhase<float>{1, 0.7F, medium_axis<float>()});
      }));
  cases.push_back(correct("von Mises–Fisher/5/float", [] {
    return light("von Mises–Fisher", VonMisesFisher<float>{0, 5, medium_axis<float>()});
  }));
  cases.push_back(
      twin("von Mises–Fisher/5/float/4π for 2π", "half the density", {Kind::constant}, [] {
        return light("von Mises–Fisher", VonMisesFisher<float>{2, 5, medium_axis<float>()});
      }));
  cases.push_back(correct("von Mises–Fisher/200/float", [] {
    return light("von Mises–Fisher", VonMisesFisher<float>{0, 200, medium_axis<float>()});
  }));
  cases.push_back(correct("von Mises–Fisher/1e4/float", [] {
    return light("von Mises–Fisher", VonMisesFisher<float>{0, 1e4F, medium_axis<float>()});
  }));
  cases.push_back(
      twin("von Mises–Fisher/1e4/float/cosine in float", "cosθ and not 1 − cosθ in float (L4)",
           {Kind::precision}, [] {
             return light("von Mises–Fisher", VonMisesFisher<float>{4, 1e6F, medium_axis<float>()});
           }));
  cases.push_back(correct("von Mises–Fisher/1e4/double", [] {
    return light("von Mises–Fisher", VonMisesFisher<double>{0, 1e4, medium_axis<double>()});
  }));
  cases.push_back(correct("spherical Gaussians/double", [] {
    return light("spherical Gaussians", SphericalGaussians<double>::made(0));
  }));
  cases.push_back(twin(
      "spherical Gaussians/double/even weights", "pdf of equal weights", {Kind::lobe_probability},
      [] { return light("spherical Gaussians", SphericalGaussians<double>::made(1)); }));
  cases.push_back(correct("spherical Gaussians/float", [] {
    return light("spherical Gaussians", SphericalGaussians<float>::made(0));
  }));
  cases.push_back(correct("Kent/60, 20/double", [] {
    return light("Kent", Kent<double>(0, 60, 20, {0.48, -0.6, 0.64}));
  }));
  cases.push_back(twin("Kent/60, 20/double/retries not in the pdf", "pdf is the envelope's",
                       {Kind::not_rejected}, [] {
                         return light("Kent", Kent<double>(1, 60, 20, {0.48, -0.6, 0.64}));
                       }));
  cases.push_back(
      twin("Kent/60, 20/double/not rejected", "every candidate is kept", {Kind::not_rejected}, [] {
        return light("Kent", Kent<double>(4, 60, 20, {0.48, -0.6, 0.64}));
      }));
  cases.push_back(correct("transformed cosine/double", [] {
    return light("transformed cosine", TransformedCosine<double>{0, 0.3, 0.4, 0.5, -0.2});
  }));
  cases.push_back(correct("transformed cosine/float", [] {
    return light("transformed cosine", TransformedCosine<float>{0, 0.3F, 0.4F, 0.5F, -0.2F});
  }));
}

}  // namespace plumbline::tests::corpus
