#include "platform/socket_can.hpp"

#include <linux/can.h>
#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace plumb {
namespace {

std::string reason(const char* what) { return std::string(what) + ": " + std::strerror(errno); }

/// Returns the index of an interface that is up; otherwise 0, and why.
int interface_index(int fd, const std::string& interface, std::string* why) {
  ifreq request{};
  if (interface.empty() || interface.size() >= sizeof request.ifr_name) {
    *why = "not the name of an interface";
    return 0;
  }
  std::memcpy(request.ifr_name, interface.c_str(), interface.size() + 1);
  if (::ioctl(fd, SIOCGIFFLAGS, &request) != 0) {
    *why = "no such interface";
    return 0;
  }
  if ((request.ifr_flags & IFF_UP) == 0) {
    *why = "the interface is down";
    return 0;
  }
  if (::ioctl(fd, SIOCGIFINDEX, &request) != 0) {
    *why = "no such interface";
    return 0;
  }
  return request.ifr_ifindex;
}

/// Receives error frames only; sends CAN FD frames where the interface can.
bool set_options(int fd, std::string* why) {
  const can_err_mask_t errors = CAN_ERR_MASK;
  const int on = 1;
  if (::setsockopt(fd, SOL_CAN_RAW, CAN_RAW_FILTER, nullptr, 0) != 0 ||
      ::setsockopt(fd, SOL_CAN_RAW, CAN_RAW_ERR_FILTER, &errors, sizeof errors) != 0 ||
      ::setsockopt(fd, SOL_CAN_RAW, CAN_RAW_FD_FRAMES, &on, sizeof on) != 0) {
    *why = reason("cannot set the socket's options");
    return false;
  }
  return true;
}

}  // namespace

int SocketCan::open_raw(const std::string& interface, std::string* why) {
  const int fd = ::socket(PF_CAN, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_RAW);
  if (fd < 0) {
    *why = errno == EAFNOSUPPORT || errno == EPROTONOSUPPORT ? "this kernel has no raw CAN sockets"
                                                             : reason("cannot open a CAN socket");
    return -1;
  }
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = interface_index(fd, interface, why);
  if (address.can_ifindex != 0 && set_options(fd, why)) {
    // Sockets take every kind of address as a sockaddr.
    if (::bind(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) return fd;
    *why = reason("cannot bind");
  }
  ::close(fd);
  return -1;
}

SocketCan::SocketCan(const std::string& interface, Opener opener)
    : interface_(interface), opener_(opener) {
  state_ = interface_ + ": not open yet";
}

SocketCan::~SocketCan() {
  if (fd_ >= 0) ::close(fd_);
}

void SocketCan::service(std::int64_t now_us) {
  if (fd_ < 0 && now_us >= next_open_us_) {
    std::string why;
    fd_ = opener_(interface_, &why);
    next_open_us_ = now_us + kReopenUs;
    state_ = fd_ >= 0 ? "" : interface_ + ": " + why;
    if (fd_ >= 0) ++counters_.num_opened;
  }
  if (fd_ >= 0) read_errors();
  retry(now_us);
}

void SocketCan::send(std::int64_t time_us, const CanFrame& frame) {
  if (fd_ < 0) {
    ++counters_.num_unsent;
    return;
  }
  // A new frame waits behind those that wait already: the order of a burst must stay.
  if (pending_.empty()) {
    const Result result = write(frame);
    if (result == Result::kDown) ++counters_.num_unsent;
    if (result != Result::kBusy) return;
  }
  if (!pending_.push({time_us, frame})) ++counters_.num_unsent;
}

void SocketCan::retry(std::int64_t now_us) {
  while (!pending_.empty()) {
    const Pending& oldest = pending_.front();
    const bool is_old = fd_ < 0 || now_us - oldest.time_us > kMaxPendingUs;
    const Result result = is_old ? Result::kDown : write(oldest.frame);
    if (result == Result::kBusy) return;
    if (result == Result::kSent) ++counters_.num_retried;
    if (result == Result::kDown) ++counters_.num_unsent;
    pending_.drop_front();
  }
}

SocketCan::Result SocketCan::write(const CanFrame& frame) {
  canfd_frame out{};
  out.can_id = frame.extended ? frame.id | CAN_EFF_FLAG : frame.id;
  out.len = frame.size;
  out.flags = frame.fd ? CANFD_BRS : 0;
  std::copy_n(frame.data.begin(), frame.size, out.data);
  // The size of the write tells the kernel which kind of frame it is; both begin alike.
  const std::size_t bytes = frame.fd ? CANFD_MTU : CAN_MTU;
  const ssize_t n = ::send(fd_, &out, bytes, MSG_DONTWAIT | MSG_NOSIGNAL);
  if (n == static_cast<ssize_t>(bytes)) {
    ++counters_.num_sent;
    return Result::kSent;
  }
  if (n < 0 && (errno == EAGAIN || errno == ENOBUFS || errno == EINTR)) return Result::kBusy;
  go_down(n < 0 ? errno : EIO);
  return Result::kDown;
}

void SocketCan::read_errors() {
  canfd_frame in{};
  ssize_t n = 0;
  while ((n = ::recv(fd_, &in, sizeof in, MSG_DONTWAIT)) >= static_cast<ssize_t>(CAN_MTU)) {
    if ((in.can_id & CAN_ERR_FLAG) == 0) continue;
    ++counters_.num_errors;
    if ((in.can_id & CAN_ERR_ACK) != 0) ++counters_.num_unacked;
    if ((in.can_id & CAN_ERR_BUSOFF) != 0) {
      ++counters_.num_bus_off;
      state_ = interface_ + ": bus-off; it stays so unless restart-ms is set";
    }
    if ((in.can_id & CAN_ERR_CRTL) != 0) {
      constexpr int kBad = CAN_ERR_CRTL_RX_PASSIVE | CAN_ERR_CRTL_TX_PASSIVE |
                           CAN_ERR_CRTL_RX_WARNING | CAN_ERR_CRTL_TX_WARNING;
      if ((in.data[1] & kBad) != 0) {
        ++counters_.num_passive;
        state_ = interface_ + ": the controller reports too many errors on the bus";
      }
      if ((in.data[1] & CAN_ERR_CRTL_ACTIVE) != 0) state_.clear();
    }
    if ((in.can_id & CAN_ERR_RESTARTED) != 0) state_.clear();
  }
  if (n == 0) go_down(ENETDOWN);
  if (n < 0 && errno != EAGAIN && errno != EINTR) go_down(errno);
}

void SocketCan::go_down(int error_number) {
  state_ = interface_ + ": " + std::strerror(error_number);
  ::close(fd_);
  fd_ = -1;
}

}  // namespace plumb
