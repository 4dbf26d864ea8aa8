#include "platform/v4l2.hpp"

#include <fcntl.h>
#include <linux/videodev2.h>
#include <poll.h>
#include <sys/epoll.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <system_error>

#include "platform/clock.hpp"

namespace plumb {
namespace {

constexpr std::uint32_t kCapture = V4L2_BUF_TYPE_VIDEO_CAPTURE;

template <typename Argument>
int call(int fd, unsigned long request, Argument* argument) {
  int result = 0;
  do {
    result = ::ioctl(fd, request, argument);
  } while (result < 0 && errno == EINTR);
  return result;
}

std::uint32_t code_of(const std::string& fourcc) {
  return v4l2_fourcc(static_cast<std::uint32_t>(fourcc[0]), static_cast<std::uint32_t>(fourcc[1]),
                     static_cast<std::uint32_t>(fourcc[2]), static_cast<std::uint32_t>(fourcc[3]));
}

std::string name_of(std::uint32_t code) {
  std::string name;
  for (unsigned shift = 0; shift < 32; shift += 8) name += static_cast<char>(code >> shift & 0x7FU);
  return name;
}

std::string size_text(std::uint32_t width, std::uint32_t height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

std::int64_t to_us(const timeval& t) {
  return static_cast<std::int64_t>(t.tv_sec) * 1'000'000 + t.tv_usec;
}

v4l2_buffer capture_buffer(int index) {
  v4l2_buffer buffer{};
  buffer.type = kCapture;
  buffer.memory = V4L2_MEMORY_MMAP;
  buffer.index = static_cast<std::uint32_t>(index);
  return buffer;
}

}  // namespace

V4l2Camera::V4l2Camera() : epoll_fd_(::epoll_create1(EPOLL_CLOEXEC)) {
  if (epoll_fd_ < 0) throw std::system_error(errno, std::generic_category(), "epoll");
}

V4l2Camera::~V4l2Camera() {
  close();
  ::close(epoll_fd_);
}

bool V4l2Camera::refuse(const std::string& why) {
  why_ = device_ + ": " + why;
  close();
  return false;
}

bool V4l2Camera::refuse_errno(const char* what) {
  const int error = errno;
  return refuse(std::string(what) + ": " + std::strerror(error));
}

bool V4l2Camera::open(const V4l2Request& request) {
  close();
  device_ = request.device;
  format_ = {};
  fd_ = ::open(device_.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
  if (fd_ < 0) return refuse_errno("cannot be opened");
  return check_capabilities() && choose_format(request) && choose_rate(request.rate_hz) &&
         map_buffers(request.num_buffers) && start();
}

bool V4l2Camera::check_capabilities() {
  v4l2_capability capability{};
  if (call(fd_, VIDIOC_QUERYCAP, &capability) < 0) {
    return errno == ENOTTY || errno == EINVAL ? refuse("is not a V4L2 device")
                                              : refuse_errno("cannot be asked what it is");
  }
  const bool per_node = (capability.capabilities & V4L2_CAP_DEVICE_CAPS) != 0;
  const std::uint32_t can = per_node ? capability.device_caps : capability.capabilities;
  if ((can & V4L2_CAP_VIDEO_CAPTURE) == 0) {
    return refuse((can & V4L2_CAP_VIDEO_CAPTURE_MPLANE) != 0
                      ? "has the multi-planar interface only, which is not supported"
                      : "does not capture video");
  }
  if ((can & V4L2_CAP_STREAMING) == 0) return refuse("cannot stream into shared buffers");
  const char* card = reinterpret_cast<const char*>(capability.card);
  format_.card.assign(card, ::strnlen(card, sizeof capability.card));
  return true;
}

bool V4l2Camera::choose_format(const V4l2Request& request) {
  std::string offered;
  v4l2_fmtdesc description{};
  description.type = kCapture;
  for (; call(fd_, VIDIOC_ENUM_FMT, &description) == 0; ++description.index) {
    offered.append(" ").append(name_of(description.pixelformat));
  }
  if (errno == ENODEV) return refuse_errno("cannot list its formats");
  for (const std::string& fourcc : request.fourccs) {
    if (offered.find(" " + fourcc) == std::string::npos) continue;
    bool fits = false;
    if (!try_format(request, fourcc, &fits)) return false;
    if (fits) return true;
  }
  std::string asked;
  for (const std::string& fourcc : request.fourccs) asked += " " + fourcc;
  return refuse("offers none of" + asked + "; it has" + (offered.empty() ? " nothing" : offered));
}

bool V4l2Camera::try_format(const V4l2Request& request, const std::string& fourcc, bool* fits) {
  v4l2_format format{};
  format.type = kCapture;
  if (call(fd_, VIDIOC_G_FMT, &format) < 0) return refuse_errno("does not tell its format");
  if (request.width_px > 0) format.fmt.pix.width = static_cast<std::uint32_t>(request.width_px);
  if (request.height_px > 0) format.fmt.pix.height = static_cast<std::uint32_t>(request.height_px);
  format.fmt.pix.pixelformat = code_of(fourcc);
  format.fmt.pix.field = V4L2_FIELD_NONE;
  format.fmt.pix.bytesperline = 0;
  format.fmt.pix.sizeimage = 0;
  if (call(fd_, VIDIOC_S_FMT, &format) < 0) return refuse_errno("refuses its format");
  const v4l2_pix_format& pix = format.fmt.pix;
  *fits = pix.pixelformat == code_of(fourcc);
  if (!*fits) return true;
  const bool same_width = request.width_px <= 0 || static_cast<int>(pix.width) == request.width_px;
  const bool same_height =
      request.height_px <= 0 || static_cast<int>(pix.height) == request.height_px;
  if (!same_width || !same_height) {
    return refuse("has no " + std::to_string(request.width_px) + "x" +
                  std::to_string(request.height_px) + " in " + fourcc + "; the nearest is " +
                  size_text(pix.width, pix.height));
  }
  if (pix.field != V4L2_FIELD_NONE && pix.field != V4L2_FIELD_ANY) {
    return refuse("delivers interlaced fields, not whole frames");
  }
  format_.fourcc = fourcc;
  format_.width_px = static_cast<int>(pix.width);
  format_.height_px = static_cast<int>(pix.height);
  format_.stride_bytes = pix.bytesperline;
  return true;
}

bool V4l2Camera::choose_rate(double rate_hz) {
  v4l2_streamparm parameters{};
  parameters.type = kCapture;
  if (call(fd_, VIDIOC_G_PARM, &parameters) < 0) return true;  // drivers need not implement it
  v4l2_captureparm& capture = parameters.parm.capture;
  if (rate_hz > 0.0 && (capture.capability & V4L2_CAP_TIMEPERFRAME) != 0) {
    constexpr double kTicks = 10'000.0;
    capture.timeperframe.numerator = static_cast<std::uint32_t>(kTicks);
    capture.timeperframe.denominator = static_cast<std::uint32_t>(std::lround(rate_hz * kTicks));
    if (call(fd_, VIDIOC_S_PARM, &parameters) < 0) return refuse_errno("refuses the frame rate");
  }
  const v4l2_fract& period = capture.timeperframe;
  if (period.numerator > 0)
    format_.rate_hz = static_cast<double>(period.denominator) / period.numerator;
  return true;
}

bool V4l2Camera::map_buffers(int count) {
  v4l2_requestbuffers request{};
  request.type = kCapture;
  request.memory = V4L2_MEMORY_MMAP;
  request.count = static_cast<std::uint32_t>(std::clamp(count, 2, kMaxBuffers));
  if (call(fd_, VIDIOC_REQBUFS, &request) < 0) {
    return errno == EBUSY ? refuse("is in use by another program")
                          : refuse_errno("grants no buffers");
  }
  const int granted = static_cast<int>(request.count);
  if (granted < 2 || granted > kMaxBuffers) {
    return refuse("grants " + std::to_string(granted) + " buffers, of 2 to 32");
  }
  format_.num_buffers = granted;
  for (int i = 0; i < format_.num_buffers; ++i) {
    v4l2_buffer buffer = capture_buffer(i);
    if (call(fd_, VIDIOC_QUERYBUF, &buffer) < 0) return refuse_errno("hides its buffers");
    void* address = ::mmap(nullptr, buffer.length, PROT_READ | PROT_WRITE, MAP_SHARED, fd_,
                           static_cast<off_t>(buffer.m.offset));
    if (address == MAP_FAILED) return refuse_errno("cannot share its buffers");
    mappings_[static_cast<std::size_t>(i)] = {address, buffer.length};
  }
  return true;
}

bool V4l2Camera::start() {
  for (int i = 0; i < format_.num_buffers; ++i) {
    v4l2_buffer buffer = capture_buffer(i);
    if (call(fd_, VIDIOC_QBUF, &buffer) < 0) return refuse_errno("takes no buffer");
  }
  int type = static_cast<int>(kCapture);
  if (call(fd_, VIDIOC_STREAMON, &type) < 0) {
    return errno == EBUSY ? refuse("is in use by another program")
                          : refuse_errno("does not start to stream");
  }
  epoll_event event{};
  event.events = EPOLLIN;
  if (::epoll_ctl(epoll_fd_, EPOLL_CTL_ADD, fd_, &event) < 0)
    return refuse_errno("cannot be polled");
  return true;
}

void V4l2Camera::close() {
  for (Mapping& mapping : mappings_) {
    if (mapping.address != nullptr) ::munmap(mapping.address, mapping.bytes);
    mapping = {};
  }
  held_ = -1;
  if (fd_ >= 0) ::close(fd_);  // stops the stream, frees the buffers and leaves the epoll set
  fd_ = -1;
}

V4l2Status V4l2Camera::take(V4l2Frame* frame) {
  release();
  v4l2_buffer buffer = capture_buffer(0);
  if (call(fd_, VIDIOC_DQBUF, &buffer) < 0) {
    if (errno != EAGAIN) return lost(errno);
    return has_hung_up() ? lost(EIO) : V4l2Status::kNothing;
  }
  const Mapping& mapping = mappings_[buffer.index];
  held_ = static_cast<int>(buffer.index);
  frame->bytes = {static_cast<const std::uint8_t*>(mapping.address),
                  std::min<std::size_t>(buffer.bytesused, mapping.bytes)};
  frame->sequence = buffer.sequence;
  const std::uint32_t clock = buffer.flags & V4L2_BUF_FLAG_TIMESTAMP_MASK;
  frame->stamped_by_driver = clock == V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC;
  frame->stamp_us = frame->stamped_by_driver ? to_us(buffer.timestamp) : monotonic_us();
  return (buffer.flags & V4L2_BUF_FLAG_ERROR) != 0 ? V4l2Status::kCorrupt : V4l2Status::kFrame;
}

void V4l2Camera::release() {
  if (held_ < 0) return;
  v4l2_buffer buffer = capture_buffer(held_);
  held_ = -1;
  // A failure means the end of the stream, which the next take() reports.
  (void)call(fd_, VIDIOC_QBUF, &buffer);
}

/// When no frame waits, an error on the descriptor means the end of the stream.
bool V4l2Camera::has_hung_up() const {
  pollfd poll_fd{fd_, POLLIN, 0};
  if (::poll(&poll_fd, 1, 0) <= 0) return false;
  return (poll_fd.revents & (POLLERR | POLLHUP | POLLNVAL)) != 0;
}

V4l2Status V4l2Camera::lost(int error) {
  const bool gone = error == ENODEV || error == ENXIO;
  why_ = gone ? device_ + " was unplugged" : device_ + ": the stream died: " + std::strerror(error);
  return gone ? V4l2Status::kGone : V4l2Status::kFailed;
}

}  // namespace plumb
