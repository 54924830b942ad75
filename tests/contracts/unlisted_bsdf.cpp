// Compiled by a test: with PLUMBLINE_UNLISTED it must not compile, without it must.
#include <cstddef>
#include <variant>

#include "bsdf/examples.h"

namespace {

struct BsdfWithoutExamples : plumbline::renderer::Lambertian {};

#ifdef PLUMBLINE_UNLISTED
using Bsdfs = std::variant<plumbline::renderer::Lambertian, BsdfWithoutExamples>;
#else
using Bsdfs = plumbline::renderer::Bsdf;
#endif

template <class... B>
std::size_t examples_of_all(const std::variant<B...>*) {
  return (plumbline::tests::examples_of<B>().size() + ...);
}

}  // namespace

int main() { return examples_of_all(static_cast<const Bsdfs*>(nullptr)) > 0 ? 0 : 1; }
