/// A V4L2 camera as grey frames with sequence numbers that survive its loss and return.
///
/// Time     the driver's stamp plus camera.stamp_offset_s; dequeue time when the driver keeps none.
/// seq      from the driver's counter: what it dropped shows as a gap. Over a loss of the device the gap
///          is the silence divided by the frame period.
/// Memory   one grey image and, for MJPEG, OpenCV's decoder, which allocates inside.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "modules/camera/camera_config.hpp"
#include "modules/camera/convert.hpp"
#include "modules/camera/image_wire.hpp"
#include "modules/camera/pacing.hpp"
#include "modules/camera/recorded_source.hpp"
#include "platform/v4l2.hpp"

namespace plumb {

enum class DeviceStep : std::uint8_t {
  kNothing,   ///< nothing is waiting
  kFrame,     ///< here is one
  kRejected,  ///< one came, unusable: rejection() says why
  kLost,      ///< the device is closed: why() says what happened
};

class DeviceSource {
 public:
  DeviceSource(const CameraConfig& config, const std::string& device);

  /// Opens for the first time, and takes the size it has. Throws UsageError when it is not what
  /// the configuration asks for.
  void open_first(CameraConfig* config);
  /// Opens again after a loss: same size, any of the formats. False with why().
  [[nodiscard]] bool reopen();
  /// Closes a device that has gone silent.
  void give_up(const std::string& why);

  [[nodiscard]] int fileno() const { return camera_.fileno(); }
  [[nodiscard]] bool is_open() const { return camera_.is_open(); }
  [[nodiscard]] DeviceStep take(GreyFrame* frame);
  /// The frame has been used: its buffer goes back to the driver.
  void release() { camera_.release(); }

  [[nodiscard]] const std::string& why() const { return why_; }
  [[nodiscard]] const char* rejection() const { return rejection_; }
  /// Frames missing by the driver's counter.
  [[nodiscard]] std::int64_t num_missing() const { return sequence_.num_missing(); }

 private:
  DeviceStep reject(const char* why);
  void prepare();
  void count_silence(std::int64_t capture_us);
  const char* to_grey(const V4l2Frame& raw, ImageView* image);

  V4l2Request request_;
  std::int64_t stamp_offset_us_;
  V4l2Camera camera_;
  PixelFormat format_ = PixelFormat::kGrey;
  SequenceTracker sequence_;
  bool reopened_ = false;
  bool has_last_ = false;
  std::int64_t last_capture_us_ = 0;
  std::vector<std::uint8_t> grey_;
  std::optional<ImageDecoder> jpeg_;  ///< once the size is known
  std::string why_;
  const char* rejection_ = "";
};

}  // namespace plumb
