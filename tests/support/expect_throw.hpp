/// Checks the sentence that an error carries, not only that there is one.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "core/input_error.hpp"

namespace plumb::test {

/// What InputError says, or "" when nothing was thrown.
template <typename Action>
std::string input_error_of(Action action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

inline void expect_contains(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' is not in: " << text;
}

}  // namespace plumb::test
