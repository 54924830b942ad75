#pragma once

#include <cstdint>
#include <filesystem>

#include <plumbline/verify/detail/budget.h>

namespace plumbline::tools {

/// Makes the page of a results directory and prints a summary table.
///
/// Pictures are the EXR files that the render records in the directory name; one that cannot be
/// read is a warning on the page, like every record that cannot.
///
/// @param results_dir  searched for records, subdirectories included (reports::read_results)
/// @param output       the HTML file; replaced only by a whole new page
/// @param max_checks   bound on the number of checks that the error budget is split over
/// @return             0; 1 where a check did not give its expected verdict, a record was lost, or
///                     there are more checks than max_checks, so that their levels add up to more
///                     than the budget
/// @throws InputError for a directory that holds no results, and an output that cannot be written;
///         MachineError where the disk is full
int run_report(const std::filesystem::path& results_dir, const std::filesystem::path& output,
               std::uint64_t max_checks = verify::ErrorBudget{}.max_checks);

}  // namespace plumbline::tools
