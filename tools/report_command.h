#pragma once

#include <filesystem>

namespace plumbline::tools {

/// Makes the page of a results directory and prints a summary table.
///
/// Pictures are the EXR files that the render records in the directory name; one that cannot be
/// read is a warning on the page, like every record that cannot.
///
/// @param results_dir  searched for records, subdirectories included (reports::read_results)
/// @param output       the HTML file; replaced only by a whole new page
/// @return             0; 1 where a check did not give its expected verdict, or a record was lost
/// @throws InputError for a directory that holds no results, and an output that cannot be written;
///         MachineError where the disk is full
int run_report(const std::filesystem::path& results_dir, const std::filesystem::path& output);

}  // namespace plumbline::tools
