/// A V4L2 capture device: buffers shared with the driver, its time stamps and its frame counter.
///
/// Failure  is a value: a device that was unplugged, a stream that died and a frame that the driver
///          marks as damaged are told apart. Nothing here retries; the caller decides.
/// Units    [us] CLOCK_MONOTONIC, as drivers stamp.
/// Memory   the driver's buffers are mapped by open(); take() allocates nothing.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace plumb {

/// What to ask of a device.
struct V4l2Request {
  std::string device;                ///< "/dev/video0"
  std::vector<std::string> fourccs;  ///< acceptable formats, best first
  int width_px = 0;                  ///< 0: the device's own size
  int height_px = 0;
  double rate_hz = 0.0;  ///< 0: the device's own rate
  int num_buffers = 4;
};

/// What it granted.
struct V4l2Format {
  std::string fourcc;
  int width_px = 0;
  int height_px = 0;
  std::size_t stride_bytes = 0;
  double rate_hz = 0.0;  ///< 0 when the driver does not tell
  int num_buffers = 0;
  std::string card;
};

struct V4l2Frame {
  std::span<const std::uint8_t> bytes;  ///< the driver's buffer; until release()
  std::int64_t stamp_us = 0;
  bool stamped_by_driver =
      false;                   ///< false: the driver keeps no monotonic time, this is dequeue time
  std::uint32_t sequence = 0;  ///< driver's counter; a step above 1 is a frame it dropped
};

enum class V4l2Status : std::uint8_t {
  kFrame,
  kNothing,  ///< no frame is waiting
  kCorrupt,  ///< a frame the driver marked as damaged; `sequence` and `stamp_us` hold
  kGone,     ///< unplugged
  kFailed,   ///< the stream died, the device is still there
};

class V4l2Camera {
 public:
  /// Throws std::system_error when the system has no descriptors left.
  V4l2Camera();
  ~V4l2Camera();
  V4l2Camera(const V4l2Camera&) = delete;
  V4l2Camera& operator=(const V4l2Camera&) = delete;

  /// Readable when take() has something to say. The same descriptor over all open() and close().
  [[nodiscard]] int fileno() const { return epoll_fd_; }

  /// Opens, negotiates and starts streaming. False, closed, with why() in one sentence, when any of
  /// it is refused: a format or size that the driver replaced by another counts as refused.
  [[nodiscard]] bool open(const V4l2Request& request);
  void close();
  [[nodiscard]] bool is_open() const { return fd_ >= 0; }

  /// @pre is_open()
  [[nodiscard]] const V4l2Format& format() const { return format_; }

  /// The oldest waiting frame; never blocks. Releases the previous one.
  /// @pre is_open()
  [[nodiscard]] V4l2Status take(V4l2Frame* frame);
  /// Gives the frame's buffer back to the driver: the sooner, the fewer buffers it needs.
  void release();

  /// Why open() refused, or take() returned kGone or kFailed.
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
  int held_ = -1;  ///< index of the buffer that the caller is reading
  std::string why_;
};

}  // namespace plumb
