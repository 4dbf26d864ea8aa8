#include "platform/udpm/message_queues.hpp"

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "platform/udpm/udpm_packet.hpp"

namespace plumb {

int MessageQueues::subscribe(const Subscription& wanted) {
  if (!is_udpm_channel(wanted.channel))
    throw std::invalid_argument("\"" + wanted.channel + "\" is not the name of a channel");
  if (find(wanted.channel) != kNone)
    throw std::invalid_argument("channel " + wanted.channel + " is subscribed already");
  if (wanted.max_bytes == 0 || wanted.num_slots == 0)
    throw std::invalid_argument("channel " + wanted.channel + " has no memory for messages");
  Queue queue;
  queue.channel = wanted.channel;
  queue.max_bytes = wanted.max_bytes;
  queue.delivery = wanted.delivery;
  // One slot is being handled while the other one takes the newest message.
  queue.slots.resize(wanted.delivery == Delivery::kLatest ? 2 : wanted.num_slots);
  for (Slot& slot : queue.slots) slot.buffer.assign(wanted.max_bytes, 0);
  queues_.push_back(std::move(queue));
  return static_cast<int>(queues_.size()) - 1;
}

void MessageQueues::unsubscribe(int subscription) {
  num_waiting_ -= num_waiting(subscription);
  if (popped_ == subscription) popped_ = kNone;
  at(subscription) = {};
}

int MessageQueues::find(std::string_view channel) const {
  for (std::size_t i = 0; i < queues_.size(); ++i)
    if (!channel.empty() && queues_[i].channel == channel) return static_cast<int>(i);
  return kNone;
}

void MessageQueues::push(int subscription, std::span<const std::uint8_t> bytes,
                         std::int64_t arrival_us) {
  Slot& slot = next_slot(subscription, arrival_us);
  if (!bytes.empty()) std::memcpy(slot.buffer.data(), bytes.data(), bytes.size());
  slot.size = bytes.size();
}

void MessageQueues::push_buffer(int subscription, std::vector<std::uint8_t>* buffer,
                                std::size_t size, std::int64_t arrival_us) {
  if (buffer->size() != at(subscription).max_bytes)
    return push(subscription, std::span(*buffer).first(size), arrival_us);
  Slot& slot = next_slot(subscription, arrival_us);
  std::swap(slot.buffer, *buffer);
  slot.size = size;
}

/// The slot for a new message.
MessageQueues::Slot& MessageQueues::next_slot(int subscription, std::int64_t arrival_us) {
  Queue& queue = at(subscription);
  if (queue.delivery == Delivery::kLatest && num_waiting(subscription) > 0) {
    ++queue.num_skipped;
  } else {
    ++queue.size;
    ++num_waiting_;
  }
  Slot& slot = queue.slots[(queue.first + queue.size - 1) % queue.slots.size()];
  slot.arrival_us = arrival_us;
  slot.order = num_pushed_++;
  return slot;
}

bool MessageQueues::is_full(int subscription) const {
  const Queue& queue = at(subscription);
  return queue.delivery == Delivery::kEvery && !queue.channel.empty() &&
         queue.size == queue.slots.size();
}

bool MessageQueues::is_full() const {
  for (std::size_t i = 0; i < queues_.size(); ++i)
    if (is_full(static_cast<int>(i))) return true;
  return false;
}

MessageQueues::View MessageQueues::pop() {
  release();
  std::uint64_t oldest = 0;
  for (std::size_t i = 0; i < queues_.size(); ++i) {
    const Queue& queue = queues_[i];
    if (queue.size == 0) continue;
    const std::uint64_t order = queue.slots[queue.first].order;
    if (popped_ != kNone && order > oldest) continue;
    popped_ = static_cast<int>(i);
    oldest = order;
  }
  if (popped_ == kNone) return {};
  --num_waiting_;
  const Queue& queue = at(popped_);
  const Slot& slot = queue.slots[queue.first];
  return {popped_, std::span(slot.buffer).first(slot.size), slot.arrival_us};
}

void MessageQueues::release() {
  if (popped_ == kNone) return;
  Queue& queue = at(popped_);
  queue.first = (queue.first + 1) % queue.slots.size();
  --queue.size;
  popped_ = kNone;
}

}  // namespace plumb
