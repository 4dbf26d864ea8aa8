#include "platform/command_line.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <optional>

#include "platform/exit_code.hpp"
#include "platform/nearest_word.hpp"
#include "platform/version.hpp"

namespace plumb {
namespace {

/// The subcommand that was given, else the program itself.
const CLI::App& innermost(const CLI::App& app) {
  const auto parsed = app.get_subcommands();
  return parsed.empty() ? app : innermost(*parsed.back());
}

std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

/// What is wrong with the first word when it stands in place of a command and looks like none of
/// the files that may stand there, too. Empty when nothing is wrong.
std::string unknown_command(const CLI::App& app, const std::string& first_word) {
  const std::vector<std::string> commands = command_names(app);
  if (commands.empty() || !app.get_subcommands().empty() || first_word.rfind('-', 0) == 0) {
    return {};
  }
  const std::string near = did_you_mean(first_word, commands);
  const bool is_file = first_word.find_first_of("./") != std::string::npos;
  if (app.get_require_subcommand_min() == 0 && (near.empty() || is_file)) return {};
  return "unknown command " + first_word + near;
}

/// What is wrong with the first word that no option or argument took; empty when all were taken.
std::string unknown_word(const CLI::App& app) {
  const std::vector<std::string> words = app.remaining(true);
  if (words.empty()) return {};
  const CLI::App& command = innermost(app);
  const auto is_option = [](const std::string& word) { return word.size() > 1 && word[0] == '-'; };
  const auto option = std::find_if(words.begin(), words.end(), is_option);
  if (option != words.end()) {
    const std::string name = option->substr(0, option->find('='));
    const std::string dashed =
        "--" + name.substr(std::min(name.find_first_not_of('-'), name.size()));
    return "unknown option " + name + did_you_mean(dashed, option_names(command));
  }
  return "unexpected argument " + words.front();
}

std::optional<double> number_in(const std::string& text) {
  double value = 0.0;
  const char* const last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, value);
  if (error != std::errc{} || end != last) return {};
  return value;
}

/// CLI11's message in a whole sentence, where it has none.
std::string sentence(const CLI::App& app, const CLI::ParseError& error,
                     const std::string& first_word) {
  const std::string command = unknown_command(app, first_word);
  if (!command.empty()) return command;
  // What is missing may be misspelt: an unknown option explains more than a missing one.
  const std::string unknown = unknown_word(app);
  if (!unknown.empty()) return unknown;
  const std::string text = error.what();
  const std::string name = text.substr(0, text.find(':'));
  if (error.get_name() == "ArgumentMismatch" && name.size() < text.size()) {
    return name + " wants a value";
  }
  const std::string unconverted = "Could not convert: ";
  if (text.rfind(unconverted, 0) == 0) {
    const std::size_t equals = text.find(" = ");
    const std::string value = text.substr(equals + 3);
    return text.substr(unconverted.size(), equals - unconverted.size()) + ": " + value +
           (number_in(value) ? " is not a whole number in range" : " is not a number");
  }
  return text;
}

std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.12g", value);
  return text;
}

}  // namespace

ValueCheck one_of(std::vector<std::string> words) {
  const std::string shown = "{" + word_list(words) + "}";
  return {[words = std::move(words)](const std::string& text) -> std::string {
            if (std::find(words.begin(), words.end(), text) != words.end()) return {};
            return text + " is none of " + word_list(words) + did_you_mean(text, words);
          },
          shown};
}

ValueCheck within(double low, double high) {
  const std::string range = "[" + short_number(low) + ", " + short_number(high) + "]";
  return {[low, high, range](const std::string& text) -> std::string {
            const std::optional<double> value = number_in(text);
            if (!value) return text + " is not a number";
            return *value >= low && *value <= high ? "" : text + " is outside " + range;
          },
          "in " + range};
}

ValueCheck at_least(double low) {
  return {[low](const std::string& text) -> std::string {
            const std::optional<double> value = number_in(text);
            if (!value) return text + " is not a number";
            return *value >= low ? "" : text + " is below " + short_number(low);
          },
          ">= " + short_number(low)};
}

Option Option::required() { return Option(option_->required()); }

Option Option::check(const ValueCheck& check) {
  return Option(option_->check(CLI::Validator(
      [problem = check.problem](std::string& word) { return problem(word); }, check.shown)));
}

Option Option::take_all() { return Option(option_->take_all()); }
Option Option::one_each() { return Option(option_->allow_extra_args(false)); }
Option Option::delimiter(char separator) { return Option(option_->delimiter(separator)); }
Option Option::type_name(const std::string& name) { return Option(option_->type_name(name)); }
Option Option::capture_default_str() { return Option(option_->capture_default_str()); }
Option Option::needs(Option other) { return Option(option_->needs(other.option_)); }
Option Option::excludes(Option other) { return Option(option_->excludes(other.option_)); }

CommandLine::CommandLine(const std::string& summary, const std::string& program)
    : app_(std::make_shared<CLI::App>(summary, program)) {}

template <typename T>
Option CommandLine::add_option(const std::string& name, T& value, const std::string& help) {
  return Option(app_->add_option(name, value, help));
}
template Option CommandLine::add_option(const std::string&, std::string&, const std::string&);
template Option CommandLine::add_option(const std::string&, std::filesystem::path&,
                                        const std::string&);
template Option CommandLine::add_option(const std::string&, int&, const std::string&);
template Option CommandLine::add_option(const std::string&, std::int64_t&, const std::string&);
template Option CommandLine::add_option(const std::string&, std::uint64_t&, const std::string&);
template Option CommandLine::add_option(const std::string&, double&, const std::string&);
template Option CommandLine::add_option(const std::string&, std::optional<std::int64_t>&,
                                        const std::string&);
template Option CommandLine::add_option(const std::string&, std::optional<double>&,
                                        const std::string&);
template Option CommandLine::add_option(const std::string&, std::vector<std::string>&,
                                        const std::string&);
template Option CommandLine::add_option(const std::string&, std::vector<std::int64_t>&,
                                        const std::string&);

Option CommandLine::add_flag(const std::string& name, bool& value, const std::string& help) {
  return Option(app_->add_flag(name, value, help));
}

CommandLine CommandLine::add_subcommand(const std::string& name, const std::string& help) {
  return CommandLine(app_->get_subcommand_ptr(app_->add_subcommand(name, help)));
}

void CommandLine::require_subcommand(std::size_t least, std::size_t most) {
  app_->require_subcommand(least, most);
}

void CommandLine::footer(const std::string& text) { app_->footer(text); }
bool CommandLine::parsed() const { return app_->parsed(); }
const std::string& CommandLine::name() const { return app_->get_name(); }

int CommandLine::parse(int argc, char** argv) {
  app_->set_version_flag("--version", name() + " " + plumb_version());
  try {
    app_->parse(argc, argv);
    return -1;
  } catch (const CLI::Success& success) {  // --help, --version
    return app_->exit(success) == 0 ? kExitOk : kExitMachine;
  } catch (const CLI::ParseError& error) {
    const std::string what = sentence(*app_, error, argc > 1 ? argv[1] : "-");
    const bool complete = what.back() == '?';
    std::fprintf(stderr, "%s: %s%s\n", name().c_str(), what.c_str(),
                 complete ? "" : " (--help lists the options)");
    return kExitRefused;
  }
}

}  // namespace plumb
