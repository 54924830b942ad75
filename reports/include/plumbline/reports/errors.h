#pragma once

#include <stdexcept>

namespace plumbline::reports {

/// A text that is not a record of this version: torn, of another format or version, or with a field
/// that is missing or of the wrong kind. `what()` names the format or field at fault.
class FormatError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A record that asks for more than budgets.h has for it.
class BudgetError : public FormatError {
 public:
  using FormatError::FormatError;
};

/// A results directory that cannot be reported: not there, not a directory, empty, or with a file
/// that asks for more than budgets.h has for it.
class ResultsError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A history that cannot be used: no file, no database, of another program or of a newer version.
/// `what()` names the file and what to do.
class HistoryError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace plumbline::reports
