/// Publishes LCM messages on a UDP multicast network.
///
/// Packets are cut as liblcm cuts them. The payload is handed to the kernel where it lies.
///
/// Memory:
///   Nothing is allocated after construction.
/// Waiting:
///   A short message never waits. A fragmented one waits until the network has taken its fragments,
///   kMaxWait_ms at most in total.
/// Errors:
///   A message that the kernel did not take whole is counted as unsent. The constructor throws
///   UdpmError, also where there is no route to the group.
#pragma once

#include <sys/socket.h>
#include <sys/uio.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "platform/udpm/file_descriptor.hpp"
#include "platform/udpm/udpm_url.hpp"

namespace plumb {

class UdpmSender {
 public:
  static constexpr int kMaxWait_ms = 20;

  explicit UdpmSender(const UdpmUrl& url);

  /// False when the kernel did not take the message. Each call takes a sequence number.
  /// @pre `channel` is a channel's name (is_udpm_channel)
  bool publish(std::string_view channel, std::span<const std::uint8_t> payload);

  [[nodiscard]] std::int64_t num_sent() const { return num_sent_; }
  /// The kernel's buffers were full (EAGAIN, ENOBUFS).
  [[nodiscard]] std::int64_t num_congested() const { return num_congested_; }
  /// Anything else, e.g. no route, or a message that no sequence of fragments can hold.
  [[nodiscard]] std::int64_t num_failed() const { return num_failed_; }

 private:
  using Bytes = std::span<const std::uint8_t>;
  bool publish_short(std::string_view channel, Bytes payload);
  bool publish_fragments(std::string_view channel, Bytes payload);
  /// Sends one datagram made of `parts`. Waits up to `*wait_ms` for room and takes the time off it.
  bool send(std::span<iovec> parts, int* wait_ms);

  FileDescriptor socket_;
  std::uint32_t group_;  ///< host byte order
  std::uint16_t port_;
  std::uint32_t sequence_ = 0;
  std::int64_t num_sent_ = 0;
  std::int64_t num_congested_ = 0;
  std::int64_t num_failed_ = 0;
};

}  // namespace plumb
