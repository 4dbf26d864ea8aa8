/// Receives LCM messages from a UDP multicast network, in the thread that calls it.
///
/// Network:
///   The socket joins the group as liblcm does and shares its port, so that it hears the stock
///   tools. It is bound to the group's address instead of to all addresses: the kernel then keeps
///   unicast packets and those of other groups away from it. Packets are taken from senders on this
///   machine and from those that the URL names; liblcm takes them from everybody, whatever its ttl.
/// Memory:
///   All of it is taken in the constructor and in subscribe(). Nothing is allocated afterwards.
/// Errors:
///   Packets that break the protocol are counted by reason. The constructor throws UdpmError, and
///   std::system_error when the process has no descriptors left.
#pragma once

#include <sys/socket.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "platform/udpm/arrival_time.hpp"
#include "platform/udpm/file_descriptor.hpp"
#include "platform/udpm/local_addresses.hpp"
#include "platform/udpm/ready_signal.hpp"
#include "platform/udpm/udpm_inbox.hpp"
#include "platform/udpm/udpm_url.hpp"

namespace plumb {

class UdpmReceiver {
 public:
  /// Packets that one take() reads at most: a flood must not keep the caller from its other work.
  static constexpr int kMaxPacketsPerTake = 512;

  /// Joins. `num_in_reassembly` as UdpmInbox.
  explicit UdpmReceiver(const UdpmUrl& url,
                        std::size_t num_in_reassembly = UdpmInbox::kDefaultReassembly);

  /// As UdpmInbox.
  int subscribe(const Subscription& wanted) { return inbox_.subscribe(wanted); }
  void unsubscribe(int subscription);

  /// Readable when take() may give a message. It stays ours.
  [[nodiscard]] int fileno() const { return ready_.fileno(); }
  /// Reads what waits in the socket and gives the message that arrived first. Its `subscription` is
  /// MessageQueues::kNone when there is none. The message is valid until the next take(). Does not
  /// wait.
  [[nodiscard]] MessageQueues::View take();

  [[nodiscard]] const UdpmInbox& inbox() const { return inbox_; }
  /// [bytes] of messages that the kernel holds for us: half of SO_RCVBUF, whose other half is for
  /// its own overhead.
  [[nodiscard]] int receive_buffer_bytes() const { return receive_buffer_bytes_; }
  /// Packets that found the kernel's buffer full, as told by the newest packet.
  [[nodiscard]] std::int64_t num_overflowed() const { return num_overflowed_; }
  /// Calls of recvmsg() that failed.
  [[nodiscard]] std::int64_t num_errors() const { return num_errors_; }

 private:
  void join(const UdpmUrl& url);
  void grow_receive_buffer(int wanted_bytes);
  void drain();
  /// False when the socket is empty or fails.
  bool receive_one();
  [[nodiscard]] std::int64_t read_control(msghdr* message, std::int64_t now_us);
  [[nodiscard]] bool is_heard(std::uint32_t address, std::int64_t now_us);

  FileDescriptor socket_;
  ReadySignal ready_;
  UdpmInbox inbox_;
  std::vector<std::uint32_t> sources_;
  LocalAddresses local_;
  std::vector<std::uint8_t> packet_;
  ArrivalTime arrival_;
  int receive_buffer_bytes_ = 0;
  std::uint32_t kernel_drops_ = 0;
  std::int64_t num_overflowed_ = 0;
  std::int64_t num_errors_ = 0;
};

}  // namespace plumb
