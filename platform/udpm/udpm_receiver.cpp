#include "platform/udpm/udpm_receiver.hpp"

#include <netinet/in.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string>

#include "platform/clock.hpp"

namespace plumb {
namespace {

constexpr std::size_t kPacketBytes = 65'536;  // more than any datagram has

int receive_socket() {
  const int fd = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (fd < 0) throw UdpmError(std::string("cannot open a UDP socket: ") + std::strerror(errno));
  return fd;
}

void set_option(int fd, int level, int option, int value, const char* what) {
  if (::setsockopt(fd, level, option, &value, sizeof value) != 0)
    throw UdpmError(std::string("cannot set ") + what + ": " + std::strerror(errno));
}

int booked_buffer(int fd) {
  int booked = 0;
  socklen_t bytes = sizeof booked;
  return ::getsockopt(fd, SOL_SOCKET, SO_RCVBUF, &booked, &bytes) == 0 ? booked / 2 : 0;
}

}  // namespace

UdpmReceiver::UdpmReceiver(const UdpmUrl& url, std::size_t num_in_reassembly)
    : socket_(receive_socket()),
      ready_(socket_.get()),
      inbox_(num_in_reassembly),
      sources_(url.sources),
      packet_(kPacketBytes),
      arrival_(monotonic_us()) {
  join(url);
}

void UdpmReceiver::join(const UdpmUrl& url) {
  const int fd = socket_.get();
  set_option(fd, SOL_SOCKET, SO_REUSEADDR, 1, "SO_REUSEADDR");
  set_option(fd, SOL_SOCKET, SO_RXQ_OVFL, 1, "SO_RXQ_OVFL");
  set_option(fd, SOL_SOCKET, SO_TIMESTAMPNS, 1, "SO_TIMESTAMPNS");
  grow_receive_buffer(url.receive_buffer_bytes);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(url.group);
  address.sin_port = htons(url.port);
  if (::bind(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
    throw UdpmError("cannot receive on UDP port " + std::to_string(url.port) + ": " +
                    std::strerror(errno));
  ip_mreqn group{};
  group.imr_multiaddr.s_addr = htonl(url.group);
  if (::setsockopt(fd, IPPROTO_IP, IP_ADD_MEMBERSHIP, &group, sizeof group) != 0)
    throw UdpmError(std::string("cannot join the LCM multicast group: ") + std::strerror(errno));
}

void UdpmReceiver::grow_receive_buffer(int wanted_bytes) {
  const int fd = socket_.get();
  if (wanted_bytes > 0) {
    (void)::setsockopt(fd, SOL_SOCKET, SO_RCVBUF, &wanted_bytes, sizeof wanted_bytes);
    // Beyond net.core.rmem_max, which only an administrator may exceed.
    if (booked_buffer(fd) < wanted_bytes)
      (void)::setsockopt(fd, SOL_SOCKET, SO_RCVBUFFORCE, &wanted_bytes, sizeof wanted_bytes);
  }
  receive_buffer_bytes_ = booked_buffer(fd);
}

void UdpmReceiver::unsubscribe(int subscription) {
  inbox_.unsubscribe(subscription);
  ready_.raise(!inbox_.is_empty());
}

MessageQueues::View UdpmReceiver::take() {
  inbox_.release();
  drain();
  const MessageQueues::View message = inbox_.pop();
  ready_.raise(!inbox_.is_empty());
  return message;
}

void UdpmReceiver::drain() {
  for (int i = 0; i < kMaxPacketsPerTake && !inbox_.is_full(); ++i)
    if (!receive_one()) return;
}

bool UdpmReceiver::receive_one() {
  sockaddr_in from{};
  iovec part{packet_.data(), packet_.size()};
  alignas(cmsghdr) std::array<char, 128> control{};
  msghdr message{};
  message.msg_name = &from;
  message.msg_namelen = sizeof from;
  message.msg_iov = &part;
  message.msg_iovlen = 1;
  message.msg_control = control.data();
  message.msg_controllen = control.size();
  const std::int64_t asked_us = monotonic_us();
  const ssize_t size = ::recvmsg(socket_.get(), &message, 0);
  if (size < 0) {
    if (errno == EAGAIN) arrival_.note_empty(asked_us);
    if (errno != EAGAIN && errno != EINTR) ++num_errors_;
    return false;
  }
  const std::int64_t now_us = monotonic_us();
  const std::int64_t arrival_us = read_control(&message, now_us);
  const UdpmSource source{ntohl(from.sin_addr.s_addr), ntohs(from.sin_port)};
  if (!is_heard(source.address, now_us)) {
    inbox_.count_refused(UdpmOutcome::kForeignSource);
    return true;
  }
  inbox_.take_packet(source, {packet_.data(), static_cast<std::size_t>(size)}, arrival_us);
  return true;
}

/// Reads the kernel's notes about a packet. Returns the time of arrival on the monotonic clock.
std::int64_t UdpmReceiver::read_control(msghdr* message, std::int64_t now_us) {
  std::int64_t arrival_us = now_us;
  for (cmsghdr* note = CMSG_FIRSTHDR(message); note != nullptr; note = CMSG_NXTHDR(message, note)) {
    if (note->cmsg_level != SOL_SOCKET) continue;
    if (note->cmsg_type == SO_RXQ_OVFL) {
      std::uint32_t drops = 0;
      std::memcpy(&drops, CMSG_DATA(note), sizeof drops);
      num_overflowed_ += static_cast<std::uint32_t>(drops - kernel_drops_);  // it may wrap
      kernel_drops_ = drops;
    } else if (note->cmsg_type == SO_TIMESTAMPNS) {
      timespec stamp{};
      std::memcpy(&stamp, CMSG_DATA(note), sizeof stamp);
      const std::int64_t stamp_us =
          static_cast<std::int64_t>(stamp.tv_sec) * 1'000'000 + stamp.tv_nsec / 1'000;
      arrival_us = arrival_.of(stamp_us, now_us, realtime_us());
    }
  }
  return arrival_us;
}

bool UdpmReceiver::is_heard(std::uint32_t address, std::int64_t now_us) {
  return std::find(sources_.begin(), sources_.end(), address) != sources_.end() ||
         local_.contains(address, now_us);
}

}  // namespace plumb
