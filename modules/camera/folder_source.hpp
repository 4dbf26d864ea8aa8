/// A folder of images as a recording (modules/datasets/folder).
///
/// Sequence:
///   The number of a frame is that in the name of its image, where names have one.
/// Time:
///   That of the folder. Times that begin before 2001-09-09 01:46:40 UTC count from the start of
///   the recording, and that moment is added, as for KITTI.
/// Memory:
///   File names and times are read at construction, images one at a time.
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "modules/camera/recorded_source.hpp"
#include "modules/datasets/folder/image_folder.hpp"

namespace plumb {

class FolderSource final : public RecordedSource {
 public:
  /// Lists the folder and reads the first image. Throws InputError.
  explicit FolderSource(const ImageFolderOptions& options);

  void complete(CameraConfig* config) const override;
  [[nodiscard]] bool read(GreyFrame* frame) override;
  [[nodiscard]] std::int64_t num_frames() const override {
    return static_cast<std::int64_t>(folder_.images.size());
  }
  [[nodiscard]] std::vector<std::string> notes() const override { return folder_.notes; }

 private:
  ImageFolder folder_;
  std::int64_t epoch_us_;  ///< added to the times of the folder
  std::size_t next_ = 0;
  cv::Mat image_;
};

}  // namespace plumb
