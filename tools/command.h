#pragma once

#include <plumbline/options/options.h>
#include <plumbline/output/failure.h>

/// The subcommands of `plumbline`. Each function declares one, and what is to be done when the
/// command line names it.
namespace plumbline::tools {

using output::kExitBadInput;
using output::kExitFine;
using output::kExitMachineFailed;
using output::kExitUnexpectedVerdict;

void add_list_command(options::CommandLine& line);
void add_render_command(options::CommandLine& line);
void add_calibrate_command(options::CommandLine& line);
void add_check_command(options::CommandLine& line);
void add_compare_command(options::CommandLine& line);
void add_merge_command(options::CommandLine& line);
void add_report_command(options::CommandLine& line);
void add_verify_command(options::CommandLine& line);
void add_history_command(options::CommandLine& line);
void add_init_command(options::CommandLine& line);

}  // namespace plumbline::tools
