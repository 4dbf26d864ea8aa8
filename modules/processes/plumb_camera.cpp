/// plumb-camera: V4L2 device, video, folder of images or KITTI folder -> CAMERA, CAMERA_CALIBRATION
#include <filesystem>
#include <memory>
#include <opencv2/core/utils/logger.hpp>
#include <optional>
#include <string>

#include "modules/camera/device_source.hpp"
#include "modules/camera/folder_source.hpp"
#include "modules/camera/kitti_source.hpp"
#include "modules/camera/live_node.hpp"
#include "modules/camera/player_node.hpp"
#include "modules/camera/publish_node.hpp"
#include "modules/camera/video_source.hpp"
#include "modules/chain/plumb_config.hpp"
#include "platform/command_line.hpp"
#include "platform/log.hpp"
#include "platform/process.hpp"

namespace {

struct Options {
  std::string device;
  std::string kitti;
  int kitti_camera = 0;
  std::string video;
  std::string images;
  double rate_hz = 0.0;
  double speed = 1.0;
};

void declare(plumb::CommandLine& app, Options* options) {
  plumb::Option device =
      app.add_option("--device", options->device, "V4L2 device; default camera.device");
  plumb::Option kitti =
      app.add_option("--kitti", options->kitti, "KITTI folder: image_<n>, times.txt, calib.txt");
  plumb::Option video = app.add_option("--video", options->video, "video file");
  plumb::Option images =
      app.add_option("--images", options->images, "folder of images, in the order of their names");
  app.add_option("--rate", options->rate_hz,
                 "images/s of --images; default: times.txt, or times in the names")
      .check(plumb::within(0.1, 1000.0))
      .needs(images);
  app.add_option("--kitti-camera", options->kitti_camera, "which image_<n>; default 0")
      .check(plumb::within(0, 3))
      .needs(kitti);
  app.add_option("--speed", options->speed,
                 "pace of a recording; default 1, 0 is as fast as it goes")
      .check(plumb::within(0.0, 1000.0))
      .excludes(device);
  device.excludes(kitti).excludes(video).excludes(images);
  kitti.excludes(video).excludes(images);
  video.excludes(images);
}

class CameraProcess {
 public:
  CameraProcess(plumb::Process& process, plumb::CameraConfig config, const Options& options,
                const std::filesystem::path& folder) {
    if (!options.kitti.empty()) {
      recording_ = std::make_unique<plumb::KittiSource>(options.kitti, options.kitti_camera);
    } else if (!options.video.empty()) {
      recording_ = std::make_unique<plumb::VideoSource>(options.video);
    } else if (!options.images.empty()) {
      recording_ = std::make_unique<plumb::FolderSource>(
          plumb::ImageFolderOptions{options.images, options.rate_hz, {}});
    }
    if (recording_ != nullptr) {
      for (const std::string& note : recording_->notes()) plumb::log_line("%s", note.c_str());
      recording_->complete(&config);
      output_.emplace(process, config, folder);
      player_.emplace(process, *recording_, *output_, options.speed);
      return;
    }
    const std::string& device = options.device.empty() ? config.device : options.device;
    if (device.empty()) {
      throw plumb::UsageError(
          "no source: give --device, --video, --images, --kitti or camera.device");
    }
    device_.emplace(config, device);
    device_->open_first(&config);
    output_.emplace(process, config, folder);
    live_.emplace(process, *device_, *output_, config);
  }

 private:
  std::unique_ptr<plumb::RecordedSource> recording_;
  std::optional<plumb::DeviceSource> device_;
  std::optional<plumb::PublishNode> output_;
  std::optional<plumb::PlayerNode> player_;
  std::optional<plumb::LiveNode> live_;
};

}  // namespace

int main(int argc, char** argv) {
  plumb::Process process({"camera", "Camera, video, folder of images or KITTI folder -> CAMERA",
                          plumb::kHealthCamera, /*is_cyclic=*/true});
  // OpenCV is silenced, so that each error is reported once and by this process.
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  plumb::PlumbConfig config;
  Options options;
  process.declare_options([&options](plumb::CommandLine& app) { declare(app, &options); });
  std::optional<CameraProcess> camera;
  return process.run(argc, argv, &config, [&] {
    const std::filesystem::path stating_mask = process.config_path_of("camera.mask_file");
    const auto folder = stating_mask.parent_path();
    camera.emplace(process, config.camera, options, folder);
  });
}
