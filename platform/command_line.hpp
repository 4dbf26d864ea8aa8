/// Parses the command line of every plumb-* program and says in one sentence what is wrong with it.
///
/// Errors:
///   "plumb-replay: unknown option --pose; did you mean --poses?" on stderr and exit code 2.
#pragma once

#include <CLI/App.hpp>
#include <CLI/Validators.hpp>
#include <string>
#include <vector>

namespace plumb {

/// Parses the command line and adds --version to `app`. Returns the exit code when the program is
/// done (--help, --version, a refused option) and -1 when it is to go on. `program` is printed
/// before the sentence.
[[nodiscard]] int parse_command_line(CLI::App& app, const char* program, int argc, char** argv);

/// Accepts one of `words`; the error message names the nearest of them.
[[nodiscard]] CLI::Validator one_of(std::vector<std::string> words);

/// Accepts numbers in [low, high]. The two are shown by --help.
[[nodiscard]] CLI::Validator within(double low, double high);

/// Accepts numbers that are not below `low`.
[[nodiscard]] CLI::Validator at_least(double low);

}  // namespace plumb
