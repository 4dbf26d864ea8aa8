#include "platform/udpm/reassembly.hpp"

#include <algorithm>
#include <cstring>

namespace plumb {
namespace {

using Message = Reassembly::Message;

bool contradicts(const Message& message, const UdpmPacket& fragment) {
  if (fragment.message_bytes != message.bytes || fragment.count != message.num_fragments)
    return true;
  const std::size_t k = fragment.number;
  const std::size_t end = fragment.offset + fragment.payload.size();
  const auto& extents = message.extents;
  // A neighbour that has not come yet checks the seam when it comes.
  if (k > 0 && !extents[k - 1].is_missing() && extents[k - 1].end != fragment.offset) return true;
  return k + 1 < message.num_fragments && !extents[k + 1].is_missing() &&
         extents[k + 1].begin != end;
}

void store(const UdpmPacket& fragment, Message* message) {
  if (!fragment.payload.empty()) {
    std::memcpy(message->buffer.data() + fragment.offset, fragment.payload.data(),
                fragment.payload.size());
  }
  const auto size = static_cast<std::uint32_t>(fragment.payload.size());
  message->extents[fragment.number] = {fragment.offset, fragment.offset + size};
  ++message->num_received;
}

}  // namespace

void Reassembly::reserve(std::size_t message_bytes) {
  if (message_bytes <= max_bytes_) return;
  max_bytes_ = message_bytes;
  max_fragments_ = message_bytes / kMinFragmentBytes + 2;
  for (Message& message : messages_) {
    if (message.is_open) give_up(&message, UdpmOutcome::kGivenUp);
    message.buffer.assign(message_bytes, 0);
    message.extents.assign(max_fragments_, {});
  }
}

Reassembly::Result Reassembly::add(const UdpmSource& source, const UdpmPacket& fragment,
                                   int channel) {
  Message* message = find(source, fragment.sequence);
  if (message == nullptr) {
    UdpmOutcome refusal = UdpmOutcome::kFragment;
    if (fragment.message_bytes > max_bytes_) refusal = UdpmOutcome::kTooLarge;
    if (fragment.count > max_fragments_) refusal = UdpmOutcome::kTooManyFragments;
    if (refusal != UdpmOutcome::kFragment) {
      refuse(source, fragment.sequence, refusal);
      return {refusal};
    }
    message = open(source, fragment, channel);
    if (message == nullptr) return {UdpmOutcome::kNoRoom};
  }
  // The same size and count imply that the number has a place, so look at them first.
  if (fragment.message_bytes == message->bytes && fragment.count == message->num_fragments &&
      !message->extents[fragment.number].is_missing()) {
    return {UdpmOutcome::kDuplicate};
  }
  if (contradicts(*message, fragment)) {
    give_up(message, UdpmOutcome::kInconsistent);
    return {UdpmOutcome::kInconsistent};
  }
  store(fragment, message);
  if (fragment.number == 0) message->channel = channel;
  if (message->num_received < message->num_fragments) return {};
  close(message, UdpmOutcome::kDuplicate);
  give_up_older(source, fragment.sequence);
  return {UdpmOutcome::kMessage, message};
}

UdpmOutcome Reassembly::closed_outcome(const UdpmSource& source, std::uint32_t sequence) const {
  for (const Closed& closed : closed_) {
    if (closed.outcome != UdpmOutcome::kFragment && closed.sequence == sequence &&
        closed.source == source)
      return closed.outcome;
  }
  return UdpmOutcome::kFragment;
}

void Reassembly::refuse(const UdpmSource& source, std::uint32_t sequence, UdpmOutcome outcome) {
  if (Message* message = find(source, sequence)) message->is_open = false;
  closed_[next_closed_] = {source, sequence, outcome};
  next_closed_ = (next_closed_ + 1) % kNumClosed;
}

Message* Reassembly::find(const UdpmSource& source, std::uint32_t sequence) {
  for (Message& message : messages_) {
    if (message.is_open && message.sequence == sequence && message.source == source)
      return &message;
  }
  return nullptr;
}

Message* Reassembly::open(const UdpmSource& source, const UdpmPacket& fragment, int channel) {
  Message* message = place_for(channel);
  if (message == nullptr) return nullptr;
  if (message->is_open) give_up(message, UdpmOutcome::kGivenUp);
  message->is_open = true;
  message->source = source;
  message->sequence = fragment.sequence;
  message->channel = channel;
  message->bytes = fragment.message_bytes;
  message->num_fragments = fragment.count;
  message->num_received = 0;
  message->opened = num_opened_++;
  std::fill_n(message->extents.begin(), fragment.count, Message::Extent{});
  return message;
}

/// A free place, else the oldest message without a channel, else the oldest one.
Message* Reassembly::place_for(int channel) {
  const auto rank = [](const Message& message) {
    return !message.is_open ? 0 : message.channel == kNoChannel ? 1 : 2;
  };
  const auto best =
      std::min_element(messages_.begin(), messages_.end(), [&](const Message& a, const Message& b) {
        return rank(a) != rank(b) ? rank(a) < rank(b) : a.opened < b.opened;
      });
  if (best == messages_.end() || (channel == kNoChannel && rank(*best) == 2)) return nullptr;
  return &*best;
}

void Reassembly::close(Message* message, UdpmOutcome later) {
  refuse(message->source, message->sequence, later);
}

void Reassembly::give_up(Message* message, UdpmOutcome later) {
  ++num_given_up_;
  close(message, later);
}

/// Senders finish a message before they begin the next one, so what is open of an older message
/// will not be completed.
void Reassembly::give_up_older(const UdpmSource& source, std::uint32_t sequence) {
  for (Message& message : messages_) {
    const auto ahead = static_cast<std::int32_t>(sequence - message.sequence);
    if (message.is_open && message.source == source && ahead > 0)
      give_up(&message, UdpmOutcome::kGivenUp);
  }
}

}  // namespace plumb
