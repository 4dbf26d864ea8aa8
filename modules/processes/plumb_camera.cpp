/// plumb-camera: V4L2 device, video, folder of images or KITTI folder -> CAMERA, CAMERA_CALIBRATION
///
/// Recordings need OpenCV and its hundred libraries, which have no place in a vehicle. For them
/// another program takes over (camera_recordings.cpp).
#include <unistd.h>

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "modules/camera/device_source.hpp"
#include "modules/camera/live_node.hpp"
#include "modules/camera/publish_node.hpp"
#include "modules/chain/plumb_config.hpp"
#include "modules/processes/camera_options.hpp"
#include "platform/process.hpp"

namespace {

/// Is the word one of the options that name a recording, as "--video" or "--video=FILE"?
bool names_recording(std::string_view word) {
  constexpr std::array<std::string_view, 3> kOptions = {"--video", "--images", "--kitti"};
  for (const std::string_view option : kOptions)
    if (word.substr(0, word.find('=')) == option) return true;
  return false;
}

/// Becomes the program for recordings when the command line names one.
void hand_over_recording(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    if (!names_recording(argv[i])) continue;
    std::error_code unknown;
    const auto self = std::filesystem::read_symlink("/proc/self/exe", unknown);
    const auto program =
        self.parent_path().parent_path() / "libexec/plumbline/plumb-camera-recordings";
    ::execv(program.c_str(), argv);
    return;  // it is not installed
  }
}

class CameraProcess {
 public:
  CameraProcess(plumb::Process& process, plumb::CameraConfig config,
                const plumb::CameraOptions& options, const std::filesystem::path& folder)
      : source_(config, device_of(config, options)) {
    source_.open_first(&config);
    output_.emplace(process, config, folder);
    live_.emplace(process, source_, *output_, config);
  }

 private:
  static std::string device_of(const plumb::CameraConfig& config,
                               const plumb::CameraOptions& options) {
    if (!options.video.empty() || !options.images.empty() || !options.kitti.empty())
      throw plumb::UsageError("recordings need the package plumbline-tools");
    const std::string& device = options.device.empty() ? config.device : options.device;
    if (device.empty()) {
      throw plumb::UsageError(
          "no source: give --device, --video, --images, --kitti or camera.device");
    }
    return device;
  }

  plumb::DeviceSource source_;
  std::optional<plumb::PublishNode> output_;
  std::optional<plumb::LiveNode> live_;
};

}  // namespace

int main(int argc, char** argv) {
  hand_over_recording(argc, argv);
  plumb::Process process(
      {"camera", plumb::kCameraSummary, plumb::kHealthCamera, /*is_cyclic=*/true});
  plumb::PlumbConfig config;
  plumb::CameraOptions options;
  process.declare_options(
      [&options](plumb::CommandLine& app) { plumb::declare_camera_options(app, &options); });
  std::optional<CameraProcess> camera;
  return process.run(argc, argv, &config, [&] {
    const std::filesystem::path stating_mask = process.config_path_of("camera.mask_file");
    const auto folder = stating_mask.parent_path();
    camera.emplace(process, config.camera, options, folder);
  });
}
