/// plumb-faults: puts faults of camera, clock and source into recorded drives and reports what the
/// chain makes of them.

#include <iostream>
#include <string>
#include <vector>

#include "core/input_error.hpp"
#include "platform/command_line.hpp"
#include "platform/config.hpp"
#include "tools/evaluate/faults/fault_judge.hpp"
#include "tools/support/tool_main.hpp"

namespace plumb {
namespace {

constexpr const char* kFooter =
    R"(Each LOG needs CAMERA, CAMERA_CALIBRATION and the true poses that plumb-kitti2lcm writes. The table is Markdown,
as docs/faults.md shows it: counts are summed over the drives, errors and times are the largest.
Exit code 1: on some drive, some fault left more wrong results than --most-wrong allows.

Examples
  plumb-faults 04.lcm 07.lcm
  plumb-faults 04.lcm --fault frozen --fault two_publishers)";

struct Arguments {
  std::vector<std::string> logs, faults;
  std::string config;
  double most_wrong_ratio = 0.005;
  bool by_drive = false;
};

int run(const Arguments& arguments) {
  PlumbConfig config;
  load_config(arguments.config, &config);
  const auto wanted = [&arguments](const Fault& fault) {
    return arguments.faults.empty() || std::find(arguments.faults.begin(), arguments.faults.end(),
                                                 fault.name) != arguments.faults.end();
  };
  std::vector<FaultDrive> drives;
  for (const std::string& log : arguments.logs) drives.push_back(read_fault_drive(log));
  const std::string all_drives = drives.size() == 1 ? drives[0].name : "all";
  bool sound = true;
  std::cout << fault_table_head();
  for (const Fault& fault : all_faults()) {
    if (!wanted(fault)) continue;
    FaultResult pooled;
    for (const FaultDrive& drive : drives) {
      const FaultResult result = run_fault(fault.make(drive), config);
      if (arguments.by_drive) {
        std::cout << fault_table_row(fault, drive.name, result) << std::flush;
      }
      sound = sound && result.wrong_ratio() <= arguments.most_wrong_ratio;
      pooled.add(result);
    }
    if (!arguments.by_drive) {
      std::cout << fault_table_row(fault, all_drives, pooled) << std::flush;
    }
  }
  return sound ? 0 : 1;
}

}  // namespace
}  // namespace plumb

int main(int argc, char** argv) {
  plumb::Arguments arguments;
  std::vector<std::string> names;
  for (const plumb::Fault& fault : plumb::all_faults()) names.push_back(fault.name);
  plumb::CommandLine app(
      "Puts faults into recorded drives and reports what the chain makes of them", "plumb-faults");
  app.footer(plumb::kFooter);
  app.add_option("LOG", arguments.logs, "logs with true poses").required();
  app.add_option("--fault", arguments.faults, "only these rows of the table")
      .check(plumb::one_of(names));
  app.add_option("--config", arguments.config, "TOML file; every key is optional");
  app.add_flag("--by-drive", arguments.by_drive, "one row for each drive instead of one for all");
  app.add_option("--most-wrong", arguments.most_wrong_ratio,
                 "share of the valid results that may be wrong")
      .check(plumb::within(0.0, 1.0))
      .capture_default_str();
  return plumb::tool_main(&app, argc, argv, [&] { return plumb::run(arguments); });
}
