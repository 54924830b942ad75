#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace CLI {  // NOLINT(readability-identifier-naming)
class App;
class Option;
}  // namespace CLI

/// Commands and their options, as CLI11 reads them, without its headers.
namespace plumbline::options {

/// What is to be done; the result is the exit code.
using Run = std::function<int()>;

/// An option that has been added. Its functions say more about it and return it.
class Option {
 public:
  Option(CLI::App& command, CLI::Option& option) : command_(&command), option_(&option) {}

  Option& required();
  Option& type(const std::string& name);  ///< of the value, in the help
  Option& count(int least, int most);     ///< of values
  Option& one_value_each();               ///< of a list: the option is repeated for each value
  Option& shows_default();
  Option& hidden();
  Option& needs(const std::string& other);
  Option& excludes(const std::string& other);

  // What the value must be. CLI11 alone takes -1 for an unsigned number, and "nan" for a positive
  // one.

  Option& one_of(const std::vector<std::string>& values);
  Option& whole_number(std::int64_t smallest, std::int64_t largest);
  Option& positive_number();

 private:
  CLI::App* command_;
  CLI::Option* option_;
};

/// A command, or the program itself, as a set of options.
class Command {
 public:
  Command(CLI::App& app, Run& chosen) : app_(&app), chosen_(&chosen) {}

  /// @param name   "scene" for a value in its place, else "-o,--output"
  /// @param value  set when the command line is read; it must outlive that. One of the types that
  ///               options.cpp lists, others do not link
  template <class Value>
  Option add(const std::string& name, Value& value, const std::string& meaning);

  Option add_flag(const std::string& name, bool& value, const std::string& meaning);

  /// An option whose text a function takes, which may throw what is wrong with it.
  Option add_text(const std::string& name, const std::function<void(const std::string&)>& take,
                  const std::string& meaning);

  /// Below the help.
  void footer(const std::string& text);

  /// What is done if the command line names this command.
  void runs(const Run& run);

 private:
  CLI::App* app_;
  Run* chosen_;
};

/// The command line of a program.
class CommandLine {
 public:
  /// @param program  empty: as it was called
  explicit CommandLine(const std::string& meaning, const std::string& program = {});
  ~CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  /// The options of the program itself.
  Command program();

  /// From the first command on, one is required.
  Command add_command(const std::string& name, const std::string& meaning);

  void add_version(const std::string& version);

  std::vector<std::string> commands() const;
  bool has_option(const std::string& name) const;

  /// @return  nothing where the program is to go on; else whether what was asked for is printed, a
  ///          help or the version, or what is wrong
  /// @throws  what functions of options throw
  std::optional<bool> parse(int argc, char** argv);

  /// What the command that was named does.
  const Run& chosen() const { return chosen_; }

 private:
  std::unique_ptr<CLI::App> app_;
  Run chosen_;
};

}  // namespace plumbline::options
