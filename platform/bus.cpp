#include "platform/bus.hpp"

#include <poll.h>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <utility>

#include "platform/clock.hpp"
#include "platform/log.hpp"
#include "platform/udpm/memory_transport.hpp"
#include "platform/udpm/udpm_endpoint.hpp"

namespace plumb {
namespace {

constexpr const char* kDefaultUrl = "udpm://239.255.76.67:7667?ttl=0";

std::unique_ptr<MessageTransport> make_transport(const std::string& url) {
  if (url.rfind("memq://", 0) == 0) return std::make_unique<MemoryTransport>();
  UdpmUrl parsed = parse_udpm_url(url);
  if (parsed.receive_buffer_bytes == 0) parsed.receive_buffer_bytes = Bus::kReceiveBufferBytes;
  return std::make_unique<UdpmEndpoint>(std::move(parsed));
}

}  // namespace

std::string lcm_url(const std::string& asked) {
  const char* preset = std::getenv("LCM_DEFAULT_URL");
  if (!asked.empty()) return asked;
  return preset != nullptr && *preset != '\0' ? preset : kDefaultUrl;
}

Bus::Bus(const std::string& url, Counters* counters) : url_(lcm_url(url)), counters_(counters) {
  try {
    transport_ = make_transport(url_);
  } catch (const std::exception& error) {
    throw BusError(error.what());
  }
}

Bus::~Bus() = default;

int Bus::fileno() {
  try {
    return transport_->fileno();
  } catch (const std::exception& error) {
    throw BusError("cannot receive on LCM network " + url_ + ": " + error.what());
  }
}

bool Bus::handle(int timeout_ms) {
  const MessageQueues::View message = wait_for_message(timeout_ms);
  tell_refusals();
  if (message.subscription == MessageQueues::kNone) return false;
  for (RawSubscriber* subscriber : subscribers_) {
    if (subscriber->subscription_ != message.subscription) continue;
    subscriber->dispatch(message);
    return true;
  }
  return false;
}

/// The descriptor may be readable for packets that are no message of ours, so look again until the
/// time has passed.
MessageQueues::View Bus::wait_for_message(int timeout_ms) {
  const std::int64_t end_us = monotonic_us() + std::int64_t{timeout_ms} * 1'000;
  MessageQueues::View message = transport_->take();
  while (message.subscription == MessageQueues::kNone) {
    const std::int64_t left_us = end_us - monotonic_us();
    if (left_us <= 0) break;
    pollfd watched{fileno(), POLLIN, 0};
    (void)::poll(&watched, 1, static_cast<int>((left_us + 999) / 1'000));
    message = transport_->take();
  }
  return message;
}

bool Bus::publish(const Channel& channel, std::span<const std::uint8_t> bytes) {
  return transport_->publish(channel.name, bytes);
}

int Bus::subscribe(const Subscription& wanted) {
  const bool is_first = transport_->receive_buffer_bytes() == 0;
  int subscription = MessageQueues::kNone;
  try {
    subscription = transport_->subscribe(wanted);
  } catch (const std::exception& error) {
    throw BusError("cannot receive " + wanted.channel + " on LCM network " + url_ + ": " +
                   error.what());
  }
  const int granted = transport_->receive_buffer_bytes();
  if (is_first && granted > 0 && granted < kReceiveBufferBytes) {
    log_warning(
        "the kernel granted a receive buffer of %d bytes instead of %d; images may be lost; "
        "to grant it run: sysctl -w net.core.rmem_max=%d",
        granted, kReceiveBufferBytes, kReceiveBufferBytes);
  }
  return subscription;
}

/// Says which packets were refused since the last call. Only messages that are too large count as
/// rejected: anything else may come from anybody and says nothing about our neighbours.
void Bus::tell_refusals() {
  const std::int64_t num_overflowed = transport_->num_overflowed();
  if (num_overflowed != num_overflowed_)
    log_limited("the receive buffer was full, packets were lost: %lld so far",
                static_cast<long long>(num_overflowed));
  num_overflowed_ = num_overflowed;
  const UdpmOutcomeCounts now = transport_->outcomes();
  if (now.num_refused() == num_refused_) return;
  num_refused_ = now.num_refused();
  for (std::size_t i = 0; i < kNumUdpmOutcomes; ++i) {
    const auto outcome = static_cast<UdpmOutcome>(i);
    if (!is_refusal(outcome) || now[outcome] == outcomes_[outcome]) continue;
    if (outcome == UdpmOutcome::kTooLarge) counters_->reject(describe(outcome));
    log_limited("packets were refused: %s, %lld so far", describe(outcome),
                static_cast<long long>(now[outcome]));
  }
  outcomes_ = now;
}

RawSubscriber::RawSubscriber(Bus& bus, const Channel& channel, Input input, Handler handler,
                             const MessageMemory& memory)
    : bus_(bus), channel_(channel), input_(input), handler_(std::move(handler)) {
  subscription_ =
      bus.subscribe({channel.name, memory.max_bytes, memory.num_slots, memory.delivery});
  bus.subscribers_.push_back(this);
}

RawSubscriber::~RawSubscriber() {
  bus_.transport_->unsubscribe(subscription_);
  auto& list = bus_.subscribers_;
  list.erase(std::find(list.begin(), list.end(), this));
}

std::int64_t RawSubscriber::num_skipped() const {
  return bus_.transport_->num_skipped(subscription_);
}

bool RawSubscriber::is_overtaken(std::int64_t limit_us, std::int64_t ready_us) const {
  return last_us_ - std::max(arrival_us_, ready_us) > limit_us &&
         bus_.transport_->num_waiting(subscription_) > 0;
}

void RawSubscriber::skip() {
  is_skipped_ = true;
  ++bus_.counters().num_skipped;
}

bool RawSubscriber::is_late(std::int64_t now_us) const {
  if (channel_.stale_us <= 0 || is_skipped_) return false;
  const std::int64_t since_us = capture_us_ > 0 ? std::min(capture_us_, arrival_us_) : arrival_us_;
  return now_us - since_us > channel_.stale_us;
}

void RawSubscriber::dispatch(const MessageQueues::View& message) {
  try {
    take(message);
  } catch (const std::exception& error) {
    bus_.counters().reject("its handler threw an exception");
    log_limited("%s: %s", channel_.name, error.what());
  }
}

void RawSubscriber::take(const MessageQueues::View& message) {
  last_us_ = monotonic_us();
  arrival_us_ = message.arrival_us;
  capture_us_ = 0;
  is_skipped_ = false;
  Counters& counters = bus_.counters();
  ++counters.num_received;
  if (const char* refused = handler_(message.bytes)) {
    counters.reject(refused);
    log_limited("a message on %s was refused: %s", channel_.name, refused);
  } else if (!is_skipped_) {
    accepted_us_ = last_us_;
  }
  if (is_late(monotonic_us())) ++counters.num_late;
}

}  // namespace plumb
