#include <plumbline/renderer/assembly/bsdf.h>

#include <stdexcept>
#include <utility>

namespace plumbline::renderer {

BsdfSet::BsdfSet(std::vector<Bsdf> bsdfs) {
  for (Bsdf& bsdf : bsdfs) add(std::move(bsdf));
}

std::uint32_t BsdfSet::add(Bsdf bsdf) {
  const auto index = static_cast<std::uint32_t>(bsdfs_.size());
  const auto add_parts = [&]<class B>(const B& b) {
    if constexpr (NestedBsdf<B>) {
      for (const std::uint32_t child : b.children()) {
        if (child >= index) throw std::invalid_argument("a nested BSDF must follow its children");
      }
      parts_.push_back(b.parts(*this));
    } else {
      parts_.push_back(b.parts());
    }
  };
  std::visit(add_parts, bsdf);
  bsdfs_.push_back(std::move(bsdf));
  return index;
}

BsdfValue<float> BsdfSet::evaluate(std::uint32_t i, const Vec3f& wo, const Vec3f& wi) const {
  return (*this)[i].evaluate(wo, wi);
}

std::optional<BsdfSample<float>> BsdfSet::sample(std::uint32_t i, const Vec3f& wo,
                                                 const Vec2f& u) const {
  return (*this)[i].sample(wo, u);
}

std::shared_ptr<const BsdfSet> make_bsdfs(std::vector<Bsdf> bsdfs) {
  return std::make_shared<const BsdfSet>(std::move(bsdfs));
}

PLUMBLINE_BSDF_REF(template, float)
PLUMBLINE_BSDF_REF(template, double)

}  // namespace plumbline::renderer
