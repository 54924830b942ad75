#include <plumbline/verify/pair.h>

#include "pairs/uniforms.h"

namespace plumbline::verify {

std::optional<SampleRecord> SamplingPair::next(Random& random) const {
  return draw ? draw(random) : sample(draw_uniforms(random, numbers, epsilon));
}

}  // namespace plumbline::verify
