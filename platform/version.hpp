/// The version of the project, which CMakeLists.txt states.
#pragma once

namespace plumb {

[[nodiscard]] const char* plumb_version();

}  // namespace plumb
