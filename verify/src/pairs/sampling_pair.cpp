#include <plumbline/verify/pair.h>

namespace plumbline::verify {

std::optional<PairSample> SamplingPair::next(Random& random) const {
  if (draw) return draw(random);
  Uniforms u{};
  for (int i = 0; i < numbers; ++i) {
    u[static_cast<std::size_t>(i)] =
        epsilon > 0x1p-40 ? static_cast<double>(random.uniform_float()) : random.uniform();
  }
  return sample(u);
}

}  // namespace plumbline::verify
