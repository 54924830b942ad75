#include "json_fields.h"

#include <algorithm>
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
  return value.get<double>();
}

Json parse_json(std::string_view text) {
  try {
    return Json::parse(text);
  } catch (const Json::exception& error) {
    const std::string_view what =
        error.what();  // "[json.exception.parse_error.101] parse error at …"
    throw FormatError("not JSON, or only a part of it: " +
                      std::string(what.substr(std::min(what.find("] ") + 2, what.size()))));
  }
}

std::string format_of(const Json& json) {
  if (!json.is_object()) return {};
  const auto format = json.find("format");
  return format != json.end() && format->is_string() ? format->get<std::string>() : std::string();
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
