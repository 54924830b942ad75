#include <plumbline/output/failure.h>

#include <cerrno>
#include <cstdio>
#include <new>
#include <stdexcept>

#include <plumbline/renderer/core/errors.h>

namespace plumbline::output {
namespace {

bool is_machines(int error) {
  switch (error) {
    case ENOSPC:
    case EDQUOT:
    case EFBIG:
    case EIO:
    case ENXIO:
    case ENOMEM:
    case EAGAIN:  // no thread to be had
    case EMFILE:
    case ENFILE:
    case ESTALE:
    case ETIMEDOUT:
      return true;
    default:
      return false;
  }
}

Failure rethrown(const std::exception_ptr& thrown) {
  try {
    std::rethrow_exception(thrown);
  } catch (const renderer::InputError& error) {
    return {kExitBadInput, error.what()};
  } catch (const std::invalid_argument& error) {
    return {kExitBadInput, error.what()};
  } catch (const std::bad_alloc&) {
    return {kExitMachineFailed, "out of memory"};
  } catch (const std::system_error& error) {
    return {exit_code_of(error.code()), error.what()};
  } catch (const std::exception& error) {
    return {kExitMachineFailed, error.what()};
  } catch (...) {
    return {kExitMachineFailed, "something that is no std::exception was thrown"};
  }
}

}  // namespace

int exit_code_of(const std::error_code& error) noexcept {
  const bool of_system =
      error.category() == std::generic_category() || error.category() == std::system_category();
  return of_system && !is_machines(error.value()) ? kExitBadInput : kExitMachineFailed;
}

Failure failure_of(const std::exception_ptr& thrown) noexcept {
  try {
    return rethrown(thrown);
  } catch (...) {  // no memory for the message
    return {kExitMachineFailed, {}};
  }
}

void throw_errno(const std::string& path, const char* what, int error) {
  const std::error_code code(error, std::generic_category());
  const std::string text = path + ": " + what + ": " + code.message();
  if (exit_code_of(code) == kExitBadInput) throw renderer::InputError(text);
  throw renderer::MachineError(text);
}

void tell(std::string_view text) noexcept {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

}  // namespace plumbline::output
