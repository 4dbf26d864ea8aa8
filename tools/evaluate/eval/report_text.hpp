/// The tables that plumb-eval prints.
#pragma once

#include <string>

#include "tools/evaluate/eval/plane_metric.hpp"
#include "tools/evaluate/eval/trajectory_report.hpp"

namespace plumb {

[[nodiscard]] std::string to_text(const TrajectoryReport& report);
[[nodiscard]] std::string to_text(const PlaneReport& report);

}  // namespace plumb
