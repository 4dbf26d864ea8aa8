/// A connection to an LCM network and typed endpoints, in memory that is fixed.
///
/// Threads:
///   All classes belong to the thread that calls Bus::handle(); handlers run in it.
/// Memory:
///   A Subscriber takes slots for its messages and a decoded message at construction. A Publisher
///   encodes into storage that it took at construction. Nothing is allocated afterwards.
/// Order:
///   Messages are handled in the order of their arrival. A message for which the kernel had no room
///   shows as a gap in seq. A reader that wants only the newest message skips older ones, and one
///   that is behind may leave out messages that newer ones have overtaken.
/// Errors:
///   Constructors throw BusError when the network cannot be joined. Later failures are counted in
///   Counters, and an exception that a handler throws is logged and counted as a rejection.
#pragma once

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
#include "platform/max_encoded_bytes.hpp"
#include "platform/udpm/message_transport.hpp"

namespace plumb {

/// The exception for an LCM network that cannot be joined. Programs print it and stop.
class BusError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class RawSubscriber;

/// The URL of the network that a program uses: `asked`; when that is empty $LCM_DEFAULT_URL; when
/// that is not set multicast that stays on this machine.
[[nodiscard]] std::string lcm_url(const std::string& asked);

/// One LCM connection.
class Bus {
 public:
  /// [bytes] Receive buffer that is requested from the kernel. It holds 17 grey KITTI frames, which
  /// is a third of a second at five times real time.
  static constexpr int kReceiveBufferBytes = 8 << 20;

  /// Uses the network lcm_url(url), which the first subscription joins: udpm://... (udpm_url.hpp),
  /// or memq:// for messages within this object. `counters` outlives the bus. Throws BusError.
  Bus(const std::string& url, Counters* counters);
  ~Bus();
  Bus(const Bus&) = delete;
  Bus& operator=(const Bus&) = delete;

  /// A descriptor that is readable while a message waits.
  /// Throws BusError when the network cannot be joined.
  [[nodiscard]] int fileno();
  /// Dispatches at most one message and waits up to `timeout_ms` for it. Returns true when there
  /// was one.
  bool handle(int timeout_ms = 0);
  /// Publishes bytes. Returns false when the transport does not take them.
  bool publish(const Channel& channel, std::span<const std::uint8_t> bytes);

  /// [bytes] Receive buffer that the kernel granted: half of SO_RCVBUF, because the kernel accounts
  /// its own overhead in the other half. It is 0 before the first
  /// subscription and without a socket.
  [[nodiscard]] int receive_buffer_bytes() const { return transport_->receive_buffer_bytes(); }
  [[nodiscard]] const std::string& url() const { return url_; }
  [[nodiscard]] Counters& counters() { return *counters_; }
  [[nodiscard]] const MessageTransport& transport() const { return *transport_; }
  [[nodiscard]] const std::vector<RawSubscriber*>& subscribers() const { return subscribers_; }

 private:
  friend class RawSubscriber;
  int subscribe(const Subscription& wanted);
  [[nodiscard]] MessageQueues::View wait_for_message(int timeout_ms);
  void tell_refusals();

  std::string url_;
  Counters* counters_;
  std::unique_ptr<MessageTransport> transport_;
  std::int64_t num_refused_ = 0;
  UdpmOutcomeCounts outcomes_;
  std::int64_t num_overflowed_ = 0;
  std::vector<RawSubscriber*> subscribers_;
};

/// Whether the health message reports a channel on which nothing arrives (kPeriodic) or not.
enum class Input : std::uint8_t { kPeriodic, kOccasional };

/// The memory that a reader has for its messages.
struct MessageMemory {
  std::size_t max_bytes = 0;  ///< [bytes] of the largest message; larger ones are refused
  std::size_t num_slots = 0;  ///< messages held, the one being handled included
  Delivery delivery = Delivery::kEvery;
};

/// [bytes] The size of a grey image of 1920 x 1200 pixels as image_t. A reader of bytes that states
/// no size has room for messages of this size.
inline constexpr std::size_t kMaxImageBytes = 1920 * 1200 + 128;

/// Passes the bytes of the messages of one channel to a handler.
class RawSubscriber {
 public:
  using Bytes = std::span<const std::uint8_t>;
  /// Returns null when it accepts the message, and else the reason as a string literal.
  using Handler = std::function<const char*(Bytes)>;
  static constexpr int kQueueMessages = 16;  ///< slots of a reader of decoded messages
  static constexpr int kQueueImages = 3;     ///< slots of other readers; the kernel holds the rest

  /// Subscribes to `channel`, which has one reader per bus. `bus` and `channel` outlive the
  /// subscriber. Throws BusError.
  RawSubscriber(Bus& bus, const Channel& channel, Input input, Handler handler,
                const MessageMemory& memory = {kMaxImageBytes, kQueueImages});
  ~RawSubscriber();
  RawSubscriber(const RawSubscriber&) = delete;
  RawSubscriber& operator=(const RawSubscriber&) = delete;

  [[nodiscard]] const Channel& channel() const { return channel_; }
  [[nodiscard]] Input input() const { return input_; }
  /// [us] Monotonic time of the newest message; 0 before the first.
  [[nodiscard]] std::int64_t last_us() const { return last_us_; }
  /// [us] Monotonic time of the newest message that was accepted and not skipped; 0 before it.
  [[nodiscard]] std::int64_t accepted_us() const { return accepted_us_; }
  /// [us] Monotonic time at which the newest message reached this machine's socket.
  [[nodiscard]] std::int64_t arrival_us() const { return arrival_us_; }
  /// Messages that a newer one replaced before they were handled (Delivery::kLatest).
  [[nodiscard]] std::int64_t num_skipped() const;

  // For the handler, about the message that it handles:

  /// Has it waited for more than `limit_us` while a newer one of its channel waits? The wait counts
  /// from its arrival on this machine, and not before the time `ready_us`. The slots tell what
  /// waits; they are filled from the socket before each message.
  [[nodiscard]] bool is_overtaken(std::int64_t limit_us, std::int64_t ready_us = 0) const;
  /// It is left out because a newer one waits: counts it as skipped and never as late.
  void skip();
  /// [us] What it shows was captured at this monotonic time, 0 when that is not known. A message is
  /// late by its capture, or by its arrival when the capture is not known.
  void set_capture_us(std::int64_t capture_us) { capture_us_ = capture_us; }

 private:
  friend class Bus;
  void dispatch(const MessageQueues::View& message);
  void take(const MessageQueues::View& message);
  [[nodiscard]] bool is_late(std::int64_t now_us) const;

  Bus& bus_;
  const Channel& channel_;
  Input input_;
  Handler handler_;
  int subscription_ = MessageQueues::kNone;
  std::int64_t last_us_ = 0;
  std::int64_t accepted_us_ = 0;
  std::int64_t arrival_us_ = 0;
  std::int64_t capture_us_ = 0;
  bool is_skipped_ = false;
};

/// Decodes every message of one channel into a member and passes it to a handler. A message that
/// does not decode is rejected.
template <typename Message>
class Subscriber {
 public:
  using Handler = std::function<const char*(const Message&)>;

  Subscriber(Bus& bus, const Channel& channel, Input input, Handler handler)
      : handler_(std::move(handler)),
        raw_(bus, channel, input,
             [this](RawSubscriber::Bytes bytes) -> const char* {
               if (!decode_bounded(bytes, &message_)) return "does not decode";
               if constexpr (requires { message_.capture_mono_us; })
                 raw_.set_capture_us(message_.capture_mono_us);
               return handler_(message_);
             },
             {max_encoded_bytes(&message_), RawSubscriber::kQueueMessages}) {}
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
  /// Makes room for the largest encoding of a message that has a limit (max_encoded_bytes).
  Publisher(Bus& bus, const Channel& channel)
      : Publisher(bus, channel, max_encoded_bytes(static_cast<const Message*>(nullptr))) {}
  /// `max_bytes` is the largest encoding.
  Publisher(Bus& bus, const Channel& channel, std::size_t max_bytes)
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
    const bool sent = !bytes.empty() && bus_.publish(channel_, bytes);
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
