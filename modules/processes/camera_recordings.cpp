/// plumb-camera with a recording: video, folder of images or KITTI folder -> CAMERA,
/// CAMERA_CALIBRATION
///
/// plumb-camera starts this program, which OpenCV makes large, when it is given a recording.
#include <filesystem>
#include <memory>
#include <opencv2/core/utils/logger.hpp>
#include <optional>
#include <string>

#include "modules/camera/folder_source.hpp"
#include "modules/camera/kitti_source.hpp"
#include "modules/camera/player_node.hpp"
#include "modules/camera/publish_node.hpp"
#include "modules/camera/video_source.hpp"
#include "modules/chain/plumb_config.hpp"
#include "modules/processes/camera_options.hpp"
#include "platform/log.hpp"
#include "platform/process.hpp"

namespace {

std::unique_ptr<plumb::RecordedSource> open_recording(const plumb::CameraOptions& options) {
  if (!options.kitti.empty())
    return std::make_unique<plumb::KittiSource>(options.kitti, options.kitti_camera);
  if (!options.video.empty()) return std::make_unique<plumb::VideoSource>(options.video);
  if (!options.images.empty()) {
    return std::make_unique<plumb::FolderSource>(
        plumb::ImageFolderOptions{options.images, options.rate_hz, {}});
  }
  throw plumb::UsageError("no recording: give --video, --images or --kitti");
}

class RecordingProcess {
 public:
  RecordingProcess(plumb::Process& process, plumb::CameraConfig config,
                   const plumb::CameraOptions& options, const std::filesystem::path& folder)
      : recording_(open_recording(options)) {
    for (const std::string& note : recording_->notes()) plumb::log_line("%s", note.c_str());
    recording_->complete(&config);
    output_.emplace(process, config, folder);
    player_.emplace(process, *recording_, *output_, options.speed);
  }

 private:
  std::unique_ptr<plumb::RecordedSource> recording_;
  std::optional<plumb::PublishNode> output_;
  std::optional<plumb::PlayerNode> player_;
};

}  // namespace

int main(int argc, char** argv) {
  plumb::Process process(
      {"camera", plumb::kCameraSummary, plumb::kHealthCamera, /*is_cyclic=*/true});
  // OpenCV is silenced, so that each error is reported once and by this process.
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  plumb::PlumbConfig config;
  plumb::CameraOptions options;
  process.declare_options(
      [&options](plumb::CommandLine& app) { plumb::declare_camera_options(app, &options); });
  std::optional<RecordingProcess> camera;
  return process.run(argc, argv, &config, [&] {
    const std::filesystem::path stating_mask = process.config_path_of("camera.mask_file");
    const auto folder = stating_mask.parent_path();
    camera.emplace(process, config.camera, options, folder);
  });
}
