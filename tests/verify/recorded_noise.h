#pragma once

#include <plumbline_tests/support.h>

#include <cmath>
#include <cstddef>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <plumbline/verify/detail/random.h>

/// Noise that was recorded from this benchmark set, for simulated nights beside that of
/// history_noise.h. Where, when and how is said in the files.
namespace plumbline::verify::history {

/// What one line of a file holds: several values of each run.
struct Recorded {
  std::string name;
  std::vector<std::vector<double>> runs;  ///< logarithms
};

namespace detail {

constexpr double kStep = 1e-4;  // of the numbers in the files

inline std::vector<Recorded> read_recorded(const char* file, std::size_t values_of_a_run) {
  std::ifstream lines(tests::source_file("tests/verify/") / file);
  std::vector<Recorded> result;
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream words(line);
    Recorded recorded;
    words >> recorded.name;
    std::size_t in_a_run = values_of_a_run;
    if (in_a_run == 0) words >> in_a_run;
    std::size_t read = 0;
    for (int value = 0; words >> value; ++read) {
      if (read % in_a_run == 0) recorded.runs.emplace_back();
      recorded.runs.back().push_back(kStep * value);
    }
    result.push_back(recorded);
  }
  return result;
}

}  // namespace detail

/// Times of 24 numbers over their medians, 60 runs of five repetitions.
inline std::vector<Recorded> recorded_runs() {
  return detail::read_recorded("recorded_runs.txt", 5);
}

/// Ratios of times of identical code, 60 launches of some slices for each of three parts.
inline std::vector<Recorded> recorded_duets() {
  return detail::read_recorded("recorded_duets.txt", 0);
}

/// Runs drawn anew in blocks of neighbours, so that what makes neighbours alike stays.
///
/// @source Politis, Romano 1992, circular block bootstrap
class Blocks {
 public:
  /// @param length  of a block, ≥ 1
  Blocks(Random& random, const Recorded& recorded, std::size_t length)
      : random_(random), runs_(recorded.runs), length_(length) {}

  const std::vector<double>& next() {
    if (left_ == 0) {
      left_ = length_;
      place_ = static_cast<std::size_t>(random_.uniform() * static_cast<double>(runs_.size()));
    }
    --left_;
    return runs_[place_++ % runs_.size()];
  }

 private:
  Random& random_;
  const std::vector<std::vector<double>>& runs_;
  std::size_t length_, left_ = 0, place_ = 0;
};

}  // namespace plumbline::verify::history
