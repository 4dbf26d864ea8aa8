/// plumb-convert: converts a video file or a folder of images to an LCM log.

#include <iostream>
#include <memory>
#include <opencv2/core/utils/logger.hpp>
#include <string>

#include "core/input_error.hpp"
#include "modules/camera/folder_source.hpp"
#include "modules/camera/video_source.hpp"
#include "modules/datasets/text.hpp"
#include "platform/command_line.hpp"
#include "platform/overwrite_guard.hpp"
#include "tools/run/convert/camera_file.hpp"
#include "tools/run/convert/convert.hpp"
#include "tools/support/stop_flag.hpp"
#include "tools/support/tool_main.hpp"

namespace {

constexpr const char* kFooter =
    R"(RECORDING is a video file, or a folder of images (jpg, png, bmp, pgm, tif, webp; colour becomes grey). The images
are taken in the order of the numbers in their names. The log holds what plumb-camera would publish: rectified by the
camera file, masked by its camera.mask_* settings.

The camera file is TOML with [camera] (docs/add_a_camera.md), or a KITTI calib.txt. Without --camera, camera.toml or
calib.txt beside the recording is used.

Examples
  plumb-convert dashcam.mp4 --camera camera.toml --out drive.lcm
  plumb-convert frames/ --rate 20 --camera camera.toml --compress jpeg --out drive.lcm
  plumb-replay drive.lcm --csv drive.csv --poses drive.txt)";

struct Arguments {
  std::filesystem::path recording;
  std::filesystem::path camera;
  plumb::ImageFolderOptions folder;
  plumb::RecordingOptions recording_options;
  std::string compress = "none";
};

void add_options(plumb::CommandLine* app, Arguments* arguments) {
  app->footer(kFooter);
  app->add_option("RECORDING", arguments->recording, "video file or folder of images").required();
  app->add_option("--out", arguments->recording_options.out, "log to write").required();
  app->add_option("--camera", arguments->camera,
                  "camera file [camera.toml or calib.txt beside it]");
  plumb::Option rate = app->add_option("--rate", arguments->folder.rate_hz, "images/s of a folder")
                           .check(plumb::within(0.1, 1000.0));
  app->add_option("--times", arguments->folder.times,
                  "file with one time per image of a folder, s [times.txt in it or beside it]")
      .excludes(rate);
  app->add_option("--compress", arguments->compress,
                  "none: plain pixels; jpeg: quality 95, about a quarter of the size")
      .check(plumb::one_of({"none", "jpeg"}))
      .capture_default_str();
  app->add_option("--start", arguments->recording_options.start, "first frame number")
      .check(plumb::at_least(0));
  app->add_option("--end", arguments->recording_options.end, "last frame number")
      .check(plumb::at_least(0));
}

std::unique_ptr<plumb::RecordedSource> open_recording(Arguments* arguments) {
  const bool is_folder = std::filesystem::is_directory(arguments->recording);
  if (is_folder) {
    arguments->folder.folder = arguments->recording;
    return std::make_unique<plumb::FolderSource>(arguments->folder);
  }
  if (arguments->folder.rate_hz > 0.0 || !arguments->folder.times.empty())
    throw plumb::InputError("--rate and --times go with a folder; a video has its own times");
  return std::make_unique<plumb::VideoSource>(arguments->recording.string());
}

void refuse_overwriting(const Arguments& arguments) {
  plumb::OverwriteGuard guard;
  guard.reads("--camera", arguments.camera).reads("--times", arguments.folder.times);
  if (std::filesystem::is_directory(arguments.recording)) {
    guard.reads_folder("RECORDING", arguments.recording, {".txt", ".toml", ".png", ".jpg"});
  } else {
    guard.reads("RECORDING", arguments.recording);
  }
  guard.writes("--out", arguments.recording_options.out).check();
}

plumb::CameraConfig read_camera(Arguments* arguments) {
  if (arguments->camera.empty()) {
    arguments->camera = plumb::find_camera_file(arguments->recording);
    if (arguments->camera.empty()) {
      throw plumb::InputError(
          "no camera file: neither --camera nor camera.toml or calib.txt beside " +
          arguments->recording.string());
    }
    std::cerr << "plumb-convert: camera from " << arguments->camera.string() << "\n";
  }
  const plumb::CameraConfig camera = plumb::read_camera_file(arguments->camera);
  if (!(camera.fx_px > 0.0 && camera.fy_px > 0.0)) {
    throw plumb::InputError(arguments->camera.string() +
                            " does not state camera.fx_px and camera.fy_px");
  }
  return camera;
}

int run(Arguments arguments) {
  if (!std::filesystem::exists(arguments.recording))
    throw plumb::InputError("cannot read " + arguments.recording.string());
  plumb::CameraConfig camera = read_camera(&arguments);
  refuse_overwriting(arguments);
  plumb::catch_stop_signals();
  const std::unique_ptr<plumb::RecordedSource> source = open_recording(&arguments);
  source->complete(&camera);
  for (const std::string& note : source->notes()) std::cerr << "plumb-convert: " << note << "\n";
  plumb::RecordingOptions& options = arguments.recording_options;
  options.jpeg = arguments.compress == "jpeg";
  options.mask_folder = arguments.camera.parent_path();
  const plumb::RecordingResult result = plumb::convert_recording(source.get(), camera, options);
  std::cout << plumb::format("%s: %lld frames of %dx%d, %.1f s, %.1f MB%s\n", options.out.c_str(),
                             static_cast<long long>(result.num_frames), result.width_px,
                             result.height_px, result.duration_s,
                             1e-6 * static_cast<double>(result.log_bytes),
                             result.stopped ? "; stopped early" : "");
  if (result.num_faulty > 0) {
    std::cerr << plumb::format("plumb-convert: warning: %lld frames are dark, flat or frozen\n",
                               static_cast<long long>(result.num_faulty));
  }
  if (camera.camera_height_m <= 0.0) {
    std::cerr << "plumb-convert: warning: the camera file states no camera.camera_height_m; the "
                 "scale will be that of ground.camera_height_m\n";
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  // OpenCV is silenced, so that each error is reported once and by this program.
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  Arguments arguments;
  plumb::CommandLine app("Converts a video or a folder of images to an LCM log", "plumb-convert");
  add_options(&app, &arguments);
  return plumb::tool_main(&app, argc, argv, [&] { return run(arguments); });
}
