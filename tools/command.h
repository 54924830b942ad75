#pragma once

#include <plumbline/options/options.h>

/// The subcommands of `plumbline`. Each function declares one, and what is to be done when the
/// command line names it.
namespace plumbline::tools {

inline constexpr int kExitFine = 0;
inline constexpr int kExitUnexpectedVerdict = 1;  ///< a check did not give its expected verdict
inline constexpr int kExitBadInput = 2;           ///< the user's mistake: usage, files, values
inline constexpr int kExitMachineFailed = 3;      ///< disk full, out of memory

void add_list_command(options::CommandLine& line);
void add_render_command(options::CommandLine& line);
void add_calibrate_command(options::CommandLine& line);
void add_check_command(options::CommandLine& line);
void add_compare_command(options::CommandLine& line);
void add_report_command(options::CommandLine& line);
void add_verify_command(options::CommandLine& line);
void add_history_command(options::CommandLine& line);
void add_init_command(options::CommandLine& line);

}  // namespace plumbline::tools
