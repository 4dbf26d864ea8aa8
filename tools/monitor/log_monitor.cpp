#include "tools/monitor/log_monitor.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <filesystem>

#include "modules/mount/mount_wire.hpp"
#include "platform/bounded_decode.hpp"
#include "tools/monitor/hello.hpp"

namespace plumb {

using nlohmann::json;

LogMonitor::LogMonitor(const std::string& path, const PlumbConfig& config, bool recompute)
    : path_(path),
      reader_(path),
      is_recorded_(!recompute && holds_results(path)),
      can_(config.can),
      watch_([this](EventLevel level, const char* source, const std::string& text) {
        events_.add(1e-6 * static_cast<double>(now_us_ - first_us_), store_.size(), level, source,
                    text);
      }),
      images_fd_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
  json hello = hello_json("log", std::filesystem::path(path).filename().string(), config, can_);
  hello["recorded"] = is_recorded_;
  hello_ = hello.dump();
  if (is_recorded_) return;
  chain_ = std::make_unique<Chain>(
      config, 1, this, [this](const FrameRecord& record) { take_record(record); },
      [this](const objects_t& objects) { view_.take(objects); });
}

LogMonitor::~LogMonitor() {
  if (images_fd_ >= 0) ::close(images_fd_);
}

bool LogMonitor::holds_results(const std::string& path) const {
  LogReader reader(path);
  LogEvent event;
  for (std::int64_t i = 0; i < kEventsToJudgeBy && reader.next(&event); ++i)
    if (event.channel == kEgoMotion.name) return true;
  return false;
}

void LogMonitor::run(const std::function<bool()>& stopped, const std::function<void()>& notify) {
  LogEvent event;
  std::int64_t num_told = 0;
  while (!stopped() && reader_.next(&event)) {
    if (first_us_ < 0) first_us_ = event.log_us;
    now_us_ = event.log_us;
    take(event);
    read_bytes_ = reader_.offset_bytes();
    if (store_.size() < num_told + 10) continue;
    num_told = store_.size();
    notify();
  }
  if (chain_ != nullptr) chain_->finish();
  finish_frame();
  done_ = true;
  notify();
}

void LogMonitor::take(const LogEvent& event) {
  if (event.channel == kCamera.name) take_image(event);
  is_recorded_ ? take_recorded(event) : take_input(event);
}

void LogMonitor::take_image(const LogEvent& event) {
  ImageFrame frame;
  if (read_image(event.data, &frame) != nullptr) return;
  const auto bytes = static_cast<std::int64_t>(event.data.size());
  images_.push_back({frame.seq, {reader_.offset_bytes() - bytes, bytes}});
  if (images_.size() > kImagesToPairWith) images_.pop_front();
}

template <typename Message>
bool LogMonitor::decode_as(const LogEvent& event, const Channel& channel, Message* message) const {
  return event.channel == channel.name && decode_bounded(event.data, message);
}

void LogMonitor::take_input(const LogEvent& event) {
  camera_calibration_t calibration;
  detections_t detections;
  if (decode_as(event, kCameraCalibration, &calibration)) view_.take(calibration);
  if (event.channel == kCamera.name) finish_frame();
  chain_->take(event);
  if (decode_as(event, kDetections, &detections)) view_.take(detections);
}

void LogMonitor::take_stages(const char* process, const StageTimer& timer) {
  process_health_t health{};
  health.process = process;
  for (std::size_t i = 0; i < timer.num_stages(); ++i) {
    const StageStats stage = timer.stats(i);
    health.stages.push_back(
        {stage.name, stage.num_samples, stage.median_us, stage.p99_us, stage.max_us});
  }
  health.num_stages = static_cast<std::int32_t>(health.stages.size());
  view_.take(health, now_us_);
}

void LogMonitor::take_record(const FrameRecord& record) {
  begin_frame(record.seq);
  pending_.refused = record.refused;
  if (record.refused != nullptr)
    events_.add(pending_.time_s, store_.size(), EventLevel::kWarning, "chain",
                std::string("an image is refused: ") + record.refused);
  if (record.vo != nullptr) {
    view_.take(*record.vo);
    watch_.take(*record.vo);
  }
  if (record.plane != nullptr) {
    view_.take(*record.plane);
    watch_.take(*record.plane);
  }
  if (record.ego != nullptr) {
    view_.take(*record.ego);
    watch_.take(*record.ego);
  }
  mount_t mount;
  to_wire(chain_->mount(), record.capture_us, &mount);
  view_.take(mount);
  watch_.take(mount);
  take_stages("vo", *record.vo_timer);
  take_stages("ground", *record.ground_timer);
}

void LogMonitor::take_recorded(const LogEvent& event) {
  const auto keep = [&](const Channel& channel, auto message, bool watched) {
    if (!decode_as(event, channel, &message)) return;
    if constexpr (requires { watch_.take(message); }) {
      if (watched) watch_.take(message);
    }
    view_.take(message);
  };
  keep(kCameraCalibration, camera_calibration_t{}, false);
  keep(kDetections, detections_t{}, false);
  keep(kObjects, objects_t{}, false);
  keep(kMount, mount_t{}, true);
  process_health_t health;
  ego_motion_t ego;
  for (const Channel* channel :
       {&kHealthCamera, &kHealthDetect, &kHealthVo, &kHealthGround, &kHealthObjects, &kHealthCan}) {
    if (!decode_as(event, *channel, &health)) continue;
    watch_.take(health, now_us_);
    view_.take(health, now_us_);
  }
  watch_.check_silence(now_us_);
  // What belongs to the next image ends the frame of the one before.
  if (event.channel == kVoMotion.name) finish_frame();
  keep(kVoMotion, vo_motion_t{}, true);
  keep(kGroundPlane, ground_plane_t{}, true);
  if (!decode_as(event, kEgoMotion, &ego)) return;
  finish_frame();
  begin_frame(ego.seq);
  view_.take(ego);
  watch_.take(ego);
}

void LogMonitor::begin_frame(std::int64_t seq) {
  pending_ = {true, seq, 1e-6 * static_cast<double>(now_us_ - first_us_), nullptr, {}};
  for (const SeenImage& image : images_)
    if (image.seq == seq) pending_.image = image.place;
}

void LogMonitor::finish_frame() {
  if (!pending_.active) return;
  json message = view_.results(pending_.seq);
  message.update(view_.state(now_us_));
  message["type"] = "frame";
  message["time_s"] = pending_.time_s;
  message["index"] = store_.size();
  if (pending_.refused != nullptr) message["refused"] = pending_.refused;
  const Row row = view_.row(pending_.time_s, pending_.seq);
  message["row"] = row;
  message["can"] = can_.values(can_us_);
  message["can"]["state"] = is_recorded_ ? "a recorded log holds no CAN frames" : "";
  store_.add(message.dump(), row, pending_.image);
  pending_.active = false;
}

void LogMonitor::send(std::int64_t time_us, const CanFrame& frame) {
  can_us_ = time_us;
  can_.take(frame, time_us);
}

std::shared_ptr<const Packet> LogMonitor::news(NewsCursor* cursor) {
  const bool done = done_;  // before the rows, so that the last of them are not missed
  const auto rows = store_.rows(cursor->row, kRowsPerPacket);
  const bool has_events = events_.num_events() > cursor->event;
  const bool ends = done && !cursor->told_end && rows.size() < kRowsPerPacket;
  if (rows.empty() && !has_events && !ends) return nullptr;
  const json message = {
      {"type", "news"},
      {"first_row", cursor->row},
      {"rows", rows},
      {"events", events_.since(&cursor->event)},
      {"share", static_cast<double>(read_bytes_) /
                    static_cast<double>(std::max<std::int64_t>(reader_.file_bytes(), 1))},
      {"done", ends || cursor->told_end}};
  cursor->row += static_cast<std::int64_t>(rows.size());
  cursor->told_end = cursor->told_end || ends;
  return make_packet(message.dump());
}

std::shared_ptr<const Packet> LogMonitor::frame(std::int64_t index) {
  std::string text;
  ImagePlace place;
  if (!store_.read(index, &text, &place)) return nullptr;
  std::vector<std::uint8_t> jpeg;
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(place.bytes));
  ImageFrame frame;
  const bool has_image = place.bytes > 0 &&
                         ::pread(images_fd_, bytes.data(), bytes.size(), place.offset) ==
                             static_cast<ssize_t>(bytes.size()) &&
                         encoder_.encode(bytes, &frame, &jpeg) == nullptr;
  text.pop_back();  // the closing brace; what only this packet has follows
  if (has_image) {
    const json image = {{"seq", frame.seq}, {"width", frame.width_px}, {"height", frame.height_px}};
    text += ",\"image\":" + image.dump();
  }
  text += ",\"id\":" + std::to_string(next_id_) + "}";
  return make_packet(text, jpeg, next_id_++);
}

std::string LogMonitor::trouble() const {
  std::string text;
  for (const std::string& problem : reader_.problems()) text += problem + "\n";
  if (chain_ != nullptr && chain_->num_refused() > 0)
    text += path_ + ": " + std::to_string(chain_->num_refused()) +
            " messages were refused, the first: " + chain_->first_refusal() + "\n";
  if (store_.size() == 0) text += path_ + " holds neither an image on CAMERA nor EGO_MOTION\n";
  return text;
}

}  // namespace plumb
