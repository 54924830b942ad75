#pragma once

#include <string>
#include <vector>

#include "off_defaults.h"

/// Pieces that the scenes are put together from.
namespace plumbline::tests {

/// A ray's width of film about the origin, seen from `origin`.
inline std::string eye(const std::string& origin = "0.25 0 1") {
  return R"(<sensor type="perspective"><float name="fov" value="0.05"/><transform name="to_world">
      <lookat origin=")" +
         origin + R"(" target="0 0 0" up="0 1 0"/></transform>
      <film type="hdrfilm"><rfilter type="box"/></film></sensor>
      )";
}

/// Direct light only.
inline const std::string kDirect =
    R"(<integrator type="path"><integer name="max_depth" value="2"/></integrator>
      )";

inline std::string diffuse(const std::string& reflectance) {
  return R"(<bsdf type="diffuse"><rgb name="reflectance" value=")" + reflectance + "\"/></bsdf>";
}

inline std::string sky(const std::string& radiance) {
  return R"(<emitter type="constant"><rgb name="radiance" value=")" + radiance + "\"/></emitter>";
}

/// Of every BSDF.
std::vector<OffDefault> off_default_bsdfs();

}  // namespace plumbline::tests
