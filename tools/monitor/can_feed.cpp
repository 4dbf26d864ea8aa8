#include "tools/monitor/can_feed.hpp"

#include <fcntl.h>
#include <linux/can.h>
#include <linux/can/raw.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include "platform/can_trace.hpp"
#include "platform/socket_can.hpp"

namespace plumb {
namespace {

/// Fills `frame` from what a raw CAN socket gave. Error frames and remote requests carry no values.
bool from_socket(const canfd_frame& raw, ssize_t bytes, CanFrame* frame) {
  if (bytes != CAN_MTU && bytes != CANFD_MTU) return false;
  if ((raw.can_id & (CAN_ERR_FLAG | CAN_RTR_FLAG)) != 0 || raw.len > frame->data.size())
    return false;
  frame->extended = (raw.can_id & CAN_EFF_FLAG) != 0;
  frame->id = raw.can_id & (frame->extended ? CAN_EFF_MASK : CAN_SFF_MASK);
  frame->fd = bytes == CANFD_MTU;
  frame->size = raw.len;
  std::copy_n(raw.data, raw.len, frame->data.begin());
  return true;
}

}  // namespace

CanFeed::CanFeed(std::string interface, std::string trace, Sink sink)
    : interface_(std::move(interface)), trace_(std::move(trace)), sink_(std::move(sink)) {
  line_.reserve(kMaxLineBytes);
  if (!wanted()) state_ = "the monitor was started without --interface and --trace";
}

CanFeed::~CanFeed() { close_descriptor(); }

void CanFeed::close_descriptor() {
  if (fd_ >= 0) ::close(fd_);
  fd_ = -1;
}

void CanFeed::poll(std::int64_t now_us) {
  if (!wanted()) return;
  if (fd_ < 0 && now_us >= next_open_us_) open(now_us);
  if (fd_ < 0) return;
  interface_.empty() ? read_trace() : read_interface();
}

void CanFeed::open(std::int64_t now_us) {
  next_open_us_ = now_us + kReopenUs;
  interface_.empty() ? open_trace() : open_interface();
  if (fd_ >= 0) state_.clear();
}

void CanFeed::open_interface() {
  std::string why;
  fd_ = SocketCan::open_raw(interface_, &why);
  const can_filter everything{0, 0};
  if (fd_ >= 0 &&
      ::setsockopt(fd_, SOL_CAN_RAW, CAN_RAW_FILTER, &everything, sizeof everything) != 0) {
    why = std::strerror(errno);
    close_descriptor();
  }
  if (fd_ < 0) state_ = interface_ + ": " + why;
}

void CanFeed::open_trace() {
  fd_ = ::open(trace_.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  struct stat now {};
  if (fd_ >= 0 && (::fstat(fd_, &now) != 0 || !S_ISREG(now.st_mode))) {
    close_descriptor();
    state_ = trace_ + " is not a file";
    return;
  }
  if (fd_ < 0) {
    state_ = trace_ + ": " + std::strerror(errno);
    was_open_ = true;  // what comes to exist later is read from its beginning
    return;
  }
  offset_ = was_open_ ? 0 : now.st_size;
  was_open_ = true;
  line_.clear();
  line_too_long_ = false;
}

bool CanFeed::is_replaced() const {
  struct stat mine {
  }, present{};
  if (::fstat(fd_, &mine) != 0 || ::stat(trace_.c_str(), &present) != 0) return true;
  return mine.st_ino != present.st_ino || mine.st_dev != present.st_dev || mine.st_size < offset_;
}

void CanFeed::read_trace() {
  std::array<char, 1 << 14> buffer;
  std::int64_t total = 0;
  while (total < kMaxBytesPerPoll) {
    const ssize_t got = ::pread(fd_, buffer.data(), buffer.size(), offset_);
    if (got <= 0) break;
    offset_ += got;
    total += got;
    take_characters(buffer.data(), static_cast<std::size_t>(got));
  }
  if (total == 0 && is_replaced()) close_descriptor();
}

void CanFeed::take_characters(const char* text, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    if (text[i] != '\n') {
      line_too_long_ = line_too_long_ || line_.size() >= kMaxLineBytes;
      if (!line_too_long_) line_ += text[i];
      continue;
    }
    std::int64_t time_us = 0;
    CanFrame frame;
    const bool readable = !line_too_long_ && read_trace_line(line_.c_str(), &time_us, &frame);
    if (readable) sink_(frame);
    if (!readable && (line_too_long_ || !line_.empty())) ++num_unreadable_;
    line_.clear();
    line_too_long_ = false;
  }
}

void CanFeed::read_interface() {
  constexpr int kMaxFramesPerPoll = 4096;
  for (int i = 0; i < kMaxFramesPerPoll; ++i) {
    canfd_frame raw{};
    const ssize_t got = ::recv(fd_, &raw, sizeof raw, MSG_DONTWAIT);
    if (got < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR)) return;
    if (got <= 0) {
      state_ = interface_ + ": " + std::strerror(errno);
      return close_descriptor();
    }
    CanFrame frame;
    if (from_socket(raw, got, &frame)) sink_(frame);
  }
}

}  // namespace plumb
