#include "bsdf_layers.h"
#include "bsdf_case.h"
#include "bsdf_families.h"

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

void add_layers_cases(std::vector<Case>& cases) {
  correct<D3>(cases, "layers by albedo/alpha 0.3/double", AlbedoLayers<double>(0.3),
              seen_from({0, 60, 85}));
  correct<F3>(cases, "layers by albedo/alpha 0.1/float", AlbedoLayers<float>(0.1F),
              seen_from({30, 70}));
  correct<D3>(cases, "principled/double", principled<double>(), principled_options({60}, true));
  correct<F3>(cases, "principled/float", principled<float>(), principled_options({30}));
  correct<D3>(cases, "principled/opaque/double", opaque<double>(), principled_options({0, 75}));
  correct<F3>(cases, "principled/opaque/float", opaque<float>(), principled_options({45}));

  twin<D3>(cases, "layers by albedo/alpha 0.3/double", "coat without its probability",
           "pdf has the coat without the probability of its choice", {CauseKind::lobe_probability},
           AlbedoLayers<double>(0.3, 0.7, 2), seen_from({20, 80}));
  twin<D3>(cases, "layers by albedo/alpha 0.3/double", "dimmed for wo alone",
           "the base is dimmed by 1 - E(wo), not by that of wi", {CauseKind::asymmetric},
           AlbedoLayers<double>(0.3, 0.7, 4), seen_from({20, 80}));
  twin<D3>(cases, "layers by albedo/alpha 0.3/double", "mean albedo twice",
           "the base is divided by 1 - mean albedo twice", {CauseKind::energy},
           AlbedoLayers<double>(0.3, 1.0, 5), seen_from({20, 50}));
  twin<D3>(cases, "principled/opaque/double", "coat samples alpha",
           "the coat's map has alpha where its square belongs", {CauseKind::roughness},
           opaque<double>(1), principled_options({20, 60}));
  twin<D3>(cases, "principled/double", "shares of the front at the back",
           "pdf weighs the lobes from below as from above",
           {CauseKind::lobe_probability, CauseKind::constant}, principled<double>(3),
           principled_options({40}, true));
  twin<D3>(cases, "principled/opaque/double", "diffuse for wo alone",
           "the diffuse part has the Fresnel rise for wo alone", {CauseKind::asymmetric},
           opaque<double>(7), principled_options({20, 60}));
}

}  // namespace plumbline::tests::corpus
