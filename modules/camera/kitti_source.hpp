/// A KITTI sequence, odometry or raw drive, with the numbers, times and calibration that plumb-kitti2lcm
/// gives it: both read it with the same code.
///
/// Memory   file names and times are read at construction; images one by one.
#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>

#include "modules/camera/recorded_source.hpp"
#include "modules/datasets/kitti/sequence.hpp"

namespace plumb {

class KittiSource final : public RecordedSource {
 public:
  /// `camera` 0 and 1 are grey, 2 and 3 colour that becomes grey. Reads the folder and the first
  /// image. Throws InputError.
  KittiSource(const std::filesystem::path& folder, int camera);

  /// Size and focal lengths are the folder's, and may not contradict `config`; camera_height_m and
  /// residual_k1 are the folder's unless `config` sets them.
  void complete(CameraConfig* config) const override;
  [[nodiscard]] bool read(GreyFrame* frame) override;

  [[nodiscard]] std::size_t num_frames() const { return sequence_.frames.size(); }

 private:
  void load(const std::filesystem::path& file);

  Sequence sequence_;
  std::size_t next_ = 0;
  cv::Mat image_;
};

}  // namespace plumb
