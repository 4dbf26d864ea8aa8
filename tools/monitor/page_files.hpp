/// The files of the page, which the build bundles and puts into the program.
#pragma once

#include <vector>

#include "tools/monitor/web_server.hpp"

namespace plumb {

[[nodiscard]] std::vector<WebFile> page_files();

}  // namespace plumb
