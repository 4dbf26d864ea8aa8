#include "platform/can_reader.hpp"

#include <linux/can.h>
#include <linux/can/raw.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "platform/socket_can.hpp"

namespace plumb {

CanReader::CanReader(std::string interface, std::uint32_t id, bool extended)
    : CanReader(std::move(interface), id, extended, &SocketCan::open_raw) {}

CanReader::CanReader(std::string interface, std::uint32_t id, bool extended, Opener opener)
    : interface_(std::move(interface)),
      id_(id),
      extended_(extended),
      opener_(opener),
      state_(interface_ + ": not open yet") {}

CanReader::~CanReader() {
  if (fd_ >= 0) ::close(fd_);
}

void CanReader::service(std::int64_t now_us) {
  if (fd_ >= 0 || now_us < next_open_us_) return;
  next_open_us_ = now_us + kReopenUs;
  std::string why;
  fd_ = opener_(interface_, &why);
  state_ = fd_ >= 0 ? "" : interface_ + ": " + why;
  if (fd_ < 0) return;
  // The kernel hands over this identifier alone; a socket that is no CAN socket has no filter.
  can_filter filter{};
  filter.can_id = extended_ ? id_ | CAN_EFF_FLAG : id_;
  filter.can_mask = (extended_ ? CAN_EFF_MASK : CAN_SFF_MASK) | CAN_EFF_FLAG | CAN_RTR_FLAG;
  (void)::setsockopt(fd_, SOL_CAN_RAW, CAN_RAW_FILTER, &filter, sizeof filter);
}

bool CanReader::read(CanFrame* frame) {
  if (fd_ < 0) return false;
  canfd_frame in{};
  ssize_t n = 0;
  // An error frame carries bits of its own where an identifier stands, and a request carries no
  // data.
  do {
    n = ::recv(fd_, &in, sizeof in, MSG_DONTWAIT);
  } while (n >= static_cast<ssize_t>(CAN_MTU) && (in.can_id & (CAN_ERR_FLAG | CAN_RTR_FLAG)) != 0);
  if (n < 0 && (errno == EAGAIN || errno == EINTR)) return false;
  if (n < static_cast<ssize_t>(CAN_MTU)) {
    go_down(n < 0 ? errno : ENETDOWN);
    return false;
  }
  *frame = {};
  frame->extended = (in.can_id & CAN_EFF_FLAG) != 0;
  frame->id = in.can_id & (frame->extended ? CAN_EFF_MASK : CAN_SFF_MASK);
  frame->fd = n == static_cast<ssize_t>(CANFD_MTU);
  frame->size = std::min<std::uint8_t>(in.len, frame->fd ? CANFD_MAX_DLEN : CAN_MAX_DLEN);
  std::copy_n(in.data, frame->size, frame->data.begin());
  return true;
}

void CanReader::go_down(int error_number) {
  state_ = interface_ + ": " + std::strerror(error_number);
  ::close(fd_);
  fd_ = -1;
}

}  // namespace plumb
