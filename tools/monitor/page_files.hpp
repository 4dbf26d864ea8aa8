/// The files of the page, which the build bundles and puts into the program.
#pragma once

#include <vector>

#include "tools/monitor/web_server.hpp"

namespace plumb {

/// Empty when the page could not be bundled, for want of npm.
[[nodiscard]] std::vector<WebFile> page_files();

}  // namespace plumb
