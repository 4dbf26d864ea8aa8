/// plumb-trust: asks whether speed and scale are known as well as the chain says.

#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include "modules/datasets/text.hpp"
#include "platform/command_line.hpp"
#include "platform/config.hpp"
#include "tools/evaluate/trust/trust_judge.hpp"
#include "tools/support/tool_main.hpp"

namespace plumb {
namespace {

constexpr const char* kFooter =
    R"(Each LOG needs CAMERA, CAMERA_CALIBRATION and the true poses that plumb-kitti2lcm writes. The table is Markdown.
NEES is the mean of (error / stated standard deviation)^2 over the valid images; 1 is right.

Example
  plumb-trust 04.lcm 07.lcm --row starts_x1)";

struct Arguments {
  std::vector<std::string> logs, rows;
  std::string config, csv;
};

std::string table_row(const std::string& row, const std::string& drive, const TrustResult& r) {
  return format("| %s | %s | %lld of %lld | %lld (%.1f %%) | %.1f m/s | %.2f | %.2f |\n",
                row.c_str(), drive.c_str(), static_cast<long long>(r.num_valid),
                static_cast<long long>(r.num_images), static_cast<long long>(r.num_wrong),
                100.0 * r.wrong_ratio(), r.worst_error_m_s, r.speed_nees, r.scale_nees);
}

std::string csv_row(const std::string& row, const std::string& drive, std::size_t run,
                    const FrameTrust& f) {
  return format("%s,%s,%zu,%lld,%d,%d,%d,%.4f,%.4f,%.4f,%.5f,%.5f,%.5f\n", row.c_str(),
                drive.c_str(), run, static_cast<long long>(f.seq), f.status, f.valid ? 1 : 0,
                f.wrong() ? 1 : 0, f.speed_m_s, f.speed_std_m_s, f.true_speed_m_s, f.log_scale,
                f.log_scale_std, f.true_log_scale);
}

void run_drive(const Arguments& arguments, const PlumbConfig& config, const FaultDrive& drive,
               std::ostream& csv) {
  for (const TrustRow& row : all_trust_rows()) {
    const auto& rows = arguments.rows;
    if (!rows.empty() && std::find(rows.begin(), rows.end(), row.name) == rows.end()) continue;
    std::vector<FrameTrust> all;
    std::size_t index = 0;
    for (const FaultRun& run : row.make(drive)) {
      for (const FrameTrust& frame : judge_trust(run, row.speed_up, config)) {
        all.push_back(frame);
        csv << csv_row(row.name, drive.name, index, frame);
      }
      ++index;
    }
    std::cout << table_row(row.name, drive.name, summarise_trust(all)) << std::flush;
  }
}

int run(const Arguments& arguments) {
  PlumbConfig config;
  load_config(arguments.config, &config);
  std::ofstream csv;
  if (!arguments.csv.empty()) csv.open(arguments.csv);
  csv << "row,drive,run,seq,status,valid,wrong,speed_m_s,speed_std_m_s,true_speed_m_s,log_scale,"
         "log_scale_std,true_log_scale\n";
  std::cout << "| row | drive | valid | wrong while valid | worst error | NEES speed | NEES ln "
               "scale |\n|---|---|---|---|---|---|---|\n";
  for (const std::string& log : arguments.logs) {
    run_drive(arguments, config, read_fault_drive(log), csv);
  }
  return 0;
}

}  // namespace
}  // namespace plumb

int main(int argc, char** argv) {
  plumb::Arguments arguments;
  std::vector<std::string> names;
  for (const plumb::TrustRow& row : plumb::all_trust_rows()) names.push_back(row.name);
  plumb::CommandLine app("Asks whether speed and scale are known as well as the chain says",
                         "plumb-trust");
  app.footer(plumb::kFooter);
  app.add_option("LOG", arguments.logs, "logs with true poses").required();
  app.add_option("--row", arguments.rows, "only these rows of the table")
      .check(plumb::one_of(names));
  app.add_option("--csv", arguments.csv, "table to write, one row per image");
  app.add_option("--config", arguments.config, "TOML file; every key is optional");
  return plumb::tool_main(&app, argc, argv, [&] { return plumb::run(arguments); });
}
