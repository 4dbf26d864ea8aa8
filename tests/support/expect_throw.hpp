/// Checks the sentence of an error, not only that an error occurs.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "core/input_error.hpp"

namespace plumb::test {

/// The sentence of the InputError that is thrown, or "" when none is.
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
