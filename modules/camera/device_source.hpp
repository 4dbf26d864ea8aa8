/// A V4L2 camera as a source of grey frames. Its sequence numbers continue after the device was
/// lost and opened again.
///
/// Time:
///   The capture time is the driver's stamp plus camera.stamp_offset_s. When the driver gives no
///   stamp, the time of dequeuing is used.
/// Sequence:
///   Numbers follow the driver's counter, so that dropped frames show as a gap. After a loss of the
///   device the gap is the duration of the loss divided by the frame period.
/// Memory:
///   One grey image and, for MJPEG, OpenCV's decoder, which allocates in every call.
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
  kNothing,   ///< no frame waits
  kFrame,     ///< a frame was taken
  kRejected,  ///< a frame arrived that cannot be used; rejection() is the reason
  kLost,      ///< the device was lost and is closed; why() is the reason
};

class DeviceSource {
 public:
  DeviceSource(const CameraConfig& config, const std::string& device);

  /// Opens the device for the first time and writes its image size to `config`. Throws UsageError
  /// when the device does not offer what the configuration requests.
  void open_first(CameraConfig* config);
  /// Opens the device again after a loss, with the same size and any of the formats. Returns false,
  /// with the reason in why(), when that fails.
  [[nodiscard]] bool reopen();
  /// Closes a device that delivers no more frames; `why` becomes why().
  void give_up(const std::string& why);

  [[nodiscard]] int fileno() const { return camera_.fileno(); }
  [[nodiscard]] bool is_open() const { return camera_.is_open(); }
  /// Takes the next frame. It is valid until release() or the next call.
  [[nodiscard]] DeviceStep take(GreyFrame* frame);
  /// Returns the buffer of the frame to the driver.
  void release() { camera_.release(); }

  [[nodiscard]] const std::string& why() const { return why_; }
  [[nodiscard]] const char* rejection() const { return rejection_; }
  /// Number of missing frames according to the driver's counter.
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
  std::optional<ImageDecoder> jpeg_;  ///< set once the size is known
  std::string why_;
  const char* rejection_ = "";
};

}  // namespace plumb
