/// The numbers of config/ground_model.toml as they were when the program was built.
#pragma once

namespace plumb {

/// Sets `value` to the number under "section.key"; leaves it where the file has no such key.
void take_built_in_number(const char* key, double* value);

}  // namespace plumb
