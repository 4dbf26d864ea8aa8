#include "tools/run/record/message_ring.hpp"

#include <algorithm>
#include <chrono>
#include <cstring>

namespace plumb {

bool MessageRing::push(int channel, std::int64_t log_us, std::span<const std::uint8_t> message) {
  const Header header{log_us, message.size(), channel};
  const std::size_t needed = sizeof header + message.size();
  std::unique_lock lock(mutex_);
  has_room_.wait(lock, [&] { return closed_ || bytes_.size() - used_ >= needed; });
  if (closed_) return false;
  copy_in(&header, sizeof header);
  copy_in(message.data(), message.size());
  peak_ = std::max(peak_, used_);
  has_message_.notify_one();
  return true;
}

MessageRing::Result MessageRing::pop(Message* message, int timeout_ms) {
  std::unique_lock lock(mutex_);
  has_message_.wait_for(lock, std::chrono::milliseconds(timeout_ms),
                        [&] { return closed_ || used_ > 0; });
  if (used_ == 0) return closed_ ? Result::kClosed : Result::kNothing;
  Header header{};
  copy_out(&header, sizeof header);
  message->channel = static_cast<int>(header.channel);
  message->log_us = header.log_us;
  message->bytes.resize(header.size);
  copy_out(message->bytes.data(), header.size);
  has_room_.notify_one();
  return Result::kMessage;
}

void MessageRing::close() {
  const std::lock_guard lock(mutex_);
  closed_ = true;
  has_room_.notify_all();
  has_message_.notify_all();
}

std::size_t MessageRing::peak_bytes() const {
  const std::lock_guard lock(mutex_);
  return peak_;
}

void MessageRing::copy_in(const void* from, std::size_t count) {
  const auto* bytes = static_cast<const std::uint8_t*>(from);
  const std::size_t at = (begin_ + used_) % bytes_.size();
  const std::size_t first = std::min(count, bytes_.size() - at);
  std::copy_n(bytes, first, bytes_.begin() + static_cast<std::ptrdiff_t>(at));
  std::copy_n(bytes + first, count - first, bytes_.begin());
  used_ += count;
}

void MessageRing::copy_out(void* to, std::size_t count) {
  auto* bytes = static_cast<std::uint8_t*>(to);
  const std::size_t first = std::min(count, bytes_.size() - begin_);
  std::copy_n(bytes_.begin() + static_cast<std::ptrdiff_t>(begin_), first, bytes);
  std::copy_n(bytes_.begin(), count - first, bytes + first);
  begin_ = (begin_ + count) % bytes_.size();
  used_ -= count;
}

}  // namespace plumb
