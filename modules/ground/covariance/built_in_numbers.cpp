#include "modules/ground/covariance/built_in_numbers.hpp"

#include <cstring>

namespace plumb {
namespace {

struct BuiltInNumber {
  const char* key;
  double value;
};

// {"section.key", value}, written by the build from config/ground_model.toml.
constexpr BuiltInNumber kBuiltInNumbers[] = {
#include "ground_model_numbers.inc"
};

}  // namespace

void take_built_in_number(const char* key, double* value) {
  for (const BuiltInNumber& number : kBuiltInNumbers)
    if (std::strcmp(number.key, key) == 0) *value = number.value;
}

}  // namespace plumb
