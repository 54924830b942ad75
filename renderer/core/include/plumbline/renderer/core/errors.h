#pragma once

#include <stdexcept>

namespace plumbline::renderer {

/// A mistake of the user: in a file, an argument, a parameter. `what()` is "file:line: what and
/// why" where there is a file. The command turns it into exit code 2.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A file that asks for more than budgets.h has for it, or than it holds.
class BudgetError : public InputError {
 public:
  using InputError::InputError;
};

/// The machine failed us, not the user: a full disk, no memory. The command's exit code 3.
class MachineError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace plumbline::renderer
