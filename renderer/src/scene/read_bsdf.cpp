#include <fmt/format.h>

#include <string>
#include <vector>

#include <plumbline/renderer/nearest_name.h>

#include "read_parts.h"
#include "text_file.h"

namespace plumbline::renderer {

std::uint32_t BsdfTable::read(const Element& element) {
  element.allow_attributes({"type", "id", "name"});
  element.type();
  element.file().register_id(element);
  Properties properties(element);
  const Rgbd reflectance = properties.rgb("reflectance", {0.5, 0.5, 0.5});
  properties.finish();
  for (const double channel : {reflectance.r, reflectance.g, reflectance.b}) {
    if (!(channel >= 0 && channel <= 1)) {
      properties.fail("reflectance", "must lie between 0 and 1: more would create energy");
    }
  }
  const auto index = static_cast<std::uint32_t>(bsdfs_.size());
  bsdfs_.emplace_back(Lambertian{rgb_cast<float>(reflectance)});
  if (element.has("id")) by_id_.emplace(element.text("id"), index);
  return index;
}

std::uint32_t BsdfTable::fallback() {
  if (!fallback_) {
    fallback_ = static_cast<std::uint32_t>(bsdfs_.size());
    bsdfs_.emplace_back(Lambertian{{0.5f, 0.5f, 0.5f}});
  }
  return *fallback_;
}

std::uint32_t BsdfTable::resolve(const Element& ref, const std::string& id) const {
  ref.allow_attributes({"id", "name"});
  ref.allow_no_children();
  const auto found = by_id_.find(id);
  if (found != by_id_.end()) return found->second;
  const std::string tag = ref.file().tag_of_id(id);
  if (!tag.empty()) ref.fail(fmt::format("id {} is a <{}>, not a <bsdf>", in_quotes(id), tag));
  std::vector<std::string> known;
  for (const auto& [name, index] : by_id_) known.push_back(name);
  const std::string hint = name_hint(id, known);
  ref.fail(
      fmt::format("no <bsdf> has the id {}{}{}", in_quotes(id), hint.empty() ? "" : "; ", hint));
}

}  // namespace plumbline::renderer
