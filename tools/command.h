#pragma once

#include <functional>

namespace CLI {
class App;
}

/// The subcommands of `plumbline`. Each function declares one; when the command line names it, it
/// sets `run` to what is to be done, whose result is the exit code.
namespace plumbline::tools {

inline constexpr int kExitFine = 0;
inline constexpr int kExitUnexpectedVerdict = 1;  ///< a check did not give its expected verdict
inline constexpr int kExitBadInput = 2;           ///< the user's mistake: usage, files, values
inline constexpr int kExitMachineFailed = 3;      ///< disk full, out of memory

using Run = std::function<int()>;

void add_list_command(CLI::App& app, Run& run);
void add_render_command(CLI::App& app, Run& run);
void add_calibrate_command(CLI::App& app, Run& run);
void add_compare_command(CLI::App& app, Run& run);
void add_report_command(CLI::App& app, Run& run);

}  // namespace plumbline::tools
