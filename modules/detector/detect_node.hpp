/// Everything plumb-detect does between the bytes of CAMERA and DETECTIONS.
///
/// Rate    take_image() only keeps the newest image; search() looks at it when the caller has time. Images that were
///         replaced before they were searched are counted, not lost: a detector need not keep the camera's pace.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "modules/camera/image_wire.hpp"
#include "modules/detections/detections_wire.hpp"
#include "modules/detector/network_source.hpp"

namespace plumb {

class DetectNode {
 public:
  /// Throws ConfigError.
  explicit DetectNode(const DetectConfig& config) : config_(config), network_(config) {}

  /// Null when taken, else why it was refused.
  [[nodiscard]] const char* take_image(std::span<const std::uint8_t> image_bytes);

  /// Detections of the newest image, in the order of their scores; null when there is none that was not searched yet, or
  /// when it could not be read (`refused` says why then). Valid until the next call.
  [[nodiscard]] const detections_t* search(const char** refused);

  [[nodiscard]] std::int64_t num_passed_over() const { return num_passed_over_; }

 private:
  DetectConfig config_;
  Network network_;
  std::optional<ImageDecoder> decoder_;
  int width_px_ = 0;
  int height_px_ = 0;
  std::vector<std::uint8_t> newest_;
  bool waiting_ = false;
  std::int64_t num_passed_over_ = 0;
  DetectionFrame frame_;
  detections_t message_{};
};

}  // namespace plumb
