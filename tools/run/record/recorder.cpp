#include "tools/run/record/recorder.hpp"

#include <poll.h>

#include <algorithm>
#include <atomic>
#include <thread>

#include "core/channels.hpp"
#include "modules/camera/image_wire.hpp"
#include "platform/clock.hpp"
#include "tools/support/stop_flag.hpp"

namespace plumb {
namespace {

constexpr int kPoll_ms = 50;
constexpr std::int64_t kFlushPeriod_us = 200'000;
constexpr std::size_t kImageSlots = 4, kMessageSlots = 16;
constexpr std::size_t kMaxMessageBytes = 64 << 10;  ///< of all channels of Plumbline but CAMERA

bool is_plumbline(const std::string& channel) {
  const std::vector<std::string>& known = plumbline_channels();
  return std::find(known.begin(), known.end(), channel) != known.end();
}

}  // namespace

const std::vector<std::string>& plumbline_channels() {
  static const std::vector<std::string> kAll = [] {
    std::vector<std::string> names;
    for (const Channel* channel :
         {&kCamera, &kCameraCalibration, &kVoMotion, &kGroundPlane, &kEgoMotion, &kMount,
          &kDetections, &kObjects, &kGroundTruth, &kHealthCamera, &kHealthVo, &kHealthGround,
          &kHealthDetect, &kHealthObjects, &kHealthCan})
      names.emplace_back(channel->name);
    return names;
  }();
  return kAll;
}

void ImageCount::take(std::int64_t session, std::int64_t seq) {
  // A number that goes back is a new start, also of a source that states no session.
  if (num_images_ > 0 && session == session_ && seq > last_seq_) num_lost_ += seq - last_seq_ - 1;
  session_ = session;
  last_seq_ = seq;
  ++num_images_;
}

Recorder::Recorder(const UdpmUrl& url, RecorderOptions options)
    : options_(std::move(options)), ring_(options_.ring_bytes), receiver_(url) {
  for (const std::string& channel : options_.channels) {
    const bool is_small = is_plumbline(channel) && channel != kCamera.name;
    const std::size_t most = options_.max_message_bytes;
    receiver_.subscribe({channel, is_small ? std::min(most, kMaxMessageBytes) : most,
                         is_small ? kMessageSlots : kImageSlots, Delivery::kEvery});
  }
}

/// Moves messages from the socket to the ring until that is closed.
void Recorder::receive() {
  pollfd ready{receiver_.fileno(), POLLIN, 0};
  const std::int64_t offset_us = realtime_us() - monotonic_us();
  const std::int64_t end_us = monotonic_us() + options_.duration_us;
  while (!stop_requested() && (options_.duration_us == 0 || monotonic_us() < end_us)) {
    (void)::poll(&ready, 1, kPoll_ms);
    for (auto message = receiver_.take(); message.subscription != MessageQueues::kNone;
         message = receiver_.take()) {
      if (!ring_.push(message.subscription, message.arrival_us + offset_us, message.bytes)) return;
    }
  }
  ring_.close();
}

RecorderReport Recorder::run(Recording* recording, const Progress& progress) {
  RecorderReport report;
  report.num_per_channel.resize(options_.channels.size());
  std::thread receiving([this] { receive(); });
  std::int64_t flushed_us = monotonic_us();
  MessageRing::Message message;
  const auto write = [&] {
    const auto channel = static_cast<std::size_t>(message.channel);
    ImageFrame image;
    if (options_.channels[channel] == kCamera.name && read_image(message.bytes, &image) == nullptr)
      report.images.take(image.session, image.seq);
    ++report.num_per_channel[channel];
    report.ended = recording->write(message.log_us, options_.channels[channel], message.bytes);
  };
  try {
    while (report.ended == nullptr) {
      const MessageRing::Result result = ring_.pop(&message, kPoll_ms);
      if (result == MessageRing::Result::kClosed) break;
      if (result == MessageRing::Result::kMessage) write();
      if (monotonic_us() - flushed_us < kFlushPeriod_us) continue;
      flushed_us = monotonic_us();
      recording->flush();
      if (progress) progress(report);
    }
    recording->close();
  } catch (...) {
    ring_.close();
    receiving.join();
    throw;
  }
  ring_.close();
  receiving.join();
  const UdpmOutcomeCounts& outcomes = receiver_.inbox().outcomes();
  report.num_overflowed = receiver_.num_overflowed();
  report.num_incomplete = receiver_.inbox().num_given_up();
  report.num_too_large = outcomes[UdpmOutcome::kTooLarge];
  report.ring_peak_bytes = ring_.peak_bytes();
  return report;
}

}  // namespace plumb
