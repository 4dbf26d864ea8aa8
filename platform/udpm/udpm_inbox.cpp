#include "platform/udpm/udpm_inbox.hpp"

namespace plumb {

static_assert(MessageQueues::kNone == Reassembly::kNoChannel);

int UdpmInbox::subscribe(const Subscription& wanted) {
  const int subscription = queues_.subscribe(wanted);
  reassembly_.reserve(wanted.max_bytes);
  return subscription;
}

UdpmOutcome UdpmInbox::take_packet(const UdpmSource& source, std::span<const std::uint8_t> bytes,
                                   std::int64_t arrival_us) {
  UdpmPacket packet;
  UdpmOutcome outcome = parse_udpm_packet(bytes, &packet);
  if (outcome == UdpmOutcome::kMessage) outcome = take_short(packet, arrival_us);
  if (outcome == UdpmOutcome::kFragment) outcome = take_fragment(source, packet, arrival_us);
  outcomes_.add(outcome);
  return outcome;
}

UdpmOutcome UdpmInbox::take_short(const UdpmPacket& packet, std::int64_t arrival_us) {
  const int subscription = queues_.find(packet.channel);
  if (subscription == MessageQueues::kNone) return UdpmOutcome::kUnsubscribed;
  if (packet.payload.size() > queues_.max_bytes(subscription)) return UdpmOutcome::kTooLarge;
  queues_.push(subscription, packet.payload, arrival_us);
  return UdpmOutcome::kMessage;
}

UdpmOutcome UdpmInbox::take_fragment(const UdpmSource& source, const UdpmPacket& packet,
                                     std::int64_t arrival_us) {
  const UdpmOutcome closed = reassembly_.closed_outcome(source, packet.sequence);
  if (closed != UdpmOutcome::kFragment) return closed;
  const int subscription = queues_.find(packet.channel);
  const UdpmOutcome judged = judge_message(packet, subscription);
  if (judged != UdpmOutcome::kFragment) {
    reassembly_.refuse(source, packet.sequence, judged);
    return judged;
  }
  const Reassembly::Result added = reassembly_.add(source, packet, subscription);
  if (added.complete == nullptr) return added.outcome;
  Reassembly::Message& message = *added.complete;
  // The reader may have left since the first fragment.
  if (queues_.is_unsubscribed(message.channel)) return UdpmOutcome::kUnsubscribed;
  queues_.push_buffer(message.channel, &message.buffer, message.bytes, arrival_us);
  return UdpmOutcome::kMessage;
}

UdpmOutcome UdpmInbox::judge_message(const UdpmPacket& fragment, int subscription) const {
  if (fragment.number != 0) return UdpmOutcome::kFragment;
  if (subscription == MessageQueues::kNone) return UdpmOutcome::kUnsubscribed;
  return fragment.message_bytes > queues_.max_bytes(subscription) ? UdpmOutcome::kTooLarge
                                                                  : UdpmOutcome::kFragment;
}

}  // namespace plumb
