#include <cstddef>
#include <cstdint>

#include "targets.h"

/// The entry that libFuzzer calls; which target it is says the build, for each is a program.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  plumbline::tests::PLUMBLINE_FUZZ_TARGET({reinterpret_cast<const char*>(data), size});
  return 0;
}
