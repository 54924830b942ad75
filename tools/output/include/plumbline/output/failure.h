#pragma once

#include <exception>
#include <string>
#include <string_view>
#include <system_error>

/// What went wrong, as an exit code and a message.
namespace plumbline::output {

inline constexpr int kExitFine = 0;
inline constexpr int kExitUnexpectedVerdict = 1;  ///< a check did not give its expected verdict
inline constexpr int kExitBadInput = 2;           ///< the user's mistake: usage, files, values
inline constexpr int kExitMachineFailed = 3;  ///< disk full, out of memory, of threads or of files

struct Failure {
  int exit_code;
  std::string what;
};

/// Whose fault it is: the machine's where it lacks room, memory, files or threads or a device
/// fails, the user's for all else that the system says of a path (missing, forbidden, a loop of
/// links).
int exit_code_of(const std::error_code& error) noexcept;

/// The exit code and the message of what was thrown: renderer::InputError and std::invalid_argument
/// are the user's, std::bad_alloc and renderer::MachineError the machine's, std::system_error by
/// its code; what nobody expects is the machine's.
Failure failure_of(const std::exception_ptr& thrown) noexcept;

/// The last error of the system as one of renderer's, "path: what".
///
/// @throws renderer::InputError or renderer::MachineError, as `exit_code_of` says
[[noreturn]] void throw_errno(const std::string& path, const char* what, int error);

/// Writes to the standard error, and goes on where that is closed or full: who reads it is told no
/// other way.
void tell(std::string_view text) noexcept;

}  // namespace plumbline::output
