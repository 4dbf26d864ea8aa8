/// Received messages that wait for their readers, in memory that is fixed.
///
/// Order:
///   pop() gives the messages of all channels in the order of their arrival.
/// Delivery:
///   kEvery gives every message. When the slots of such a channel are taken, is_full() asks the
///   caller to stop reading, so that further messages wait in the kernel.
///   kLatest gives the newest message. It replaces an older one that waits, which then counts as
///   skipped.
/// Memory:
///   subscribe() takes the slots and writes to them. Nothing is allocated afterwards.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace plumb {

enum class Delivery : std::uint8_t { kEvery, kLatest };

/// What a reader wants to receive.
struct Subscription {
  std::string channel;
  std::size_t max_bytes = 0;  ///< [bytes] of its largest message
  std::size_t num_slots = 2;  ///< messages held, the one being handled included; kLatest has 2
  Delivery delivery = Delivery::kEvery;
};

class MessageQueues {
 public:
  static constexpr int kNone = -1;

  /// One message. It is valid until the next pop() or release().
  struct View {
    int subscription = kNone;
    std::span<const std::uint8_t> bytes;
    std::int64_t arrival_us = 0;  ///< [us] monotonic
  };

  /// Returns the subscription's number. Throws std::invalid_argument for a name that is no channel
  /// or is subscribed already, and for sizes of 0.
  int subscribe(const Subscription& wanted);
  /// Releases the slots. The number is not used again.
  void unsubscribe(int subscription);

  /// The subscription of `channel`, or kNone.
  [[nodiscard]] int find(std::string_view channel) const;
  [[nodiscard]] bool is_unsubscribed(int subscription) const {
    return at(subscription).channel.empty();
  }
  /// @pre `subscription` is subscribed, for the five below
  [[nodiscard]] std::size_t max_bytes(int subscription) const { return at(subscription).max_bytes; }
  /// Messages that were replaced by newer ones before they were read.
  [[nodiscard]] std::int64_t num_skipped(int subscription) const {
    return at(subscription).num_skipped;
  }
  /// Messages of a channel that wait, without the one being handled.
  [[nodiscard]] std::size_t num_waiting(int subscription) const {
    return at(subscription).size - (subscription == popped_ ? 1 : 0);
  }
  /// Copies a message into a slot. @pre not is_full(), bytes.size() <= max_bytes(subscription)
  void push(int subscription, std::span<const std::uint8_t> bytes, std::int64_t arrival_us);
  /// As push(), for the first `size` bytes of `buffer`. A buffer of exactly max_bytes() is swapped
  /// with the slot's instead of being copied.
  void push_buffer(int subscription, std::vector<std::uint8_t>* buffer, std::size_t size,
                   std::int64_t arrival_us);

  /// Has a kEvery channel no free slot?
  [[nodiscard]] bool is_full() const;
  [[nodiscard]] bool is_full(int subscription) const;
  /// Does no message wait? The one being handled does not count.
  [[nodiscard]] bool is_empty() const { return num_waiting_ == 0; }
  /// Releases the message that was popped last and gives the next one. Its `subscription` is kNone
  /// when no message waits.
  [[nodiscard]] View pop();
  /// Releases the message that was popped last.
  void release();

 private:
  struct Slot {
    std::vector<std::uint8_t> buffer;
    std::size_t size = 0;
    std::int64_t arrival_us = 0;
    std::uint64_t order = 0;
  };
  struct Queue {
    std::string channel;  ///< empty: unsubscribed
    std::size_t max_bytes = 0;
    Delivery delivery = Delivery::kEvery;
    std::vector<Slot> slots;
    std::size_t first = 0;
    std::size_t size = 0;  ///< the slot being handled included
    std::int64_t num_skipped = 0;
  };
  [[nodiscard]] const Queue& at(int subscription) const {
    return queues_[static_cast<std::size_t>(subscription)];
  }
  [[nodiscard]] Queue& at(int subscription) {
    return queues_[static_cast<std::size_t>(subscription)];
  }
  Slot& next_slot(int subscription, std::int64_t arrival_us);

  std::vector<Queue> queues_;
  std::uint64_t num_pushed_ = 0;
  std::size_t num_waiting_ = 0;
  int popped_ = kNone;  ///< whose first slot is being handled
};

}  // namespace plumb
