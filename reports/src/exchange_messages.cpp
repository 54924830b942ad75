#include <plumbline/reports/exchange_messages.h>

#include <cstdint>
#include <exception>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <plumbline/verify/waiver.h>

#include "json.h"

namespace plumbline::reports {
namespace {

using detail::Json;

std::string in_quotes(std::string_view name) { return "\"" + std::string(name) + "\""; }

[[noreturn]] void refuse(std::string_view name, std::string_view wanted) {
  throw FormatError(in_quotes(name) + " must be " + std::string(wanted));
}

void take(std::string_view name, const Json& json, std::string& value) {
  if (!json.is_string()) refuse(name, "a text");
  value = json.as_string();
}

void take(std::string_view name, const Json& json, bool& value) {
  if (!json.is_bool()) refuse(name, "true or false");
  value = json.as_bool();
}

void take(std::string_view name, const Json& json, double& value) {
  if (!json.is_number()) refuse(name, "a number");
  value = json.as_double();
}

void take(std::string_view name, const Json& json, std::uint64_t& value) {
  if (!json.is_unsigned()) refuse(name, "a whole number >= 0");
  value = json.as_uint64();
}

template <class T>
void take(std::string_view name, const Json& json, std::vector<T>& values) {
  if (!json.is_array()) refuse(name, "a list");
  values.clear();
  for (const Json& element : json.elements()) take(name, element, values.emplace_back());
}

template <class T>
void take(std::string_view name, const Json& json, std::optional<T>& value) {
  take(name, json, value.emplace());
}

Json parse_object(std::string_view text) {
  Json json = Json::parse(text);
  if (!json.is_object()) throw FormatError("not a JSON object");
  return json;
}

void take_functions(const Json& json, AnswererHello& hello) {
  std::vector<std::string> functions;
  take("functions", json, functions);
  bool sample = false, pdf = false;
  hello.has_eval = false;
  for (const std::string& function : functions) {
    if (function == "sample") {
      sample = true;
    } else if (function == "pdf") {
      pdf = true;
    } else if (function == "eval") {
      hello.has_eval = true;
    } else {
      throw FormatError("there is no function " + in_quotes(function) +
                        "; there are sample, pdf and eval");
    }
  }
  if (!sample || !pdf) throw FormatError("\"functions\" must hold sample and pdf");
}

void take_precision(const Json& json, AnswererHello& hello) {
  std::string precision;
  take("precision", json, precision);
  if (precision != "float32" && precision != "float64") {
    refuse("precision", "\"float32\" or \"float64\"");
  }
  hello.float64 = precision == "float64";
}

void take_numbers(const Json& json, AnswererHello& hello) {
  std::uint64_t numbers = 0;
  take("numbers", json, numbers);
  if (numbers < 1 || numbers > 3) refuse("numbers", "1, 2 or 3");
  hello.numbers = static_cast<int>(numbers);
}

void require_protocol(const Json& json) {
  const Json* protocol = json.find("protocol");
  if (protocol == nullptr) throw FormatError("\"protocol\" is missing");
  if (*protocol == kExchangeProtocol) return;
  throw FormatError("speaks the protocol " + protocol->dump() + "; this version speaks " +
                    in_quotes(kExchangeProtocol));
}

/// One member of the hello; whether its name is known.
bool take_member(const std::string& name, const Json& value, AnswererHello& hello) {
  if (name == "name") {
    take(name, value, hello.name);
  } else if (name == "precision") {
    take_precision(value, hello);
  } else if (name == "numbers") {
    take_numbers(value, hello);
  } else if (name == "functions") {
    take_functions(value, hello);
  } else if (name == "atoms") {
    take(name, value, hello.has_atoms);
  } else if (name == "domain") {
    take(name, value, hello.domain);
  } else {
    return name == "protocol";
  }
  return true;
}

/// One member of the options' file; whether its name is known.
bool take_member(const std::string& name, const Json& value, VerifyOptionsFile& options) {
  bool known = false;
  const auto option = [&](const char* option_name, auto& into) {
    if (name != option_name) return;
    known = true;
    take(name, value, into);
  };
  option("exec", options.exec);
  option("exchange", options.exchange);
  option("name", options.name);
  option("domain", options.domain);
  option("timeout", options.timeout);
  option("eta", options.eta);
  option("angles", options.angles);
  option("conventions", options.conventions);
  option("faces", options.faces);
  option("reciprocal", options.reciprocal);
  option("conserves_energy", options.conserves_energy);
  option("quick", options.quick);
  option("samples", options.samples);
  option("seed", options.seed);
  return known;
}

struct WaiverText {
  std::string check, reason, until;
};

bool take_member(const std::string& name, const Json& value, WaiverText& waiver) {
  std::string* into = name == "check"    ? &waiver.check
                      : name == "reason" ? &waiver.reason
                      : name == "until"  ? &waiver.until
                                         : nullptr;
  if (into != nullptr) take(name, value, *into);
  return into != nullptr;
}

template <class Record>
Record from_members(const Json& json) {
  Record record;
  for (const auto& [name, value] : json.members()) {
    if (!take_member(name, value, record)) {
      throw FormatError("there is no field " + in_quotes(name));
    }
  }
  return record;
}

}  // namespace

AnswererHello parse_answerer_hello(std::string_view line) {
  const Json json = parse_object(line);
  require_protocol(json);
  for (const char* name : {"name", "precision", "numbers", "functions"}) {
    if (json.find(name) == nullptr) throw FormatError(in_quotes(name) + " is missing");
  }
  return from_members<AnswererHello>(json);
}

std::string query_line(std::uint64_t query, std::string_view kind, std::size_t count) {
  return R"({"query": )" + std::to_string(query) + R"(, "kind": ")" + std::string(kind) +
         R"(", "count": )" + std::to_string(count) + "}";
}

AnswerLine parse_answer_line(std::string_view line) {
  const Json json = parse_object(line);
  const Json* query = json.find("query");
  if (query == nullptr) throw FormatError("\"query\" is missing");
  AnswerLine answer;
  take("query", *query, answer.query);
  if (const Json* error = json.find("error")) take("error", *error, answer.error);
  return answer;
}

VerifyOptionsFile parse_verify_options(std::string_view text) {
  return from_members<VerifyOptionsFile>(parse_object(text));
}

std::vector<verify::Waiver> parse_waivers(std::string_view text) {
  const Json list = Json::parse(text);
  if (!list.is_array()) throw FormatError("not a list of waivers");
  std::vector<verify::Waiver> waivers;
  for (const Json& entry : list.elements()) {
    try {
      if (!entry.is_object()) throw FormatError("not an object");
      const WaiverText given = from_members<WaiverText>(entry);
      if (given.check.empty() || given.reason.empty()) {
        throw FormatError("must state \"check\", \"reason\" and \"until\"");
      }
      waivers.push_back({given.check, given.reason, verify::parse_day(given.until)});
    } catch (const std::exception& error) {
      throw FormatError("waiver " + std::to_string(waivers.size() + 1) + ": " + error.what());
    }
  }
  return waivers;
}

}  // namespace plumbline::reports
