/// A recording that is played like a camera.
#pragma once

#include <cstdint>

#include "core/image_view.hpp"
#include "modules/camera/camera_config.hpp"

namespace plumb {

struct GreyFrame {
  std::int64_t capture_us = 0;  ///< mid-exposure, on the source's own clock
  std::int64_t seq = 0;         ///< +1 per captured frame
  ImageView image;              ///< until the source is asked again
};

class RecordedSource {
 public:
  virtual ~RecordedSource() = default;

  /// Fills in what the recording knows about its camera and checks the rest against it.
  /// Throws InputError when they contradict each other.
  virtual void complete(CameraConfig* config) const = 0;

  /// The next frame; false after the last. Throws InputError when the recording is damaged.
  [[nodiscard]] virtual bool read(GreyFrame* frame) = 0;
};

}  // namespace plumb
