#include "json_fields.h"

#include <cmath>

namespace plumbline::reports::detail {

Json json_from_double(double value) {
  if (std::isnan(value)) return nullptr;
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  return value;
}

double double_from_json(const Json& value) {
  if (value.is_null()) return std::numeric_limits<double>::quiet_NaN();
  if (value == "inf") return std::numeric_limits<double>::infinity();
  if (value == "-inf") return -std::numeric_limits<double>::infinity();
  if (!value.is_number()) throw FormatError("not a number");
  return value.as_double();
}

std::string format_of(const Json& json) {
  const Json* format = json.find("format");
  return format != nullptr && format->is_string() ? format->as_string() : std::string();
}

void require_format(const Json& json, std::string_view format) {
  const std::string found = format_of(json);
  if (found == format) return;
  if (found.empty())
    throw FormatError("states no \"format\"; expected \"" + std::string(format) + "\"");
  throw FormatError("format \"" + found + "\" is not \"" + std::string(format) +
                    "\", the one that this version reads");
}

}  // namespace plumbline::reports::detail
