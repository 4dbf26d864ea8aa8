/// Everything that plumb-detect does between the bytes of CAMERA and DETECTIONS.
///
/// Rate:
///   take_image() keeps only the newest image, and search() searches it when the caller has time. A
///   detector need not keep pace with the camera, so an image that is replaced before its search
///   counts as skipped.
/// Memory:
///   OpenCV's networks allocate.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "modules/camera/image_wire.hpp"
#include "modules/detections/detections_wire.hpp"
#include "modules/detector/network_source.hpp"

namespace plumb {

class DetectorNode {
 public:
  /// Loads the network. Throws ConfigError.
  explicit DetectorNode(const DetectorConfig& config) : config_(config), network_(config) {}

  /// Keeps a copy of the image. Returns null, or the reason why it was refused.
  [[nodiscard]] const char* take_image(std::span<const std::uint8_t> image_bytes);

  /// Searches the newest image. Returns its detections in the order of their scores, valid until
  /// the next call. Returns null when no new image waits, and also when the image cannot be read;
  /// then `refused` is the reason.
  [[nodiscard]] const detections_t* search(const char** refused);

  /// Number of images that were replaced before they were searched.

  [[nodiscard]] std::int64_t num_skipped() const { return num_skipped_; }

 private:
  DetectorConfig config_;
  Network network_;
  std::optional<ImageDecoder> decoder_;
  int width_px_ = 0;
  int height_px_ = 0;
  std::vector<std::uint8_t> newest_;
  bool waiting_ = false;
  std::int64_t num_skipped_ = 0;
  DetectionFrame frame_;
  detections_t message_{};
};

}  // namespace plumb
