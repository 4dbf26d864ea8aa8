/// LCM endpoints that own their buffers, so that the loop itself never allocates.
///
/// Memory   a Subscriber decodes into a member, a Publisher encodes into storage made at
/// construction. liblcm's
///          own receive thread does allocate: two blocks for every message above 65,499 bytes (each
///          camera image), freed after dispatch. The no-allocation promise covers our libraries and
///          our loop, not liblcm.
/// Order    every message is handled, in the order of arrival; a queue that overflows shows as a
/// gap in seq.
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

/// The LCM network cannot be joined. Programs print it and stop.
class BusError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class RawSubscriber;

/// One LCM connection.
class Bus {
 public:
  /// [bytes] asked of the kernel: 17 grey KITTI frames, a third of a second at five times real
  /// time.
  static constexpr int kReceiveBufferBytes = 8 << 20;

  /// An empty `url` means $LCM_DEFAULT_URL, else multicast that stays on this machine. Throws
  /// BusError.
  Bus(const std::string& url, Counters* counters);
  ~Bus();
  Bus(const Bus&) = delete;
  Bus& operator=(const Bus&) = delete;

  /// Readable when a message waits. Throws BusError when the network cannot be joined.
  [[nodiscard]] int fileno();
  /// Dispatches at most one message, waiting up to `timeout_ms` for it. True when there was one. The message cannot
  /// have waited since before `busy_since_us` (EventLoop), which bounds what liblcm says about its arrival.
  bool handle(int timeout_ms = 0, std::int64_t busy_since_us = 0);

  /// [bytes] of queued messages the kernel granted (half of SO_RCVBUF: the kernel books its own
  /// overhead in the other half); 0 before the first subscription and where there is no socket.
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

/// Is silence on a channel worth a word in the health message?
enum class Input : std::uint8_t { kPeriodic, kOccasional };

/// Hands the bytes of every message of one channel to a handler.
class RawSubscriber {
 public:
  using Bytes = std::span<const std::uint8_t>;
  /// Null when the message was taken, else why it was refused, as a literal.
  using Handler = std::function<const char*(Bytes)>;
  static constexpr int kQueueMessages = 64;

  /// Throws BusError.
  RawSubscriber(Bus& bus, const Channel& channel, Input input, Handler handler);
  ~RawSubscriber();
  RawSubscriber(const RawSubscriber&) = delete;
  RawSubscriber& operator=(const RawSubscriber&) = delete;

  [[nodiscard]] const Channel& channel() const { return channel_; }
  [[nodiscard]] Input input() const { return input_; }
  /// [us] monotonic time of the newest message; 0 before the first.
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

/// Decodes every message of one channel into a member and hands it on. What does not decode is
/// rejected.
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

/// Encodes into owned storage and publishes the bytes; counts what was sent and what was not.
template <typename Message>
class Publisher {
 public:
  /// A message of fixed size needs no `max_bytes`; a variable one states its largest encoding.
  Publisher(Bus& bus, const Channel& channel, std::size_t max_bytes = sizeof(Message) + 8)
      : Publisher(bus, channel, max_bytes, &bus.counters()) {}
  Publisher(Bus& bus, const Channel& channel, std::size_t max_bytes, Counters* counters)
      : bus_(bus), channel_(channel), counters_(counters), buffer_(max_bytes) {}

  /// The message as bytes, in this publisher's storage; empty when it does not fit.
  [[nodiscard]] std::span<const std::uint8_t> encode(const Message& message) {
    const int bytes = message.encode(buffer_.data(), 0, static_cast<int>(buffer_.size()));
    return {buffer_.data(), bytes < 0 ? 0U : static_cast<std::size_t>(bytes)};
  }

  /// False when the message does not fit or the socket refuses it.
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
