/// Puts messages together from their fragments, in memory that is fixed.
///
/// Rules:
///   A message belongs to a sender (address and port) and a sequence number. Its fragments may come
///   in any order. They have to agree on the message's size and number of fragments, and to tile
///   the message: fragment k + 1 begins where fragment k ends, the first begins at 0 and the last
///   ends with the message. So a complete message has no byte that was not received.
/// Limits:
///   A fixed number of messages is open at a time. When another one begins, the oldest is given up.
///   A message whose first fragment, which names the channel, has not come yet is given up before
///   all others and never displaces a message with a channel.
/// Memory:
///   All buffers are taken and written to in reserve(). Nothing is allocated afterwards.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "platform/udpm/udpm_packet.hpp"

namespace plumb {

/// Who sent a datagram, in host byte order.
struct UdpmSource {
  std::uint32_t address = 0;
  std::uint16_t port = 0;
  bool operator==(const UdpmSource&) const = default;
};

class Reassembly {
 public:
  static constexpr int kNoChannel = -1;
  /// [bytes] Senders cut messages into fragments of at least about this size.
  static constexpr std::size_t kMinFragmentBytes = 1024;
  /// Messages that are done with and whose late fragments are recognised.
  static constexpr std::size_t kNumClosed = 64;

  /// A message being put together.
  struct Message {
    bool is_open = false;
    UdpmSource source;
    std::uint32_t sequence = 0;
    int channel = kNoChannel;  ///< the caller's number, known once fragment 0 came
    std::uint32_t bytes = 0;
    std::uint16_t num_fragments = 0;
    std::uint16_t num_received = 0;
    std::uint64_t opened = 0;  ///< order of opening
    std::vector<std::uint8_t> buffer;
    /// Where each fragment lies; the end is below the begin while it is missing.
    struct Extent {
      std::uint32_t begin = 1;
      std::uint32_t end = 0;
      [[nodiscard]] bool is_missing() const { return end < begin; }
    };
    std::vector<Extent> extents;
  };

  struct Result {
    UdpmOutcome outcome = UdpmOutcome::kFragment;
    /// The message when it is complete. Its buffer may be swapped with one of the same size. It is
    /// valid until the next call.
    Message* complete = nullptr;
  };

  explicit Reassembly(std::size_t num_messages) : messages_(num_messages) {}

  /// Makes room for messages of `message_bytes` each. Gives up what is open when that is more than
  /// before.
  void reserve(std::size_t message_bytes);
  [[nodiscard]] std::size_t max_message_bytes() const { return max_bytes_; }

  /// Adds a parsed fragment. `channel` is the caller's number for its channel in fragment 0,
  /// kNoChannel in others.
  [[nodiscard]] Result add(const UdpmSource& source, const UdpmPacket& fragment, int channel);

  /// The outcome of a fragment whose message is done with: complete, given up or refused.
  /// kFragment when it is not.
  [[nodiscard]] UdpmOutcome closed_outcome(const UdpmSource& source, std::uint32_t sequence) const;
  /// Refuses this message: what is open of it is released, later fragments have this outcome.
  void refuse(const UdpmSource& source, std::uint32_t sequence, UdpmOutcome outcome);

  /// Messages that were begun and never completed.
  [[nodiscard]] std::int64_t num_given_up() const { return num_given_up_; }

 private:
  struct Closed {
    UdpmSource source;
    std::uint32_t sequence = 0;
    UdpmOutcome outcome = UdpmOutcome::kFragment;
  };
  Message* find(const UdpmSource& source, std::uint32_t sequence);
  Message* open(const UdpmSource& source, const UdpmPacket& fragment, int channel);
  Message* place_for(int channel);
  void close(Message* message, UdpmOutcome later);
  void give_up(Message* message, UdpmOutcome later);
  void give_up_older(const UdpmSource& source, std::uint32_t sequence);

  std::vector<Message> messages_;
  std::size_t max_bytes_ = 0;
  std::size_t max_fragments_ = 0;
  std::uint64_t num_opened_ = 0;
  std::int64_t num_given_up_ = 0;
  std::array<Closed, kNumClosed> closed_{};
  std::size_t next_closed_ = 0;
};

}  // namespace plumb
