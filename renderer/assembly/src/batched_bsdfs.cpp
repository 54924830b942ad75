#include "batched_bsdfs.h"

#include <plumbline/renderer/assembly/bsdf.h>

namespace plumbline::renderer {
namespace {

class BatchedBsdfs final : public BsdfKernels {
 public:
  explicit BatchedBsdfs(const BsdfSet& set) : set_(set) {}

  void evaluate(std::uint32_t bsdf, Shading& s, Run run) const override {
    std::visit(
        [&]<class B>(const B& b) {
          if constexpr (NestedBsdf<B>) {
            evaluate_each([ref = set_[bsdf]](const Vec3f& wo,
                                             const Vec3f& wi) { return ref.evaluate(wo, wi); },
                          s, run);
          } else {
            evaluate_run(b, s, run);
          }
        },
        set_.alternative(bsdf));
  }

  void sample(std::uint32_t bsdf, Shading& s, Run run) const override {
    std::visit(
        [&]<class B>(const B& b) {
          if constexpr (NestedBsdf<B>) {
            sample_each(
                [ref = set_[bsdf]](const Vec3f& wo, const Vec2f& u) { return ref.sample(wo, u); },
                s, run);
          } else {
            sample_run(b, s, run);
          }
        },
        set_.alternative(bsdf));
  }

 private:
  const BsdfSet& set_;
};

}  // namespace

std::unique_ptr<BsdfKernels> batched_bsdfs(const BsdfTable& table) {
  const auto* set = dynamic_cast<const BsdfSet*>(&table);
  return set == nullptr ? nullptr : std::make_unique<BatchedBsdfs>(*set);
}

}  // namespace plumbline::renderer
