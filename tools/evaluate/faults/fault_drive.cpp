#include "tools/evaluate/faults/fault_drive.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
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

// Positions by satellites jitter by centimetres, and some jump by decimetres for one image. A cubic
// over this many images to either side smooths them, blind to what lies far from it.
constexpr std::size_t kSmoothingReach = 10;
constexpr double kJitter_m = 0.03;
constexpr int kSmoothingIterations = 6;

/// The value at x = 0 of the cubic through (x, y), by least squares with Cauchy weights.
double smooth_value(const std::vector<double>& x, const std::vector<double>& y) {
  Eigen::Vector4d c = Eigen::Vector4d::Zero();
  for (int iteration = 0; iteration < kSmoothingIterations; ++iteration) {
    Eigen::Matrix4d H = 1e-9 * Eigen::Matrix4d::Identity();
    Eigen::Vector4d b = Eigen::Vector4d::Zero();
    for (std::size_t i = 0; i < x.size(); ++i) {
      const Eigen::Vector4d a(1.0, x[i], x[i] * x[i], x[i] * x[i] * x[i]);
      const double e = iteration == 0 ? 0.0 : (y[i] - a.dot(c)) / kJitter_m;
      H += a * a.transpose() / (1.0 + e * e);
      b += a * y[i] / (1.0 + e * e);
    }
    c = H.ldlt().solve(b);
  }
  return c(0);
}

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
    smooth_positions();
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

  void smooth_positions() {
    std::vector<double> smooth(images_.size());
    for (std::size_t i = 0; i < images_.size(); ++i) {
      std::vector<double> x, y;
      const std::size_t from = i < kSmoothingReach ? 0 : i - kSmoothingReach;
      for (std::size_t k = from; k < std::min(images_.size(), i + kSmoothingReach + 1); ++k) {
        x.push_back(1e-6 * static_cast<double>(images_[k].capture_us - images_[i].capture_us));
        y.push_back(images_[k].position_m - images_[i].position_m);
      }
      smooth[i] = images_[i].position_m + smooth_value(x, y);
    }
    for (std::size_t i = 0; i < images_.size(); ++i) images_[i].position_m = smooth[i];
  }

  void set_speeds() {
    for (std::size_t i = 1; i < images_.size(); ++i) {
      const RecordedImage& last = images_[i - 1];
      const auto passed_us = static_cast<double>(images_[i].capture_us - last.capture_us);
      images_[i].speed_m_s = 1e6 * (images_[i].position_m - last.position_m) / passed_us;
    }
    if (images_.size() > 1) images_[0].speed_m_s = images_[1].speed_m_s;
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
