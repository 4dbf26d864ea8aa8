#include "platform/udpm/udpm_sender.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <limits>
#include <string>

#include "platform/clock.hpp"
#include "platform/udpm/udpm_packet.hpp"

namespace plumb {
namespace {

constexpr int kSendBufferBytes = 4 << 20;  // an image of 1920 x 1080 pixels and then some

FileDescriptor send_socket(std::uint8_t ttl) {
  FileDescriptor fd(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  const int hops = ttl;
  const int loop = 1;
  const bool is_set =
      fd.get() >= 0 &&
      ::setsockopt(fd.get(), IPPROTO_IP, IP_MULTICAST_TTL, &hops, sizeof hops) == 0 &&
      ::setsockopt(fd.get(), IPPROTO_IP, IP_MULTICAST_LOOP, &loop, sizeof loop) == 0;
  if (!is_set) throw UdpmError(std::string("cannot open a UDP socket: ") + std::strerror(errno));
  // All fragments of an image wait here while the network card sends them. What the kernel grants
  // is enough on this machine, where nothing waits.
  (void)::setsockopt(fd.get(), SOL_SOCKET, SO_SNDBUF, &kSendBufferBytes, sizeof kSendBufferBytes);
  (void)::setsockopt(fd.get(), SOL_SOCKET, SO_SNDBUFFORCE, &kSendBufferBytes,
                     sizeof kSendBufferBytes);
  return fd;
}

/// Throws where there is no route to the group: better now than for each message.
void check_route(const UdpmUrl& url) {
  const FileDescriptor fd(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_addr.s_addr = htonl(url.group);
  to.sin_port = htons(url.port);
  if (::connect(fd.get(), reinterpret_cast<const sockaddr*>(&to), sizeof to) == 0) return;
  const std::string why = std::strerror(errno);
  std::array<char, INET_ADDRSTRLEN> group{};
  ::inet_ntop(AF_INET, &to.sin_addr, group.data(), group.size());
  throw UdpmError("cannot use LCM network udpm://" + std::string(group.data()) + ":" +
                  std::to_string(url.port) + ": " + why +
                  " (on one machine: ip link set lo multicast on; ip route add 224.0.0.0/4 dev "
                  "lo)");
}

// sendmsg() takes pointers to mutable bytes and only reads them.
iovec part_of(const void* data, std::size_t size) { return {const_cast<void*>(data), size}; }

/// @pre `channel` has at most kUdpmMaxChannelLength characters
std::array<char, kUdpmMaxChannelLength + 1> terminated(std::string_view channel) {
  std::array<char, kUdpmMaxChannelLength + 1> text{};
  std::copy(channel.begin(), channel.end(), text.begin());
  return text;
}

}  // namespace

UdpmSender::UdpmSender(const UdpmUrl& url)
    : socket_(send_socket(url.ttl)), group_(url.group), port_(url.port) {
  check_route(url);
}

bool UdpmSender::publish(std::string_view channel, Bytes payload) {
  const bool is_short = channel.size() + 1 + payload.size() <= kUdpmMaxShortBody;
  const bool sent =
      is_short ? publish_short(channel, payload) : publish_fragments(channel, payload);
  // A message that was sent in part must not share its number with the next one.
  ++sequence_;
  if (sent) ++num_sent_;
  return sent;
}

bool UdpmSender::publish_short(std::string_view channel, Bytes payload) {
  const auto header = udpm_short_header(sequence_);
  const auto name = terminated(channel);
  std::array<iovec, 3> parts{part_of(header.data(), header.size()),
                             part_of(name.data(), channel.size() + 1),
                             part_of(payload.data(), payload.size())};
  int wait_ms = 0;
  return send(parts, &wait_ms);
}

bool UdpmSender::publish_fragments(std::string_view channel, Bytes payload) {
  const std::size_t total = channel.size() + 1 + payload.size();
  const std::size_t count = (total + kUdpmMaxFragmentBody - 1) / kUdpmMaxFragmentBody;
  if (count > std::numeric_limits<std::uint16_t>::max()) {
    ++num_failed_;
    return false;
  }
  const auto name = terminated(channel);
  UdpmPacket fragment;
  fragment.sequence = sequence_;
  fragment.message_bytes = static_cast<std::uint32_t>(payload.size());
  fragment.count = static_cast<std::uint16_t>(count);
  int wait_ms = kMaxWait_ms;
  for (std::size_t offset = 0; fragment.number < count; ++fragment.number) {
    const std::size_t name_bytes = fragment.number == 0 ? channel.size() + 1 : 0;
    const std::size_t size = std::min(kUdpmMaxFragmentBody - name_bytes, payload.size() - offset);
    fragment.offset = static_cast<std::uint32_t>(offset);
    const auto header = udpm_fragment_header(fragment);
    std::array<iovec, 3> parts{part_of(header.data(), header.size()),
                               part_of(name.data(), name_bytes),
                               part_of(payload.data() + offset, size)};
    if (!send(parts, &wait_ms)) return false;
    offset += size;
  }
  return true;
}

bool UdpmSender::send(std::span<iovec> parts, int* wait_ms) {
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_addr.s_addr = htonl(group_);
  to.sin_port = htons(port_);
  msghdr message{};
  // The socket is not connected: that would fix the source address, which may change.
  message.msg_name = &to;
  message.msg_namelen = sizeof to;
  message.msg_iov = parts.data();
  message.msg_iovlen = parts.size();
  while (::sendmsg(socket_.get(), &message, MSG_NOSIGNAL) < 0) {
    if (errno == EINTR) continue;
    const bool is_congested = errno == EAGAIN || errno == ENOBUFS;
    if (errno != EAGAIN || *wait_ms <= 0) {
      ++(is_congested ? num_congested_ : num_failed_);
      return false;
    }
    const std::int64_t before_us = monotonic_us();
    pollfd room{socket_.get(), POLLOUT, 0};
    (void)::poll(&room, 1, *wait_ms);
    *wait_ms -= static_cast<int>((monotonic_us() - before_us) / 1'000) + 1;
  }
  return true;
}

}  // namespace plumb
