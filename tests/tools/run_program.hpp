/// Runs one of our programs the way a user does.
#pragma once

#include <sys/wait.h>

#include <cstdio>
#include <string>

#include "tests/tools/temp_folder.hpp"

namespace plumb::test {

struct ProgramResult {
  int exit_code = -1;
  std::string out;
  std::string err;
};

/// `text` as one word of a shell command.
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

/// `arguments` go through the shell. `folder` takes the captured output.
inline ProgramResult run_program(const TempFolder& folder, const std::string& name,
                                 const std::string& arguments) {
  const std::string out = (folder / "stdout.txt").string();
  const std::string err = (folder / "stderr.txt").string();
  const std::string command =
      std::string(PLUMB_BIN_DIR) + "/" + name + " " + arguments + " >" + out + " 2>" + err;
  const int status = std::system(command.c_str());
  ProgramResult result;
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  result.out = read_text(out);
  result.err = read_text(err);
  return result;
}

}  // namespace plumb::test
