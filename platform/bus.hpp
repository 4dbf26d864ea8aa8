/// An LCM connection and typed endpoints that own their buffers.
///
/// Threads:
///   All classes belong to the thread that calls Bus::handle(); handlers run in it. liblcm receives
///   in a thread of its own.
/// Memory:
///   A Subscriber decodes into a member, and a Publisher encodes into storage that it allocated at
///   construction. liblcm's receive thread does allocate: two blocks for every message above 65,499
///   bytes (each camera image), which it frees after dispatch. Our promise of no allocation covers
///   our libraries and our loop, not liblcm.
/// Order:
///   Messages are handled in the order of their arrival.
///   A queue that overflows shows as a gap in seq.
/// Errors:
///   Constructors throw BusError when the network cannot be joined. Later failures are counted in
///   Counters, and an exception that a handler throws is logged and counted as a rejection.
#pragma once

#include <lcm/lcm.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/channels.hpp"
#include "core/counters.hpp"
#include "platform/bounded_decode.hpp"

namespace plumb {

/// The exception for an LCM network that cannot be joined. Programs print it and stop.
class BusError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class RawSubscriber;

/// One LCM connection.
class Bus {
 public:
  /// [bytes] Receive buffer that is requested from the kernel. It holds 17 grey KITTI frames, which
  /// is a third of a second at five times real time.
  static constexpr int kReceiveBufferBytes = 8 << 20;

  /// Joins the network `url`. An empty `url` means $LCM_DEFAULT_URL or, when that is not set,
  /// multicast that stays on this machine. `counters` outlives the bus. Throws BusError.
  Bus(const std::string& url, Counters* counters);
  ~Bus();
  Bus(const Bus&) = delete;
  Bus& operator=(const Bus&) = delete;

  /// A descriptor that is readable while a message waits.
  /// Throws BusError when the network cannot be joined.
  [[nodiscard]] int fileno();
  /// Dispatches at most one message and waits up to `timeout_ms` for it. Returns true when there
  /// was one. `busy_since_us` (EventLoop::busy_since_us) is the earliest time at which the message
  /// can have arrived; it bounds the arrival time that liblcm reports.
  bool handle(int timeout_ms = 0, std::int64_t busy_since_us = 0);

  /// [bytes] Receive buffer that the kernel granted: half of SO_RCVBUF, because the kernel accounts
  /// its own overhead in the other half. It is 0 before the first
  /// subscription and without a socket.
  [[nodiscard]] int receive_buffer_bytes() const { return receive_buffer_bytes_; }
  [[nodiscard]] const std::string& url() const { return url_; }
  [[nodiscard]] Counters& counters() { return *counters_; }
  [[nodiscard]] lcm_t* lcm() { return lcm_; }
  [[nodiscard]] const std::vector<const RawSubscriber*>& subscribers() const {
    return subscribers_;
  }

 private:
  friend class RawSubscriber;
  void grow_receive_buffer();

  std::string url_;
  Counters* counters_;
  lcm_t* lcm_ = nullptr;
  int receive_buffer_bytes_ = 0;
  std::int64_t busy_since_us_ = 0;
  std::vector<const RawSubscriber*> subscribers_;
};

/// Whether the health message reports a channel on which nothing arrives (kPeriodic) or not.
enum class Input : std::uint8_t { kPeriodic, kOccasional };

/// Passes the bytes of every message of one channel to a handler.
class RawSubscriber {
 public:
  using Bytes = std::span<const std::uint8_t>;
  /// Returns null when it accepts the message, and else the reason as a string literal.
  using Handler = std::function<const char*(Bytes)>;
  static constexpr int kQueueMessages = 64;

  /// Subscribes to `channel`. `bus` and `channel` outlive the subscriber. Throws BusError.
  RawSubscriber(Bus& bus, const Channel& channel, Input input, Handler handler);
  ~RawSubscriber();
  RawSubscriber(const RawSubscriber&) = delete;
  RawSubscriber& operator=(const RawSubscriber&) = delete;

  [[nodiscard]] const Channel& channel() const { return channel_; }
  [[nodiscard]] Input input() const { return input_; }
  /// [us] Monotonic time of the newest message; 0 before the first.
  [[nodiscard]] std::int64_t last_us() const { return last_us_; }

 private:
  static void on_message(const lcm_recv_buf_t* raw, const char* channel, void* self);
  void dispatch(const lcm_recv_buf_t& raw);
  [[nodiscard]] std::int64_t waited_us(const lcm_recv_buf_t& raw) const;

  Bus& bus_;
  const Channel& channel_;
  Input input_;
  Handler handler_;
  lcm_subscription_t* subscription_ = nullptr;
  std::int64_t last_us_ = 0;
};

/// Decodes every message of one channel into a member and passes it to a handler. A message that
/// does not decode is rejected.
template <typename Message>
class Subscriber {
 public:
  using Handler = std::function<const char*(const Message&)>;

  Subscriber(Bus& bus, const Channel& channel, Input input, Handler handler)
      : handler_(std::move(handler)),
        raw_(bus, channel, input, [this](RawSubscriber::Bytes bytes) -> const char* {
          if (!decode_bounded(bytes, &message_)) return "does not decode";
          return handler_(message_);
        }) {}
  [[nodiscard]] std::int64_t last_us() const { return raw_.last_us(); }

 private:
  Handler handler_;
  Message message_{};
  RawSubscriber raw_;
};

/// Encodes messages into its own storage and publishes them. It counts the messages that were sent
/// and those that were not.
template <typename Message>
class Publisher {
 public:
  /// `max_bytes` is the largest encoding. The default suits every message of fixed size.
  Publisher(Bus& bus, const Channel& channel, std::size_t max_bytes = sizeof(Message) + 8)
      : Publisher(bus, channel, max_bytes, &bus.counters()) {}
  Publisher(Bus& bus, const Channel& channel, std::size_t max_bytes, Counters* counters)
      : bus_(bus), channel_(channel), counters_(counters), buffer_(max_bytes) {}

  /// Encodes the message into this publisher's storage. The result is empty when it does not fit,
  /// and is valid until the next call.
  [[nodiscard]] std::span<const std::uint8_t> encode(const Message& message) {
    const int bytes = message.encode(buffer_.data(), 0, static_cast<int>(buffer_.size()));
    return {buffer_.data(), bytes < 0 ? 0U : static_cast<std::size_t>(bytes)};
  }

  /// Publishes the message. Returns false when it does not fit or the socket refuses it.
  bool publish(const Message& message) {
    const auto bytes = encode(message);
    const bool sent = !bytes.empty() && lcm_publish(bus_.lcm(), channel_.name, bytes.data(),
                                                    static_cast<unsigned>(bytes.size())) == 0;
    ++(sent ? counters_->num_published : counters_->num_unsent);
    return sent;
  }

 private:
  Bus& bus_;
  const Channel& channel_;
  Counters* counters_ = nullptr;
  std::vector<std::uint8_t> buffer_;
};

}  // namespace plumb
