/// Turns datagrams into messages for their readers. It is pure: it knows no socket and no clock.
///
/// Memory:
///   subscribe() takes all of it. take_packet() and pop() do not allocate.
/// Errors:
///   Packets may hold any bytes. What is wrong with one is its outcome, and outcomes are counted.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "platform/udpm/message_queues.hpp"
#include "platform/udpm/reassembly.hpp"
#include "platform/udpm/udpm_outcome.hpp"

namespace plumb {

class UdpmInbox {
 public:
  /// Messages that can be in reassembly at the same time.
  static constexpr std::size_t kDefaultReassembly = 4;

  explicit UdpmInbox(std::size_t num_in_reassembly = kDefaultReassembly)
      : reassembly_(num_in_reassembly) {}

  /// As MessageQueues::subscribe(); makes room for its messages in reassembly, too.
  int subscribe(const Subscription& wanted);
  void unsubscribe(int subscription) { queues_.unsubscribe(subscription); }

  /// @pre not is_full()
  UdpmOutcome take_packet(const UdpmSource& source, std::span<const std::uint8_t> bytes,
                          std::int64_t arrival_us);
  /// Counts a packet that the caller refused.
  void count_refused(UdpmOutcome outcome) { outcomes_.add(outcome); }

  [[nodiscard]] bool is_full() const { return queues_.is_full(); }
  [[nodiscard]] bool is_empty() const { return queues_.is_empty(); }
  [[nodiscard]] MessageQueues::View pop() { return queues_.pop(); }
  void release() { queues_.release(); }

  [[nodiscard]] const UdpmOutcomeCounts& outcomes() const { return outcomes_; }
  /// Fragmented messages that were begun and never completed.
  [[nodiscard]] std::int64_t num_given_up() const { return reassembly_.num_given_up(); }
  [[nodiscard]] std::int64_t num_skipped(int subscription) const {
    return queues_.num_skipped(subscription);
  }
  [[nodiscard]] std::size_t num_waiting(int subscription) const {
    return queues_.num_waiting(subscription);
  }

 private:
  UdpmOutcome take_short(const UdpmPacket& packet, std::int64_t arrival_us);
  UdpmOutcome take_fragment(const UdpmSource& source, const UdpmPacket& packet,
                            std::int64_t arrival_us);
  /// Refuses by the channel in fragment 0 and by the size. kFragment when neither is wrong.
  [[nodiscard]] UdpmOutcome judge_message(const UdpmPacket& fragment, int subscription) const;

  MessageQueues queues_;
  Reassembly reassembly_;
  UdpmOutcomeCounts outcomes_;
};

}  // namespace plumb
