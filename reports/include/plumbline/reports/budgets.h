#pragma once

#include <cstddef>
#include <cstdint>

/// What files of results may ask for, all in one place; for scenes and images it is the renderer's
/// image_io/budgets.h. A run of the gate writes some thousand records of a few kilobytes, a year of
/// nights one record of a megabyte.
namespace plumbline::reports {

/// Of one file, which is read whole.
inline constexpr std::uintmax_t kMaxResultsFileBytes = std::uintmax_t{256} << 20;
/// Twice the checks that the error budget is split over (verify's ErrorBudget).
inline constexpr std::size_t kMaxRecords = 2'000'000;
/// Of one record: 16 times a year of nights.
inline constexpr std::size_t kMaxRecordBytes = std::size_t{16} << 20;
/// Numbers, strings, arrays, … in one record, five times a year of nights: two bytes of text can
/// make a value, which takes 40 in memory.
inline constexpr std::size_t kMaxRecordValues = std::size_t{1} << 20;
/// Of an object, whose members are found one after the other; the largest of ours has 40.
inline constexpr std::size_t kMaxMembers = 1000;
/// Levels; the deepest of ours has 6. Values are written by recursion.
inline constexpr std::size_t kMaxJsonNesting = 100;
/// Of all pictures of a page: eight of 3840x2160. A browser holds six bytes for each in memory.
inline constexpr std::uint64_t kMaxPagePixels = std::uint64_t{1} << 26;

}  // namespace plumbline::reports
