#include <vector>

#include <plumbline/verify/pair.h>

#include "pairs/uniforms.h"

namespace plumbline::verify {

std::optional<SampleRecord> SamplingPair::next(Random& random) const {
  return draw ? draw(random) : sample(draw_uniforms(random, numbers, epsilon));
}

void SamplingPair::next(Random& random, std::span<std::optional<SampleRecord>> samples) const {
  if (draw) {
    for (auto& s : samples) s = draw(random);
    return;
  }
  std::vector<Uniforms> u(samples.size());
  for (Uniforms& numbers_of_one : u) numbers_of_one = draw_uniforms(random, numbers, epsilon);
  sample(u, samples);
}

}  // namespace plumbline::verify
