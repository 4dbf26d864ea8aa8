/// plumb-convert: converts a video, a folder of images or a camera topic in MCAP to an LCM log for
/// plumb-replay.

#include <filesystem>
#include <iostream>
#include <memory>
#include <opencv2/core/utils/logger.hpp>
#include <string>

#include "core/input_error.hpp"
#include "modules/camera/folder_source.hpp"
#include "modules/camera/video_source.hpp"
#include "modules/datasets/folder/companion.hpp"
#include "modules/datasets/number_file.hpp"
#include "modules/datasets/text.hpp"
#include "platform/command_line.hpp"
#include "platform/log.hpp"
#include "platform/overwrite_guard.hpp"
#include "tools/run/convert/camera_file.hpp"
#include "tools/run/convert/convert.hpp"
#include "tools/run/convert/mcap_source.hpp"
#include "tools/support/stop_flag.hpp"
#include "tools/support/tool_main.hpp"

namespace {

namespace fs = std::filesystem;

constexpr const char* kFooter =
    R"(RECORDING is a video file, or a folder of images (jpg, png, bmp, pgm, ppm, tif, webp) in the order of their names,
in which frame_9 is before frame_10, or an MCAP file (also of ROS 2) with camera images. Colour becomes grey. The log has what plumb-camera would publish: rectified and
masked as the camera file says.

The camera file is TOML with [camera] (docs/add_a_camera.md), or a KITTI calib.txt.

Times of images come from --rate, from a file of times, or from names that end in a time since 1970. Numbers in the
names count frames, so that missing images leave their gap. Messages in MCAP have times of their own.

Examples
  plumb-convert dashcam.mp4 --camera camera.toml --out drive.lcm
  plumb-convert bag_0.mcap --topic /camera/image/compressed --camera camera.toml --out drive.lcm
  plumb-convert frames --rate 20 --camera camera.toml --compress jpeg --out drive.lcm
  plumb-replay drive.lcm --csv drive.csv --poses drive.txt)";

struct Arguments {
  fs::path recording;
  fs::path camera;
  fs::path times;
  fs::path vehicle_speed;
  double rate_hz = 0.0;
  std::string topic;
  std::string compress = "none";
  plumb::RecordingOptions options;
};

void add_options(plumb::CommandLine* app, Arguments* arguments) {
  app->footer(kFooter);
  app->add_option("RECORDING", arguments->recording, "video file, folder of images, or MCAP file")
      .required();
  app->add_option("--out", arguments->options.out, "log to write").required();
  app->add_option("--camera", arguments->camera,
                  "camera file [camera.toml or calib.txt in the recording's folder or above it]");
  plumb::Option rate = app->add_option("--rate", arguments->rate_hz, "images/s of a folder")
                           .check(plumb::within(0.1, 1000.0));
  app->add_option("--times", arguments->times,
                  "times of a folder's images, one per line, s [times.txt in it or above it]")
      .excludes(rate);
  app->add_option("--vehicle-speed", arguments->vehicle_speed,
                  "speeds of the vehicle, one per line and image, m/s; written as VEHICLE_SPEED");
  app->add_option("--topic", arguments->topic, "topic of an MCAP file [the only one with images]");
  app->add_option("--compress", arguments->compress,
                  "none: plain pixels; jpeg: quality 95, about a third of the size")
      .check(plumb::one_of({"none", "jpeg"}))
      .capture_default_str();
  app->add_option("--start", arguments->options.start,
                  "first frame number: that of a name, or counted from 0")
      .check(plumb::at_least(0));
  app->add_option("--end", arguments->options.end, "last frame number").check(plumb::at_least(0));
}

/// Looks for the camera file beside the recording when none was stated.
void find_camera(Arguments* arguments) {
  if (!arguments->camera.empty()) return;
  arguments->camera = plumb::find_companion(arguments->recording, {"camera.toml", "calib.txt"});
  if (arguments->camera.empty()) {
    throw plumb::InputError("no camera file: neither --camera, nor camera.toml or calib.txt in " +
                            arguments->recording.string() + " or above it");
  }
}

void refuse_overwriting(const Arguments& arguments) {
  plumb::OverwriteGuard guard;
  guard.reads("--camera", arguments.camera).reads("--times", arguments.times);
  guard.reads("--vehicle-speed", arguments.vehicle_speed);
  guard.reads("RECORDING", arguments.recording);
  if (fs::is_directory(arguments.recording)) {
    guard.reads("times.txt", plumb::find_companion(arguments.recording, {"times.txt"}));
    for (const auto& entry : fs::directory_iterator(arguments.recording)) {
      if (plumb::is_image_name(entry.path())) guard.reads("RECORDING", entry.path());
    }
  }
  guard.writes("--out", arguments.options.out).check();
}

std::unique_ptr<plumb::RecordedSource> open_recording(const Arguments& arguments) {
  if (!arguments.topic.empty() && arguments.recording.extension() != ".mcap")
    throw plumb::InputError("--topic is for an MCAP file");
  if (fs::is_directory(arguments.recording)) {
    return std::make_unique<plumb::FolderSource>(
        plumb::ImageFolderOptions{arguments.recording, arguments.rate_hz, arguments.times});
  }
  if (arguments.rate_hz > 0.0 || !arguments.times.empty())
    throw plumb::InputError("--rate and --times are for a folder; a file has times of its own");
  if (arguments.recording.extension() == ".mcap")
    return std::make_unique<plumb::McapSource>(arguments.recording.string(), arguments.topic);
  return std::make_unique<plumb::VideoSource>(arguments.recording.string());
}

void print_result(const plumb::RecordingResult& result, const plumb::CameraConfig& camera,
                  const Arguments& arguments) {
  std::cout << plumb::format(
      "%s: %lld frames of %dx%d, %.1f s, %.1f MB; camera from %s%s\n",
      arguments.options.out.c_str(), static_cast<long long>(result.num_frames), camera.width_px,
      camera.height_px, result.duration_s, 1e-6 * static_cast<double>(result.log_bytes),
      arguments.camera.c_str(), result.stopped ? "; stopped early" : "");
  if (result.num_faulty > 0) {
    plumb::log_line("warning: %lld frames are black, flat or frozen",
                    static_cast<long long>(result.num_faulty));
  }
  if (result.concern != nullptr) plumb::log_line("warning: %s", result.concern);
  if (camera.camera_height_m == 0.0) {
    plumb::log_line(
        "warning: the camera file states no camera_height_m; the scale will be that of "
        "ground.camera_height_m");
  }
}

int run(Arguments* arguments) {
  if (!fs::exists(arguments->recording))
    throw plumb::InputError("cannot read " + arguments->recording.string());
  plumb::RecordingOptions& options = arguments->options;
  if (options.start && options.end && *options.end < *options.start)
    throw plumb::InputError("--end is before --start");
  find_camera(arguments);
  refuse_overwriting(*arguments);
  plumb::CameraConfig camera = plumb::read_camera_file(arguments->camera);
  options.mask_folder = arguments->camera.parent_path();
  options.jpeg = arguments->compress == "jpeg";
  if (!arguments->vehicle_speed.empty()) {
    for (const plumb::NumberRow& row : plumb::read_number_rows(arguments->vehicle_speed, 1, 1))
      options.vehicle_speeds_m_s.push_back(row.values[0]);
  }
  plumb::catch_stop_signals();
  const std::unique_ptr<plumb::RecordedSource> source = open_recording(*arguments);
  source->complete(&camera);
  print_result(plumb::convert_recording(source.get(), camera, options), camera, *arguments);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  // OpenCV is silenced, so that each error is reported once and by this program.
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  plumb::set_log_name("plumb-convert");
  Arguments arguments;
  plumb::CommandLine app("Converts a video, a folder of images or an MCAP file to an LCM log",
                         "plumb-convert");
  add_options(&app, &arguments);
  return plumb::tool_main(&app, argc, argv, [&] { return run(&arguments); });
}
