/// A V4L2 capture device: buffers shared with the driver, its time stamps and its frame counter.
///
/// Errors:
///   A failure is a value. An unplugged device, a failed stream and a frame that the driver marks
///   as damaged have values of their own. Nothing here retries; the caller decides.
/// Units:
///   Time stamps are in microseconds of CLOCK_MONOTONIC, which is the clock of the drivers.
/// Memory:
///   open() maps the buffers of the driver; take() allocates nothing.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace plumb {

/// What the caller requests of a device.
struct V4l2Request {
  std::string device;                ///< "/dev/video0"
  std::vector<std::string> fourccs;  ///< acceptable formats, best first
  int width_px = 0;                  ///< 0: the size that the device has set
  int height_px = 0;                 ///< 0: the size that the device has set
  double rate_hz = 0.0;              ///< 0: the rate that the device has set
  int num_buffers = 4;
};

/// What the device granted.
struct V4l2Format {
  std::string fourcc;
  int width_px = 0;
  int height_px = 0;
  std::size_t stride_bytes = 0;
  double rate_hz = 0.0;  ///< 0 when the driver does not report it
  int num_buffers = 0;
  std::string card;
};

struct V4l2Frame {
  std::span<const std::uint8_t> bytes;  ///< the driver's buffer; valid until release()
  std::int64_t stamp_us = 0;  ///< time of dequeuing when the driver gives no monotonic time
  bool stamped_by_driver = false;
  std::uint32_t sequence = 0;  ///< driver's counter; a step above 1 means dropped frames
};

enum class V4l2Status : std::uint8_t {
  kFrame,
  kNothing,  ///< no frame is waiting
  kCorrupt,  ///< the driver marked the frame as damaged; `sequence` and `stamp_us` are valid
  kGone,     ///< the device was unplugged
  kFailed,   ///< the stream failed, but the device is still present
};

class V4l2Camera {
 public:
  /// Throws std::system_error when the system has no descriptors left.
  V4l2Camera();
  ~V4l2Camera();
  V4l2Camera(const V4l2Camera&) = delete;
  V4l2Camera& operator=(const V4l2Camera&) = delete;

  /// A descriptor that is readable while take() has a result.
  /// It stays the same over open() and close().
  [[nodiscard]] int fileno() const { return epoll_fd_; }

  /// Opens the device, negotiates the format and starts streaming. Returns false, with the device
  /// closed and the reason in why(), when any step is refused. A format or size that the driver
  /// replaces by another counts as refused.
  [[nodiscard]] bool open(const V4l2Request& request);
  void close();
  [[nodiscard]] bool is_open() const { return fd_ >= 0; }

  /// @pre is_open()
  [[nodiscard]] const V4l2Format& format() const { return format_; }

  /// Releases the previous frame and takes the oldest that waits. Never blocks.
  /// @pre is_open()
  [[nodiscard]] V4l2Status take(V4l2Frame* frame);
  /// Returns the frame's buffer to the driver.
  /// The sooner this is called, the fewer buffers the driver needs.
  void release();

  /// The reason why open() refused, or why take() returned kGone or kFailed.
  [[nodiscard]] const std::string& why() const { return why_; }

  static constexpr int kMaxBuffers = 32;

 private:
  struct Mapping {
    void* address = nullptr;
    std::size_t bytes = 0;
  };
  bool refuse(const std::string& why);
  bool refuse_errno(const char* what);
  bool check_capabilities();
  bool choose_format(const V4l2Request& request);
  bool try_format(const V4l2Request& request, const std::string& fourcc, bool* fits);
  bool choose_rate(double rate_hz);
  bool map_buffers(int count);
  bool start();
  V4l2Status lost(int error);
  [[nodiscard]] bool has_hung_up() const;

  int epoll_fd_ = -1;
  int fd_ = -1;
  std::string device_;
  V4l2Format format_;
  std::array<Mapping, kMaxBuffers> mappings_{};
  int held_ = -1;  ///< index of the buffer that the caller reads; -1 for none
  std::string why_;
};

}  // namespace plumb
