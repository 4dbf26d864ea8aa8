/// The command line of every plumb-* program: declares its options, parses them, and says in one
/// sentence what is wrong with them.
///
/// Errors:
///   "plumb-replay: unknown option --pose; did you mean --poses?" on stderr and exit code 2.
///
/// CLI11 does the work. Its headers take seconds to compile, so only command_line.cpp includes
/// them, and the types that an option can have are listed there.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace plumb {

/// What the words of an option must fulfil.
struct ValueCheck {
  std::function<std::string(const std::string&)> problem;  ///< empty when the word is accepted
  std::string shown;                                       ///< by --help
};

/// Accepts one of `words`; the error message names the nearest of them.
[[nodiscard]] ValueCheck one_of(std::vector<std::string> words);

/// Accepts numbers in [low, high]. The two are shown by --help.
[[nodiscard]] ValueCheck within(double low, double high);

/// Accepts numbers that are not below `low`.
[[nodiscard]] ValueCheck at_least(double low);

/// One declared option. The command line owns it, and copies mean the same option.
class Option {
 public:
  explicit Option(CLI::Option* option) : option_(option) {}

  Option required();
  Option check(const ValueCheck& check);
  /// Keeps every value of an option that is given several times.
  Option take_all();
  /// Takes one word each time that the option is given, for an option of several values.
  Option one_each();
  /// Takes several values from one word.
  Option delimiter(char separator);
  /// Shown by --help in place of the type.
  Option type_name(const std::string& name);
  /// Shows the present value of the variable by --help.
  Option capture_default_str();
  Option needs(Option other);
  Option excludes(Option other);

 private:
  CLI::Option* option_;
};

/// The options of a program, or of one of its commands. Copies mean the same command line.
class CommandLine {
 public:
  CommandLine(const std::string& summary, const std::string& program);

  /// Adds an option, or a positional argument when `name` begins with no dash. `value` outlives
  /// parse(). T: std::string, a path, a number, an optional number, or a vector of words or
  /// numbers.
  template <typename T>
  Option add_option(const std::string& name, T& value, const std::string& help = "");
  Option add_flag(const std::string& name, bool& value, const std::string& help = "");
  CommandLine add_subcommand(const std::string& name, const std::string& help);
  /// At least `least` and at most `most` commands are to be given.
  void require_subcommand(std::size_t least, std::size_t most);
  /// Text below the options of --help.
  void footer(const std::string& text);

  /// Parses the words and adds --version. Returns the exit code when the program is done (--help,
  /// --version, a refused option) and -1 when it is to go on.
  [[nodiscard]] int parse(int argc, char** argv);
  /// Whether this command was given.
  [[nodiscard]] bool parsed() const;
  /// The name of the program, which begins what it prints on stderr.
  [[nodiscard]] const std::string& name() const;

 private:
  explicit CommandLine(std::shared_ptr<CLI::App> app) : app_(std::move(app)) {}

  std::shared_ptr<CLI::App> app_;
};

}  // namespace plumb
