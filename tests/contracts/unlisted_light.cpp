// Compiled by a test: with PLUMBLINE_UNLISTED it must not compile, without it must.
#include "light_examples.h"

namespace {

struct LightWithoutExamples : plumbline::renderer::ConstantEnvironment {};

#ifdef PLUMBLINE_UNLISTED
using Lights = std::variant<plumbline::renderer::SphereLight, LightWithoutExamples>;
#else
using Lights = std::variant<plumbline::renderer::SphereLight>;
#endif

}  // namespace

int main() { return plumbline::tests::all_light_examples<Lights>().empty() ? 1 : 0; }
