/// The interface of recordings that are played like a camera.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/image_view.hpp"
#include "modules/camera/camera_config.hpp"

namespace plumb {

struct GreyFrame {
  std::int64_t capture_us = 0;  ///< mid-exposure time on the clock of the source
  std::int64_t seq = 0;         ///< increases by one per captured frame
  ImageView image;              ///< valid until the source's next call
};

class RecordedSource {
 public:
  virtual ~RecordedSource() = default;

  /// Completes `config` with what the recording knows about its camera. Throws InputError when the
  /// two contradict each other.
  virtual void complete(CameraConfig* config) const = 0;

  /// Reads the next frame. Returns false after the last.
  /// Throws InputError when the recording is damaged.
  [[nodiscard]] virtual bool read(GreyFrame* frame) = 0;

  /// Number of frames that the recording says it has; 0 when it does not say.
  [[nodiscard]] virtual std::int64_t num_frames() const = 0;

  /// What the user should know about the recording, as sentences.
  [[nodiscard]] virtual std::vector<std::string> notes() const { return {}; }
};

/// Writes the size of a recording's images to `config`. Throws UsageError, which names `file`, when
/// `config` states another one.
void complete_size(const std::string& file, int width_px, int height_px, CameraConfig* config);

}  // namespace plumb
