/// The first message to a page: what the monitor shows and the names of all numbers.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "modules/chain/plumb_config.hpp"
#include "tools/monitor/can_view.hpp"

namespace plumb {

/// `mode` is "live" or "log", `title` the network's URL or the log's name.
[[nodiscard]] nlohmann::json hello_json(const char* mode, const std::string& title,
                                        const PlumbConfig& config, const CanView& can);

}  // namespace plumb
