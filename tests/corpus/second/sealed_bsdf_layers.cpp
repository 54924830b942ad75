#include "bsdf_case.h"
#include "bsdf_families.h"
#include "bsdf_layers.h"

namespace plumbline::tests::corpus {

namespace {

using F3 = V3<float>;
using D3 = V3<double>;

[[maybe_unused]] BsdfOptions principled_options(std::vector<double> angles, bool back = false) {
  BsdfOptions options = seen_from(std::move(angles), back);
  options.eta = 1.45;
  options.conserves_energy = false;  // lobes are added, not layered
  return options;
}

template <class T>
Principled<T> principled(int fault = 0) {
  Principled<T> p;
  p.fault = fault;
  return p;
}

/// No glass.
template <class T>
Principled<T> opaque(int fault = 0) {
  Principled<T> p = principled<T>(fault);
  p.transmission = 0;
  p.roughness = T(0.6);
  return p;
}

}  // namespace

void add_sealed_layers_cases(std::vector<Case>& cases) {
  twin<D3>(cases, "layers by albedo/alpha 0.3/double", "choice of wi in pdf",
           "T3: pdf weighs the lobes by the coat's albedo for wi, sample by that for wo",
           {CauseKind::lobe_probability, CauseKind::directions_swapped},
           AlbedoLayers<double>(0.3, 0.7, 1), seen_from({20, 80}));
  twin<D3>(cases, "layers by albedo/alpha 0.3/double", "coat takes nothing from below",
           "the base keeps all of its albedo under the coat",
           {CauseKind::energy, CauseKind::fresnel}, AlbedoLayers<double>(0.2, 0.98, 3),
           seen_from({20, 80}));
  twin<D3>(cases, "principled/double", "choice between the sides not stretched",
           "L6: glass chooses its side by the number that chose glass", {CauseKind::numbers_reused},
           principled<double>(2), principled_options({75}));
  twin<F3>(
      cases, "principled/opaque/float", "coat without cos h",
      "the coat's pdf lacks the cosine of h", {CauseKind::cosine},
      [] {
        auto p = opaque<float>(4);
        p.clearcoat = 4;
        p.gloss = 0;
        return p;
      }(),
      principled_options({20, 60}));
  twin<D3>(
      cases, "principled/opaque/double", "share of the coat not normalised",
      "the coat's share in pdf is not divided by the sum of all", {CauseKind::lobe_probability},
      [] {
        auto p = opaque<double>(5);
        p.clearcoat = 2;
        return p;
      }(),
      principled_options({20, 60}));
  twin<D3>(cases, "principled/opaque/double", "coat without wo.h",
           "the coat's pdf has 1/4 for 1/(4 wo.h)", {CauseKind::half_vector_jacobian},
           opaque<double>(6), principled_options({20, 60}));
}

}  // namespace plumbline::tests::corpus
