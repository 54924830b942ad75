#pragma once

#include <span>
#include <string_view>

/// What is fed with hostile bytes: each target hands them to a reader of what users hand us, and to
/// what is done with the result. A reader may refuse with the errors that it documents; any other
/// exception leaves the target, as a crash, a leak, undefined behaviour, too much memory or time
/// do, which is what the fuzzer looks for.
namespace plumbline::tests {

struct FuzzTarget {
  std::string_view name;  ///< its inputs lie in tests/fuzz/inputs/NAME
  void (*run)(std::string_view bytes);
};

/// A scene file: loaded, and rendered to 2×2 pixels.
void fuzz_scene(std::string_view bytes);

/// The mesh of a scene: likewise.
void fuzz_mesh(std::string_view bytes);

/// An EXR file: read, written again, and as the environment of a scene.
void fuzz_image(std::string_view bytes);

/// An EXR file as `compare` and `merge` take it: held against another image of its size, channel by
/// channel, and merged.
void fuzz_compare(std::string_view bytes);

/// What stands behind options of the command line, a line for each.
void fuzz_values(std::string_view bytes);

/// An array in NumPy's format, as a program under test sends it: its header.
void fuzz_npy(std::string_view bytes);

/// A history of nights, an SQLite file: opened, and read as `history` does.
void fuzz_history(std::string_view bytes);

/// A file of records in a results directory: read, and made into a page.
void fuzz_records(std::string_view bytes);

/// What a program under test says over the pipe, and the files of options and waivers.
void fuzz_exchange(std::string_view bytes);

inline constexpr FuzzTarget kFuzzTargets[] = {
    {"scene", fuzz_scene},     {"mesh", fuzz_mesh},       {"image", fuzz_image},
    {"compare", fuzz_compare}, {"values", fuzz_values},   {"npy", fuzz_npy},
    {"history", fuzz_history}, {"records", fuzz_records}, {"exchange", fuzz_exchange}};

}  // namespace plumbline::tests
