#include <plumbline/analytic/pixel_oracle.h>

#include <cstddef>

namespace plumbline::analytic {

Average PixelOracle::pixel_mean(int x, int y) const {
  return box_mean({static_cast<double>(x), static_cast<double>(y), static_cast<double>(x + 1),
                   static_cast<double>(y + 1)});
}

Average PixelOracle::image_mean() const {
  return box_mean({0, 0, static_cast<double>(film_.width), static_cast<double>(film_.height)});
}

std::vector<Colour> PixelOracle::image() const {
  std::vector<Colour> values;
  values.reserve(static_cast<std::size_t>(film_.width) * static_cast<std::size_t>(film_.height));
  for (int y = 0; y < film_.height; ++y) {
    for (int x = 0; x < film_.width; ++x) values.push_back(pixel_mean(x, y).value);
  }
  return values;
}

}  // namespace plumbline::analytic
