/// Version of the project, as CMake knows it.
#pragma once

namespace plumb {

[[nodiscard]] const char* plumb_version();

}  // namespace plumb
