#include <sys/personality.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <bit>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <functional>
#include <iostream>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "../clock.h"
#include "heap.h"
#include "instructions.h"
#include "parts.h"

// One side of a duet (docs/compare_runs.md):
//
//   plumbline_duet_worker parts          names them, one a line
//   plumbline_duet_worker count PART     what one unit of its work comes to, a name and a number a
//                                        line
//   plumbline_duet_worker play PART      says "ready"; for each line "go N" does N units and
//   answers
//                                        with the seconds of processor time that they took
namespace plumbline::duet {

std::uint64_t with_bits(std::uint64_t hash, double value) {
  return std::rotl(hash, 5) ^ std::bit_cast<std::uint64_t>(value);
}

namespace {

constexpr std::uint64_t kMostInstructions = 100'000;

std::vector<Part> all_parts() {
  std::vector<Part> parts;
  for (const auto& some : {render_parts(), bsdf_parts(), light_parts(), verify_parts()}) {
    parts.insert(parts.end(), some.begin(), some.end());
  }
  return parts;
}

Part find_part(const std::string& name) {
  for (Part& part : all_parts()) {
    if (part.name == name) return std::move(part);
  }
  throw std::invalid_argument("no part is named '" + name + "'");
}

/// Nothing where two counts differ: how far memory is filled word by word depends on where it lies.
std::optional<std::uint64_t> instructions_of(const Part& part) {
  if (!part.counts_instructions) return std::nullopt;
  const auto count = [&part] {
    return count_instructions(
        [&part]() -> std::function<void()> {
          return [work = part.prepare(Size::counted)] { work(); };
        },
        kMostInstructions);
  };
  const auto counted = count();
  return counted && count() == counted ? counted : std::nullopt;
}

/// Starts this program anew with memory at the same places every time, where the system allows it.
void fix_addresses(char** argv) {
  const int now = personality(0xffffffff);
  if (now < 0 || (now & ADDR_NO_RANDOMIZE) != 0) return;
  if (personality(static_cast<unsigned long>(now | ADDR_NO_RANDOMIZE)) < 0) return;
  execv("/proc/self/exe", argv);
}

void print_counters(const Part& part) {
  const auto instructions = instructions_of(part);
  const Work work = part.prepare(Size::timed);
  work();  // what is made at the first call is not counted
  const HeapUse before = heap_use();
  const Counters counters = work();
  const HeapUse after = heap_use();
  const auto print = [](const char* name, std::uint64_t value) {
    if (value > 0) std::cout << name << " " << value << "\n";
  };
  print("rays", counters.rays);
  print("samples", counters.samples);
  print("bytes", counters.bytes);
  print("heap_bytes", after.bytes - before.bytes);
  print("heap_blocks", after.blocks - before.blocks);
  print("instructions", instructions.value_or(0));
  print("result", counters.result);
}

/// @return units of a line "go N"
std::uint64_t units_of(const std::string& line) {
  std::istringstream words(line);
  std::string word;
  std::uint64_t units = 0;
  if (!(words >> word >> units) || word != "go" || units == 0) {
    throw std::invalid_argument("expected 'go N', got '" + line + "'");
  }
  return units;
}

void play(const Part& part) {
  const Work work = part.prepare(Size::timed);
  std::cout << "ready" << std::endl;  // NOLINT(performance-avoid-endl): the driver waits for it
  Counters counters;
  for (std::string line; std::getline(std::cin, line);) {
    const std::uint64_t units = units_of(line);
    const double seconds = bench::seconds_of([&] {
      for (std::uint64_t i = 0; i < units; ++i) counters += work();
    });
    std::printf("%.9f\n", seconds);
    std::fflush(stdout);
  }
}

int run(const std::vector<std::string>& words, char** argv) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // not one second longer than the driver
  if (words.size() == 1 && words[0] == "parts") {
    for (const Part& part : all_parts()) std::cout << part.name << "\n";
  } else if (words.size() == 2 && words[0] == "count") {
    fix_addresses(argv);
    print_counters(find_part(words[1]));
  } else if (words.size() == 2 && words[0] == "play") {
    play(find_part(words[1]));
  } else {
    throw std::invalid_argument("usage: plumbline_duet_worker parts | count PART | play PART");
  }
  return 0;
}

}  // namespace
}  // namespace plumbline::duet

int main(int argc, char** argv) try {
  return plumbline::duet::run({argv + 1, argv + argc}, argv);
} catch (const std::exception& error) {
  std::cerr << "plumbline_duet_worker: " << error.what() << "\n";
  return 2;
}
