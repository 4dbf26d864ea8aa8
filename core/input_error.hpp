/// The exception for an input that the user has to correct. Programs print it and exit with 2.
#pragma once

#include <stdexcept>

namespace plumb {

/// what() is one sentence that names the file, the line and the field where they are known.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace plumb
