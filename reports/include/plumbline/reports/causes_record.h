#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace plumbline::reports {

/// Code with one fault put in, and the cause that the diagnosis named.
struct JudgedTwin {
  std::string name;      ///< "ggx/alpha 0.2/double/pdf half"
  std::string fault;     ///< what was put in, in words
  std::string expected;  ///< the cause that a person would name: "tangent frame"
  std::string named;     ///< the one that was named, `expected` if it says the same; empty: none
  bool found = false;    ///< whether any check failed

  bool operator==(const JudgedTwin&) const = default;
};

/// Causes named for one set of faulty twins: a confusion matrix, twin by twin. JSON format
/// "plumbline.causes/1".
struct CausesRecord {
  std::string set;  ///< "first"
  std::uint64_t seed = 0;
  std::vector<JudgedTwin> twins;

  bool operator==(const CausesRecord&) const = default;
};

/// @throws FormatError where a twin has no name or no expected cause
std::string to_json(const CausesRecord& record);

/// @throws FormatError
CausesRecord parse_causes_record(std::string_view json);

}  // namespace plumbline::reports
