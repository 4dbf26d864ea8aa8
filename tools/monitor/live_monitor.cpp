#include "tools/monitor/live_monitor.hpp"

#include <algorithm>

#include "core/channels.hpp"
#include "platform/clock.hpp"
#include "platform/memory_usage.hpp"
#include "tools/monitor/hello.hpp"

namespace plumb {

using nlohmann::json;

LiveMonitor::LiveMonitor(const LiveOptions& options, const PlumbConfig& config)
    : options_(options),
      start_us_(monotonic_us()),
      period_us_(static_cast<std::int64_t>(1e6 / options.rate_hz)),
      bus_(options.lcm_url, &counters_),
      can_(config.can),
      watch_([this](EventLevel level, const char* source, const std::string& text) {
        events_.add(time_s(monotonic_us()), -1, level, source, text);
      }),
      can_feed_(options.interface, options.trace,
                [this](const CanFrame& frame) { can_.take(frame, monotonic_us()); }) {
  hello_ = hello_json("live", bus_.url(), config, can_).dump();
  subscribe();
}

template <typename Message>
std::unique_ptr<Subscriber<Message>> LiveMonitor::watch(const Channel& channel,
                                                        std::function<void(const Message&)> take) {
  heard_.push_back({&channel});
  return std::make_unique<Subscriber<Message>>(
      bus_, channel, Input::kOccasional,
      [this, &channel, take = std::move(take)](const Message& message) -> const char* {
        heard(channel);
        take(message);
        return nullptr;
      });
}

void LiveMonitor::heard(const Channel& channel) {
  for (Heard& one : heard_) {
    if (one.channel != &channel) continue;
    one.time_us = monotonic_us();
    ++one.num;
  }
}

void LiveMonitor::subscribe() {
  const auto keep = [this](auto subscriber) { typed_.emplace_back(std::move(subscriber)); };
  heard_.reserve(16);
  heard_.push_back({&kCamera});
  raw_.push_back(std::make_unique<RawSubscriber>(
      bus_, kCamera, Input::kOccasional,
      [this](RawSubscriber::Bytes bytes) -> const char* {
        on_image(bytes);
        return nullptr;
      },
      MessageMemory{kMaxImageBytes, 2, Delivery::kLatest}));
  keep(watch<camera_calibration_t>(kCameraCalibration, [this](const auto& m) { view_.take(m); }));
  keep(watch<vo_motion_t>(kVoMotion, [this](const vo_motion_t& m) {
    watch_.take(m);
    if (!waiting_.active) view_.take(m);
  }));
  keep(watch<ground_plane_t>(kGroundPlane, [this](const ground_plane_t& m) {
    watch_.take(m);
    if (!waiting_.active) view_.take(m);
  }));
  keep(watch<ego_motion_t>(kEgoMotion, [this](const auto& m) { on_ego(m); }));
  keep(watch<mount_t>(kMount, [this](const mount_t& m) {
    watch_.take(m);
    view_.take(m);
  }));
  keep(watch<detections_t>(kDetections, [this](const auto& m) { view_.take(m); }));
  keep(watch<objects_t>(kObjects, [this](const auto& m) { on_objects(m); }));
  for (const Channel* channel :
       {&kHealthCamera, &kHealthDetect, &kHealthVo, &kHealthGround, &kHealthObjects, &kHealthCan}) {
    keep(watch<process_health_t>(*channel, [this](const process_health_t& m) {
      watch_.take(m, monotonic_us());
      view_.take(m, monotonic_us());
    }));
  }
}

void LiveMonitor::on_image(RawSubscriber::Bytes bytes) {
  heard(kCamera);
  if (server_ == nullptr || server_->num_pages() == 0) return;
  ImageFrame frame;
  if (read_image(bytes, &frame) != nullptr) return;
  Image* oldest = nullptr;
  for (Image& image : images_) {
    if (&image == waiting_.image) continue;
    if (oldest == nullptr || image.arrival_us < oldest->arrival_us) oldest = &image;
  }
  if (oldest->bytes.size() < bytes.size()) oldest->bytes.resize(bytes.size());
  std::copy(bytes.begin(), bytes.end(), oldest->bytes.begin());
  oldest->size = bytes.size();
  oldest->seq = frame.seq;
  oldest->arrival_us = monotonic_us();
}

const LiveMonitor::Image* LiveMonitor::image_of(std::int64_t seq) const {
  for (const Image& image : images_)
    if (image.seq == seq && image.size > 0) return &image;
  return nullptr;
}

const LiveMonitor::Image* LiveMonitor::newest_image() const {
  const Image* newest = nullptr;
  for (const Image& image : images_)
    if (image.size > 0 && (newest == nullptr || image.arrival_us > newest->arrival_us))
      newest = &image;
  return newest;
}

void LiveMonitor::on_ego(const ego_motion_t& message) {
  watch_.take(message);
  if (waiting_.active) return;
  view_.take(message);
  if (server_ == nullptr || server_->num_pages() == 0) return;
  const std::int64_t now_us = monotonic_us();
  // A quarter of a period early is on time: images come with jitter, and none shall be left out for
  // it at the camera's own rate.
  if (now_us - last_frame_us_ < period_us_ * 3 / 4) return;
  waiting_ = {true, message.seq, now_us, now_us + kLongestWaitUs, image_of(message.seq)};
  waiting_.for_objects = now_us - last_objects_us_ < 1'000'000;
  waiting_.for_can = can_.has_bursts(now_us);
  send_when_complete(now_us);
}

void LiveMonitor::on_objects(const objects_t& message) {
  view_.take(message);
  last_objects_us_ = monotonic_us();
  if (message.seq == waiting_.seq) waiting_.for_objects = false;
  send_when_complete(last_objects_us_);
}

void LiveMonitor::send_when_complete(std::int64_t now_us) {
  if (!waiting_.active) return;
  if (waiting_.for_can && can_.has_burst(waiting_.seq)) waiting_.for_can = false;
  const bool is_complete = !waiting_.for_objects && !waiting_.for_can;
  if (is_complete || now_us >= waiting_.send_us) send_waiting(now_us);
}

void LiveMonitor::send_waiting(std::int64_t now_us) {
  const double at_s = time_s(waiting_.arrival_us);
  json message = view_.results(waiting_.seq);
  message["type"] = "frame";
  message["time_s"] = at_s;
  message["row"] = view_.row(at_s, waiting_.seq);
  const auto& ego = view_.ego();
  if (ego && ego->capture_mono_us > 0)
    message["age_ms"] = static_cast<double>(now_us - ego->capture_mono_us) * 1e-3;
  const Image* image = waiting_.image;
  const std::int64_t arrival_us = waiting_.arrival_us;
  waiting_ = {};
  last_frame_us_ = arrival_us;
  ++num_frames_;
  send(std::move(message), image, arrival_us);
}

void LiveMonitor::send_state(std::int64_t now_us) {
  next_state_us_ = now_us + kSilenceUs;
  json message = {{"type", "state"}, {"time_s", time_s(now_us)}};
  const Image* image = newest_image();
  // Results stay away: the page shows at least what the camera sees.
  if (image != nullptr && image->arrival_us > last_frame_us_) {
    message["seq"] = image->seq;
  } else {
    image = nullptr;
  }
  send(std::move(message), image, now_us);
}

void LiveMonitor::send(json message, const Image* image, std::int64_t arrival_us) {
  const std::int64_t now_us = monotonic_us();
  message.update(view_.state(now_us));
  message["can"] = can_.values(now_us);
  message["can"]["state"] = can_feed_.state();
  message["monitor"] = monitor_state(now_us);
  std::vector<std::uint8_t> jpeg;
  ImageFrame frame;
  if (image != nullptr &&
      encoder_.encode({image->bytes.data(), image->size}, &frame, &jpeg) == nullptr) {
    message["image"] = {{"seq", frame.seq}, {"width", frame.width_px}, {"height", frame.height_px}};
  }
  message["id"] = next_id_;
  latency_.sent(next_id_, arrival_us);
  next_state_us_ = now_us + kSilenceUs;
  server_->publish(make_packet(message.dump(), jpeg, next_id_++));
}

json LiveMonitor::monitor_state(std::int64_t now_us) {
  if (now_us - last_cpu_at_us_ > 1'000'000) {
    const std::int64_t cpu_us = process_cpu_us();
    if (last_cpu_at_us_ != 0)
      cpu_share_ = static_cast<double>(cpu_us - last_cpu_us_) /
                   static_cast<double>(now_us - last_cpu_at_us_);
    last_cpu_us_ = cpu_us;
    last_cpu_at_us_ = now_us;
  }
  json channels = json::array();
  for (const Heard& one : heard_) {
    channels.push_back(
        {{"channel", one.channel->name},
         {"age_ms", one.time_us == 0 ? json(nullptr)
                                     : json(static_cast<double>(now_us - one.time_us) * 1e-3)},
         {"stale_ms", static_cast<double>(one.channel->stale_us) * 1e-3},
         {"num", one.num}});
  }
  return {{"cpu_share", cpu_share_},
          {"rss_bytes", memory_usage().rss_bytes},
          {"pages", server_->num_pages()},
          {"num_frames", num_frames_},
          {"refused", server_->num_refused()},
          {"page_median_ms", static_cast<double>(latency_.quantile_us(0.5)) * 1e-3},
          {"page_p95_ms", static_cast<double>(latency_.quantile_us(0.95)) * 1e-3},
          {"overflowed", bus_.transport().num_overflowed()},
          {"channels", std::move(channels)}};
}

void LiveMonitor::tick() {
  const std::int64_t now_us = monotonic_us();
  can_feed_.poll(now_us);
  watch_.take_can_faults(can_.num_faults(), now_us);
  watch_.check_silence(now_us);
  if (can_feed_.state() != can_state_) {
    can_state_ = can_feed_.state();
    if (can_feed_.wanted())
      events_.add(time_s(now_us), -1, can_state_.empty() ? EventLevel::kInfo : EventLevel::kWarning,
                  "CAN", can_state_.empty() ? "frames can be read" : can_state_);
  }
  if (server_->num_pages() == 0) return;
  send_when_complete(now_us);
  if (now_us >= next_state_us_) send_state(now_us);
}

void LiveMonitor::run(EventLoop* loop, WebServer* server) {
  server_ = server;
  loop->watch(bus_.fileno(), [this] {
    // Bounded, because a flood must not keep the timer waiting.
    for (int i = 0; i < 64 && bus_.handle(0); ++i) {
    }
  });
  loop->every(kTickUs, [this] { tick(); });
  loop->run();
}

std::shared_ptr<const Packet> LiveMonitor::news(NewsCursor* cursor) {
  if (events_.num_events() <= cursor->event) return nullptr;
  return make_packet(json{{"type", "news"}, {"events", events_.since(&cursor->event)}}.dump());
}

void LiveMonitor::acknowledge(std::int64_t id) { latency_.drawn(id, monotonic_us()); }

}  // namespace plumb
