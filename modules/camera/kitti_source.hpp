/// A KITTI sequence (odometry or raw drive) as a recording. Its sequence numbers, times and
/// calibration equal those of plumb-kitti2lcm, because both use the same reader.
///
/// Memory:
///   File names and times are read at construction, images one at a time.
#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>

#include "modules/camera/recorded_source.hpp"
#include "modules/datasets/kitti/sequence.hpp"

namespace plumb {

class KittiSource final : public RecordedSource {
 public:
  /// Reads the folder and the first image. Cameras 0 and 1 are grey; 2 and 3 are colour, which is
  /// converted to grey. Throws InputError.
  KittiSource(const std::filesystem::path& folder, int camera);

  /// Takes the size and the focal lengths from the folder, which `config` must not contradict.
  /// Takes the camera height, the read-out time and the residual distortion from the folder unless
  /// `config` sets them.
  void complete(CameraConfig* config) const override;
  [[nodiscard]] bool read(GreyFrame* frame) override;

  [[nodiscard]] std::int64_t num_frames() const override {
    return static_cast<std::int64_t>(sequence_.frames.size());
  }

 private:
  void load(const std::filesystem::path& file);

  Sequence sequence_;
  std::size_t next_ = 0;
  cv::Mat image_;
};

}  // namespace plumb
