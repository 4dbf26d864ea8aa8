/// plumb-export: takes the results of a drive to other tools: trajectories for evo, a table, MCAP
/// for Foxglove and PlotJuggler, a bag for ROS 2, a video with the results drawn.

#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "core/input_error.hpp"
#include "modules/datasets/text.hpp"
#include "platform/command_line.hpp"
#include "platform/log.hpp"
#include "platform/overwrite_guard.hpp"
#include "tools/run/export/drive_results.hpp"
#include "tools/run/export/foxglove_file.hpp"
#include "tools/run/export/ros2_file.hpp"
#include "tools/run/export/trajectory.hpp"
#include "tools/run/export/video_file.hpp"
#include "tools/run/replay/frame_csv.hpp"
#include "tools/run/replay/text_output.hpp"
#include "tools/support/stop_flag.hpp"
#include "tools/support/tool_main.hpp"

namespace plumb {
namespace {

constexpr const char* kExportFooter =
    R"(The results are those in the log when it holds EGO_MOTION, and else those of a replay. docs/formats.md says what
is in each file. Of a damaged log, everything intact is exported; what was wrong is reported, and the exit code is 2.

Examples
  plumb-export drive.lcm --tum drive.tum --mcap drive.mcap
  plumb-export drive.lcm --ros2 drive_ros2.mcap
  plumb-export drive.lcm --video drive.mp4
  plumb-export 05.lcm --replay --config vehicle.toml --frame vehicle --kitti 05.txt)";

struct ExportArguments {
  DriveOptions drive;
  std::string tum, kitti, csv, mcap, ros2, video;
  std::string frame = "camera";
};

void refuse_wrong_files(const ExportArguments& arguments) {
  if (arguments.tum.empty() && arguments.kitti.empty() && arguments.csv.empty() &&
      arguments.mcap.empty() && arguments.ros2.empty() && arguments.video.empty())
    throw InputError("nothing to write: give --tum, --kitti, --csv, --mcap, --ros2 or --video");
  if (!arguments.video.empty()) check_video_name(arguments.video);
  OverwriteGuard()
      .reads("LOG", arguments.drive.log)
      .reads("--config", arguments.drive.config)
      .writes("--tum", arguments.tum)
      .writes("--kitti", arguments.kitti)
      .writes("--csv", arguments.csv)
      .writes("--mcap", arguments.mcap)
      .writes("--ros2", arguments.ros2)
      .writes("--video", arguments.video)
      .check();
}

void print_rows(const std::string& path, std::int64_t num_rows, const char* what) {
  std::cout << format("%s: %lld %s\n", path.c_str(), static_cast<long long>(num_rows), what);
}

void write_texts(const ExportArguments& arguments, const DriveResults& drive) {
  const TrajectoryFrame frame =
      arguments.frame == "vehicle" ? TrajectoryFrame::kOfVehicle : TrajectoryFrame::kOfCamera;
  if (!arguments.tum.empty())
    print_rows(arguments.tum, write_tum(drive, frame, arguments.tum), "poses");
  if (!arguments.kitti.empty())
    print_rows(arguments.kitti, write_kitti(drive, frame, arguments.kitti), "poses");
  if (arguments.csv.empty()) return;
  TextOutput csv(arguments.csv);
  csv.row(frame_csv_header(false));
  for (const FrameResult& result : drive.frames) csv.row(result.csv_row);
  csv.close();
  print_rows(arguments.csv, static_cast<std::int64_t>(drive.frames.size()), "rows");
}

void print_size(const std::string& path) {
  std::cout << format("%s: %.1f MB\n", path.c_str(),
                      1e-6 * static_cast<double>(std::filesystem::file_size(path)));
}

int run(const ExportArguments& arguments) {
  refuse_wrong_files(arguments);
  catch_stop_signals();
  const DriveResults drive = read_drive(arguments.drive);
  std::cout << format("%s: %zu images, results %s\n", arguments.drive.log.c_str(),
                      drive.frames.size(), drive.replayed ? "of a replay" : "as recorded");
  write_texts(arguments, drive);
  std::vector<std::unique_ptr<DriveSink>> files;
  if (!arguments.mcap.empty()) files.push_back(make_foxglove_file(drive, arguments.mcap));
  if (!arguments.ros2.empty()) files.push_back(make_ros2_file(drive, arguments.ros2));
  if (!arguments.video.empty()) files.push_back(make_video_file(drive, arguments.video));
  std::vector<DriveSink*> sinks;
  for (const auto& file : files) sinks.push_back(file.get());
  export_drive(arguments.drive.log, drive, sinks);
  for (const std::string& path : {arguments.mcap, arguments.ros2, arguments.video}) {
    if (!path.empty()) print_size(path);
  }
  std::cout.flush();
  for (const std::string& problem : drive.problems)
    std::cerr << "plumb-export: " << problem << "\n";
  return drive.problems.empty() ? 0 : kExitRefused;
}

}  // namespace
}  // namespace plumb

int main(int argc, char** argv) {
  plumb::set_log_name("plumb-export");
  plumb::ExportArguments arguments;
  plumb::CommandLine app("Exports the results of a drive for other tools", "plumb-export");
  app.footer(plumb::kExportFooter);
  app.add_option("LOG", arguments.drive.log, "LCM log with images, or with results").required();
  app.add_option("--tum", arguments.tum, "trajectory to write: time x y z qx qy qz qw");
  app.add_option("--kitti", arguments.kitti, "KITTI pose file to write, one row per image");
  app.add_option("--frame", arguments.frame, "whose poses --tum and --kitti state")
      .check(plumb::one_of({"camera", "vehicle"}))
      .capture_default_str();
  app.add_option("--csv", arguments.csv, "table to write, one row per image, as of plumb-replay");
  app.add_option("--mcap", arguments.mcap, "MCAP file to write for Foxglove and PlotJuggler");
  app.add_option("--ros2", arguments.ros2, "ROS 2 bag to write, in MCAP");
  app.add_option("--video", arguments.video,
                 "video to write, .mp4 or .avi, with the results drawn onto the images");
  app.add_flag("--replay", arguments.drive.replay, "replay also a log that holds results");
  app.add_option("--config", arguments.drive.config, "TOML configuration of the replay");
  app.add_option("--seed", arguments.drive.seed, "seed of the replay").capture_default_str();
  return plumb::tool_main(&app, argc, argv, [&] { return plumb::run(arguments); });
}
