#include <plumbline/options/options.h>

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <system_error>

namespace plumbline::options {
namespace {

template <class T>
bool parses_whole(const std::string& text, T& value) {
  const char* end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data(), end, value);
  return parsed.ec == std::errc() && parsed.ptr == end;
}

}  // namespace

Option& Option::required() {
  option_->required();
  return *this;
}

Option& Option::type(const std::string& name) {
  option_->type_name(name);
  return *this;
}

Option& Option::count(int least, int most) {
  option_->expected(least, most);
  return *this;
}

Option& Option::one_value_each() {
  option_->allow_extra_args(false);
  return *this;
}

Option& Option::shows_default() {
  option_->capture_default_str();
  return *this;
}

Option& Option::hidden() {
  option_->group("");
  return *this;
}

Option& Option::needs(const std::string& other) {
  option_->needs(command_->get_option(other));
  return *this;
}

Option& Option::excludes(const std::string& other) {
  option_->excludes(command_->get_option(other));
  return *this;
}

Option& Option::one_of(const std::vector<std::string>& values) {
  option_->check(CLI::IsMember(values).description(""));
  return *this;
}

Option& Option::whole_number(std::int64_t smallest, std::int64_t largest) {
  option_->check(CLI::Validator(
      [=](const std::string& text) {
        std::int64_t value = 0;
        if (parses_whole(text, value) && value >= smallest && value <= largest) {
          return std::string();
        }
        return fmt::format("{} is not a whole number from {} to {}", text, smallest, largest);
      },
      ""));
  return *this;
}

Option& Option::positive_number() {
  option_->check(CLI::Validator(
      [](const std::string& text) {
        double value = 0;
        if (parses_whole(text, value) && std::isfinite(value) && value > 0) return std::string();
        return fmt::format("{} is not a positive number", text);
      },
      ""));
  return *this;
}

template <class Value>
Option Command::add(const std::string& name, Value& value, const std::string& meaning) {
  return {*app_, *app_->add_option(name, value, meaning)};
}

template Option Command::add(const std::string&, std::string&, const std::string&);
template Option Command::add(const std::string&, int&, const std::string&);
template Option Command::add(const std::string&, std::uint32_t&, const std::string&);
template Option Command::add(const std::string&, std::uint64_t&, const std::string&);
template Option Command::add(const std::string&, double&, const std::string&);
template Option Command::add(const std::string&, std::optional<int>&, const std::string&);
template Option Command::add(const std::string&, std::optional<std::uint32_t>&, const std::string&);
template Option Command::add(const std::string&, std::optional<double>&, const std::string&);
template Option Command::add(const std::string&, std::vector<std::string>&, const std::string&);

Option Command::add_flag(const std::string& name, bool& value, const std::string& meaning) {
  return {*app_, *app_->add_flag(name, value, meaning)};
}

Option Command::add_text(const std::string& name,
                         const std::function<void(const std::string&)>& take,
                         const std::string& meaning) {
  return {*app_, *app_->add_option_function<std::string>(name, take, meaning)};
}

void Command::footer(const std::string& text) { app_->footer(text); }

void Command::runs(const Run& run) {
  app_->callback([chosen = chosen_, run] { *chosen = run; });
}

CommandLine::CommandLine(const std::string& meaning, const std::string& program)
    : app_(std::make_unique<CLI::App>(meaning, program)) {}

CommandLine::~CommandLine() = default;

Command CommandLine::program() { return {*app_, chosen_}; }

Command CommandLine::add_command(const std::string& name, const std::string& meaning) {
  app_->require_subcommand(1);
  return {*app_->add_subcommand(name, meaning), chosen_};
}

void CommandLine::add_version(const std::string& version) {
  app_->set_version_flag("--version", version);
}

std::vector<std::string> CommandLine::commands() const {
  std::vector<std::string> names;
  for (const CLI::App* command : app_->get_subcommands({})) names.push_back(command->get_name());
  return names;
}

bool CommandLine::has_option(const std::string& name) const {
  return app_->get_option_no_throw(name) != nullptr;
}

std::optional<bool> CommandLine::parse(int argc, char** argv) {
  try {
    app_->parse(argc, argv);
    return std::nullopt;
  } catch (const CLI::ParseError& error) {
    return app_->exit(error) == 0;
  }
}

}  // namespace plumbline::options
