#include "bsdf_case.h"
#include "bsdf_families.h"
#include "bsdf_glass.h"

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

void add_sealed_glass_cases(std::vector<Case>& cases) {
  twin<D3>(cases, "smooth glass/double", "eta not turned inside",
           "refraction from inside takes eta, not 1/eta",
           {CauseKind::refraction_jacobian, CauseKind::support}, SmoothGlass<double>{1.5, true, 1},
           glass_options({20, 60}));
  twin<D3>(cases, "smooth glass/double", "both atoms of pdf 1",
           "B19: reflection and refraction both state a pdf of 1", {CauseKind::atom_as_density},
           SmoothGlass<double>{1.5, true, 2}, glass_options({20, 60}));
  twin<D3>(cases, "smooth glass/double", "eta squared upside down",
           "the weight of refraction holds eta squared, not its inverse",
           {CauseKind::eta_squared, CauseKind::energy}, SmoothGlass<double>{1.5, true, 4},
           glass_options({20, 60}));
  twin<D3>(cases, "thin pane/double", "mass of one surface",
           "the masses are those of one surface, the choice that of both",
           {CauseKind::atom_as_density, CauseKind::fresnel}, ThinPane{1.5, 1},
           from_both_faces({20, 60}));
  twin<D3>(cases, "smooth coat/double", "density without the choice",
           "the diffuse pdf lacks the probability of its choice",
           {CauseKind::lobe_probability, CauseKind::constant}, coat<double>(1),
           coat_options({20, 75}));
  twin<D3>(cases, "smooth coat/double", "the other lobe's probability",
           "the diffuse pdf has the probability of the mirror",
           {CauseKind::lobe_probability, CauseKind::constant}, coat<double>(2),
           coat_options({20, 75}));
  twin<F3>(cases, "smooth coat/float", "atom of mass 1",
           "B19: the mirror states a probability of 1", {CauseKind::atom_as_density},
           coat<float>(4), coat_options({20, 75}));
  twin<D3>(
      cases, "rough glass/alpha 0.3/double", "refraction without eta squared",
      "the Jacobian of refraction lacks the square of eta",
      {CauseKind::refraction_jacobian, CauseKind::constant_per_hemisphere, CauseKind::eta_squared},
      glass(0.3, 2), glass_options({20, 60}));
  twin<D3>(cases, "rough glass/alpha 0.3/double", "pdf without F",
           "B31: sample chooses by F, pdf has neither F nor 1 - F",
           {CauseKind::fresnel, CauseKind::lobe_probability}, glass(0.3, 5),
           glass_options({20, 60}));
  twin<F3>(cases, "rough glass/alpha 0.3/float", "refraction without 1 - F",
           "the pdf of refraction lacks 1 - F", {CauseKind::fresnel, CauseKind::lobe_probability},
           glass(0.3F, 6), glass_options({20, 60}));
  twin<D3>(cases, "rough glass/alpha 0.3/double", "f without 1 - F", "refraction in f lacks 1 - F",
           {CauseKind::energy, CauseKind::fresnel}, glass(0.3, 9), glass_options({20, 60}));
  twin<D3>(cases, "rough glass/alpha 0.3/two numbers/double", "max of F and max of 1 - F",
           "T1: pdf has probabilities for the two sides that do not sum to 1",
           {CauseKind::constant_per_hemisphere, CauseKind::lobe_probability, CauseKind::fresnel},
           glass_of_two(0.3, 2), glass_options({20, 60}));
}

}  // namespace plumbline::tests::corpus
