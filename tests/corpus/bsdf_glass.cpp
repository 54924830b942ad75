#include "bsdf_glass.h"
#include "bsdf_case.h"
#include "bsdf_families.h"

namespace plumbline::tests::corpus {

namespace {

using F3 = V3<float>;
using D3 = V3<double>;

template <class T>
RoughGlass<T> glass(T alpha, int fault = 0, bool radiance = true) {
  return {{alpha, alpha}, T(1.5), radiance, fault};
}

template <class T>
RoughGlassOfTwo<T> glass_of_two(T alpha, int choice_fault = 0) {
  return {glass(alpha), choice_fault};
}

[[maybe_unused]] BsdfOptions glass_options(std::vector<double> angles) {
  return from_both_faces(std::move(angles), 1.5);
}

/// f without η² sends as much light on as arrives, and is not symmetric.
[[maybe_unused]] BsdfOptions unscaled_options(std::vector<double> angles) {
  BsdfOptions options = from_both_faces(std::move(angles));
  options.reciprocal = false;
  return options;
}

/// Atoms are held against Snell's law, for which η is stated; the energy of what is not scaled
/// cannot be asked for then.
[[maybe_unused]] BsdfOptions unscaled_atoms(std::vector<double> angles) {
  BsdfOptions options = glass_options(std::move(angles));
  options.reciprocal = false;
  options.conserves_energy = false;
  return options;
}

[[maybe_unused]] BsdfOptions coat_options(std::vector<double> angles, bool back = false) {
  BsdfOptions options = seen_from(std::move(angles), back);
  options.conventions.zero_pdf_is_failure = true;
  return options;
}

template <class T>
SmoothCoat<T> coat(int fault = 0, bool two_sided = false) {
  return {T(1.5), T(0.6), two_sided, fault};
}

}  // namespace

void add_glass_cases(std::vector<Case>& cases) {
  correct<F3>(cases, "smooth glass/float", SmoothGlass<float>{}, glass_options({0, 45, 89}));
  correct<D3>(cases, "smooth glass/unscaled/double", SmoothGlass<double>{1.5, false},
              unscaled_atoms({20, 80}));
  correct<D3>(cases, "thin pane/double", ThinPane{}, from_both_faces({0, 60, 85}));
  correct<F3>(cases, "smooth coat/float", coat<float>(), coat_options({0, 60, 85}));
  correct<D3>(cases, "smooth coat/grazing/double", coat<double>(), coat_options({80, 88, 89}));
  correct<D3>(cases, "smooth coat/two-sided/double", coat<double>(0, true),
              coat_options({10, 70}, true));
  correct<D3>(cases, "rough glass/alpha 0.2/double", glass(0.2), glass_options({0, 60}));
  correct<F3>(cases, "rough glass/alpha 0.5/float", glass(0.5F), glass_options({30, 80}));
  correct<D3>(cases, "rough glass/alpha 0.02/double", glass(0.02), glass_options({50}));
  correct<D3>(cases, "rough glass/alpha 0.3/unscaled/double", glass(0.3, 0, false),
              unscaled_options({20, 70}));
  correct<D3>(cases, "rough glass/alpha 1/two numbers/double", glass_of_two(1.0),
              glass_options({40}));
  correct<F3>(cases, "rough glass/alpha 0.15/two numbers/float", glass_of_two(0.15F),
              glass_options({10, 60}));

  twin<F3>(cases, "smooth glass/float", "refraction with F",
           "the record of refraction states F, not 1 - F",
           {CauseKind::atom_as_density, CauseKind::fresnel}, SmoothGlass<float>{1.5F, true, 3},
           glass_options({20, 60}));
  twin<D3>(cases, "smooth coat/double", "choice of wi in pdf",
           "T3: pdf weighs by the Fresnel term of wi, sample by that of wo",
           {CauseKind::lobe_probability, CauseKind::fresnel, CauseKind::directions_swapped},
           coat<double>(3), coat_options({20, 75}));
  twin<D3>(cases, "smooth coat/double", "atom not said to be one",
           "the mirror's record does not say that it is an atom",
           {CauseKind::atom_as_density, CauseKind::on_a_line}, coat<double>(5),
           coat_options({20, 75}));
  twin<D3>(cases, "smooth coat/double", "coat takes nothing from below",
           "1 - F is forgotten in the diffuse part", {CauseKind::energy, CauseKind::fresnel},
           SmoothCoat<double>{1.5, 0.9, false, 6}, coat_options({20, 80}));
  twin<D3>(cases, "smooth coat/double", "1 - F on the way out only",
           "the diffuse part has 1 - F for wo alone", {CauseKind::asymmetric, CauseKind::fresnel},
           coat<double>(7), coat_options({20, 75}));
  twin<D3>(cases, "rough glass/alpha 0.3/double", "refraction without wi.h",
           "B5: the pdf of refraction lacks |wi.h|", {CauseKind::refraction_jacobian},
           glass(0.3, 1), glass_options({20, 60}));
  twin<D3>(cases, "rough glass/alpha 0.3/double", "pdf of even sides",
           "pdf has a half for either side where sample chooses by F",
           {CauseKind::fresnel, CauseKind::lobe_probability}, glass(0.3, 3),
           glass_options({20, 60}));
  twin<D3>(cases, "rough glass/alpha 0.3/double", "F and 1 - F exchanged in pdf",
           "pdf has 1 - F for reflection and F for refraction",
           {CauseKind::fresnel, CauseKind::lobe_probability}, glass(0.3, 4),
           glass_options({20, 60}));
  twin<D3>(cases, "rough glass/alpha 0.3/double", "f without eta squared",
           "f is not scaled by the square of eta as radiance is", {CauseKind::eta_squared},
           glass(0.3, 7), glass_options({20, 60}));
  twin<D3>(cases, "rough glass/alpha 0.3/double", "f with eta squared twice",
           "f is divided by the square of eta twice", {CauseKind::eta_squared}, glass(0.3, 8),
           glass_options({20, 60}));
  twin<D3>(cases, "rough glass/alpha 0.3/double", "eta not turned inside",
           "sample takes eta from inside, where pdf and f take 1/eta",
           {CauseKind::refraction_jacobian, CauseKind::support}, glass(0.3, 10),
           glass_options({20, 60}));
  twin<D3>(cases, "rough glass/alpha 0.3/two numbers/double", "number not stretched",
           "L6: the number that chose the side is used as it is", {CauseKind::numbers_reused},
           glass_of_two(0.3, 1), glass_options({20, 60}));
  twin<D3>(cases, "rough glass/alpha 0.3/two numbers/double", "F of the microfacet in pdf",
           "sample chooses by F of the surface, pdf has F of the microfacet",
           {CauseKind::fresnel, CauseKind::lobe_probability}, glass_of_two(0.3, 3),
           glass_options({20, 60}));
}

}  // namespace plumbline::tests::corpus
