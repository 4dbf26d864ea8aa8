/// Everything that plumb-camera does between a grey frame and the messages CAMERA and
/// CAMERA_CALIBRATION.
///
/// Memory:
///   Images and tables are allocated at construction.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "core/camera_model.hpp"
#include "core/stage_probe.hpp"
#include "modules/camera/camera_config.hpp"
#include "modules/camera/front_end.hpp"
#include "modules/camera/recorded_source.hpp"
#include "plumb/camera_calibration_t.hpp"
#include "plumb/image_t.hpp"

namespace plumb {

class CameraNode {
 public:
  /// A relative camera.mask_file is relative to `folder`.
  /// `probe` outlives the node. `session` names this run in the images. Throws UsageError.
  /// @pre the image size and the focal lengths in `config` are set
  CameraNode(const CameraConfig& config, const std::filesystem::path& folder, StageProbe* probe,
             std::int64_t session = 0);

  /// Builds the message of the frame, which is valid until the next call.
  /// @pre the frame has the configured size
  [[nodiscard]] const image_t& take(const GreyFrame& frame);
  [[nodiscard]] camera_calibration_t calibration(std::int64_t capture_us) const;

  /// The fault of the newest images.
  [[nodiscard]] ImageFault fault() const { return fault_; }
  /// [bytes] The largest encoding of CAMERA.
  [[nodiscard]] std::size_t max_bytes() const;

 private:
  CameraModel model_;
  StageProbe* probe_;
  std::int64_t session_;
  FrontEnd front_end_;
  std::vector<std::uint8_t> published_;
  image_t message_{};
  ImageFault fault_ = ImageFault::kNone;
};

}  // namespace plumb
