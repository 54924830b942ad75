#include "domain_argument.h"

#include <fmt/core.h>

#include <charconv>
#include <cmath>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <vector>

#include <plumbline/renderer/core/errors.h>
#include <plumbline/renderer/scene_file/nearest_name.h>

namespace plumbline::tools {
namespace {

using verify::Domain;

/// A domain's name and how many numbers may follow it.
struct DomainForm {
  const char* name;
  std::size_t least, most;
  char separator;
};

constexpr DomainForm kForms[] = {
    {"bsdf", 0, 0, ':'},     {"sphere", 0, 0, ':'},          {"hemisphere", 0, 0, ':'},
    {"disk", 0, 1, ':'},     {"square", 0, 0, ':'},          {"triangle", 0, 0, ':'},
    {"interval", 0, 2, ':'}, {"half-line", 0, 1, ':'},       {"line", 0, 2, ':'},
    {"discrete", 1, 1, ':'}, {"equirectangular", 2, 2, 'x'}, {"octahedral", 1, 1, ':'},
};

std::vector<double> numbers_in(std::string_view text, char separator) {
  std::vector<double> numbers;
  while (!text.empty()) {
    double& number = numbers.emplace_back();
    const auto read = std::from_chars(text.data(), text.data() + text.size(), number);
    if (read.ec != std::errc() || !std::isfinite(number)) throw std::invalid_argument("a number");
    text.remove_prefix(static_cast<std::size_t>(read.ptr - text.data()));
    if (text.empty()) break;
    if (text.front() != separator || text.size() == 1) throw std::invalid_argument("a separator");
    text.remove_prefix(1);
  }
  return numbers;
}

/// A number of pixels or points.
std::size_t whole(double number) {
  constexpr double kMost = 1e6;
  if (number != std::floor(number) || number < 1 || number > kMost) {
    throw std::invalid_argument("a whole number from 1 to a million");
  }
  return static_cast<std::size_t>(number);
}

double positive(double number) {
  if (!(number > 0)) throw std::invalid_argument("a positive number");
  return number;
}

std::optional<Domain> make_domain(std::string_view name, const std::vector<double>& n) {
  if (name == "sphere") return Domain::sphere();
  if (name == "hemisphere") return Domain::hemisphere();
  if (name == "square") return Domain::unit_square();
  if (name == "triangle") return Domain::triangle();
  if (name == "disk") return Domain::disk(n.empty() ? 1 : positive(n[0]));
  if (name == "interval") return n.empty() ? Domain::interval() : Domain::interval(n[0], n.at(1));
  if (name == "half-line") return Domain::half_line(n.empty() ? 1 : n[0]);
  if (name == "line") return n.empty() ? Domain::line() : Domain::line(n[0], n.at(1));
  if (name == "discrete") return Domain::discrete(whole(n[0]));
  if (name == "octahedral") return Domain::octahedral(whole(n[0]));
  if (name == "equirectangular") return Domain::equirectangular(whole(n[0]), whole(n[1]));
  return std::nullopt;
}

const DomainForm& form_of(const std::string& name) {
  std::vector<std::string> names;
  for (const DomainForm& form : kForms) {
    if (name == form.name) return form;
    names.emplace_back(form.name);
  }
  throw renderer::InputError(fmt::format("--domain {}: there is no such domain; {}", name,
                                         renderer::name_hint(name, names)));
}

}  // namespace

std::optional<Domain> parse_domain(const std::string& text) {
  const std::size_t colon = text.find(':');
  const std::string name = text.substr(0, colon);
  const DomainForm& form = form_of(name);
  try {
    const std::vector<double> numbers = numbers_in(
        colon == std::string::npos ? "" : std::string_view(text).substr(colon + 1), form.separator);
    if (numbers.size() < form.least || numbers.size() > form.most) {
      throw std::invalid_argument("more or fewer numbers");
    }
    return make_domain(name, numbers);
  } catch (const std::logic_error&) {
    throw renderer::InputError(
        fmt::format("--domain {}: must read like disk:2, interval:-1:1, discrete:5, "
                    "equirectangular:64x32 or octahedral:32",
                    text));
  }
}

}  // namespace plumbline::tools
