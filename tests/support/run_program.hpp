/// Runs one of the project's programs as a user would.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "plumb_paths.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/temp_folder.hpp"

namespace plumb::test {

struct ProgramResult {
  int exit_code = -1;
  std::string out;
  std::string err;
};

/// Quotes `text` as one word of a shell command.
inline std::string shell_word(const std::string& text) {
  std::string word("'");
  for (const char c : text) {
    if (c == '\'') {
      word.append("'\\''");
    } else {
      word.push_back(c);
    }
  }
  word.push_back('\'');
  return word;
}

/// Runs the program with `arguments`, which the shell parses. The output is captured in `folder`.
inline ProgramResult run_program(const TempFolder& folder, const std::string& name,
                                 const std::string& arguments, double timeout_s = 100.0) {
  const std::string out = (folder / "stdout.txt").string();
  const std::string err = (folder / "stderr.txt").string();
  ChildProcess shell({"sh", "-c",
                      "exec " + shell_word(std::string(PLUMB_BIN_DIR) + "/" + name) + " " +
                          arguments + " >" + shell_word(out) + " 2>" + shell_word(err)});
  ProgramResult result;
  result.exit_code = shell.wait(timeout_s);
  result.out = read_text(out);
  result.err = read_text(err);
  return result;
}

/// The program ends with exit code 2 and one line on stderr that contains `sentence`.
inline void expect_refused(const TempFolder& folder, const std::string& name,
                           const std::string& arguments, const std::string& sentence) {
  const ProgramResult result = run_program(folder, name, arguments);
  EXPECT_EQ(result.exit_code, 2) << name << " " << arguments;
  EXPECT_NE(result.err.find(sentence), std::string::npos) << name << " " << arguments << "\n"
                                                          << result.err;
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
}

}  // namespace plumb::test
