/// What is wrong with a file that the user gave. Programs print it and exit with 2.
#pragma once

#include <stdexcept>

namespace plumb {

/// One clear sentence that names file, line and field where there are any.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace plumb
