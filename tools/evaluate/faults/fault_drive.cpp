#include "tools/evaluate/faults/fault_drive.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>

#include "core/channels.hpp"
#include "core/input_error.hpp"
#include "core/pose_wire.hpp"
#include "modules/camera/image_wire.hpp"
#include "platform/bounded_decode.hpp"
#include "platform/log_file.hpp"
#include "plumb/ground_truth_t.hpp"

namespace plumb {
namespace {

// The true speed is averaged over this many images to either side: positions by GPS jitter.
constexpr std::size_t kSpeedReach = 4;

Pixels packed(const ImageView& view) {
  auto pixels = std::make_shared<std::vector<std::uint8_t>>();
  pixels->reserve(static_cast<std::size_t>(view.width_px) *
                  static_cast<std::size_t>(view.height_px));
  for (int v = 0; v < view.height_px; ++v) {
    pixels->insert(pixels->end(), view.row(v), view.row(v) + view.width_px);
  }
  return pixels;
}

/// Collects a log's messages until the images can be put together.
class DriveReader {
 public:
  void take(const LogEvent& event) {
    if (event.channel == kCameraCalibration.name) take_calibration(event.data);
    if (event.channel == kCamera.name) take_image(event.data);
    if (event.channel == kGroundTruth.name) take_truth(event.data);
  }

  FaultDrive finish(const std::string& log) {
    if (!camera_) throw InputError(log + " holds no CAMERA_CALIBRATION");
    if (images_.empty()) throw InputError(log + " holds no image on CAMERA");
    set_positions(log);
    set_speeds();
    return {std::filesystem::path(log).stem().string(), *camera_, std::move(images_)};
  }

 private:
  void take_calibration(std::span<const std::uint8_t> bytes) {
    camera_calibration_t message;
    CameraModel camera;
    if (camera_ || !decode_bounded(bytes, &message) || from_wire(message, &camera) != nullptr)
      return;
    camera_ = camera;
    decoder_.emplace(camera.width_px, camera.height_px);
  }

  void take_image(std::span<const std::uint8_t> bytes) {
    ImageFrame frame;
    ImageView view;
    if (!decoder_ || read_image(bytes, &frame) != nullptr) return;
    if (decoder_->check(frame) != nullptr || decoder_->decode(frame, &view) != nullptr) return;
    images_.push_back({frame.capture_us, frame.seq, packed(view)});
  }

  void take_truth(std::span<const std::uint8_t> bytes) {
    ground_truth_t message;
    if (!decode_bounded(bytes, &message) || message.has_pose == 0) return;
    positions_[message.seq] = Eigen::Vector3d(message.t_world_cam_m);
  }

  void set_positions(const std::string& log) {
    double distance_m = 0.0;
    std::optional<Eigen::Vector3d> last;
    for (RecordedImage& image : images_) {
      const auto found = positions_.find(image.seq);
      if (found == positions_.end()) throw InputError(log + " lacks the true pose of an image");
      if (last) distance_m += (found->second - *last).norm();
      last = found->second;
      image.position_m = distance_m;
    }
  }

  void set_speeds() {
    for (std::size_t i = 0; i < images_.size(); ++i) {
      const RecordedImage& from = images_[i < kSpeedReach ? 0 : i - kSpeedReach];
      const RecordedImage& to = images_[std::min(i + kSpeedReach, images_.size() - 1)];
      const auto passed_us = static_cast<double>(to.capture_us - from.capture_us);
      images_[i].speed_m_s = 1e6 * (to.position_m - from.position_m) / passed_us;
    }
  }

  std::optional<CameraModel> camera_;
  std::optional<ImageDecoder> decoder_;
  std::vector<RecordedImage> images_;
  std::map<std::int64_t, Eigen::Vector3d> positions_;
};

}  // namespace

FaultDrive read_fault_drive(const std::string& log) {
  LogReader reader(log);
  DriveReader drive;
  for (LogEvent event; reader.next(&event);) drive.take(event);
  return drive.finish(log);
}

}  // namespace plumb
