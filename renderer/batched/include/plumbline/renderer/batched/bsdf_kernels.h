#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>

#include <plumbline/renderer/batched/shading.h>
#include <plumbline/renderer/core/bsdf/bsdf_sample.h>

// Vectorised loops hold no calls: everything that a kernel calls is made part of it.
#define PLUMBLINE_KERNEL [[gnu::flatten]]

namespace plumbline::renderer {

/// What a batch asks of BSDFs: whole runs of vertices at once, so that the loops are compiled for
/// each type. Who knows the types implements it with the functions below (assembly/).
class BsdfKernels {
 public:
  virtual ~BsdfKernels() = default;

  /// Fills f, cosine and pdf_bsdf for the directions of the light samples.
  virtual void evaluate(std::uint32_t bsdf, Shading& s, Run run) const = 0;

  /// Fills wi, weight, pdf_w, atom_mass and refraction from u and v; all 0 where there is no
  /// sample.
  virtual void sample(std::uint32_t bsdf, Shading& s, Run run) const = 0;
};

/// A copy of what is small: the compiler then knows that no store of the loop changes it.
template <class T>
using Local = std::conditional_t<std::is_trivially_copyable_v<T>, const T, const T&>;

/// @param evaluate  evaluate(wo, wi) of one BSDF
template <class Evaluate>
void evaluate_each(const Evaluate& evaluate, Shading& s, Run run) {
  for (std::size_t k = run.first; k < run.end; ++k) {
    const Vec3f wi = Frame<float>(s.normal[k]).to_local(s.shadow.direction[k]);
    const BsdfValue<float> value = evaluate(s.wo[k], wi);
    s.f.set(k, value.f);
    s.pdf_bsdf[k] = value.pdf_w;
    s.cosine[k] = std::abs(wi.z);
  }
}

inline void store_sample(Shading& s, std::size_t k,
                         const std::optional<BsdfSample<float>>& sample) {
  const bool found = sample.has_value();
  s.wi.set(k, found ? sample->wi : Vec3f{});
  s.weight.set(k, found ? sample->weight : Rgbf{});
  s.pdf_w[k] = found ? sample->pdf_w : 0;
  s.atom_mass[k] = found ? sample->mass : 0;
  s.refraction[k] = found ? sample->radiance_scale : 0;
}

/// @param sample  sample(wo, u) of one BSDF
template <class Sample>
void sample_each(const Sample& sample, Shading& s, Run run) {
  for (std::size_t k = run.first; k < run.end; ++k) {
    store_sample(s, k, sample(s.wo[k], Vec2f{s.u[k], s.v[k]}));
  }
}

/// evaluate_each of a BSDF that nests no others, all in one loop.
template <class B>
PLUMBLINE_KERNEL void evaluate_run(const B& shared, Shading& s, Run run) {
  const Local<B> bsdf = shared;
  evaluate_each([&bsdf](const Vec3f& wo, const Vec3f& wi) { return evaluate_bsdf(wo, wi, bsdf); },
                s, run);
}

/// sample_each of a BSDF that nests no others, all in one loop: written out, because g++ 12 does
/// not vectorise it for a Lambertian through a lambda.
template <class B>
PLUMBLINE_KERNEL void sample_run(const B& shared, Shading& s, Run run) {
  const Local<B> bsdf = shared;
  for (std::size_t k = run.first; k < run.end; ++k) {
    store_sample(s, k, bsdf.sample(s.wo[k], Vec2f{s.u[k], s.v[k]}));
  }
}

}  // namespace plumbline::renderer
