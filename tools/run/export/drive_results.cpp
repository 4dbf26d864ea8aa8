#include "tools/run/export/drive_results.hpp"

#include <cmath>

#include "core/channels.hpp"
#include "core/input_error.hpp"
#include "modules/camera/image_wire.hpp"
#include "modules/chain/chain.hpp"
#include "modules/datasets/text.hpp"
#include "modules/vo/vo_wire.hpp"
#include "platform/bounded_decode.hpp"
#include "platform/config.hpp"
#include "platform/log_file.hpp"
#include "plumb/mount_t.hpp"
#include "tools/run/replay/frame_csv.hpp"
#include "tools/support/progress.hpp"

namespace plumb {
namespace {

bool holds_results(const std::string& path) {
  LogReader reader(path);
  LogEvent event;
  while (reader.next(&event)) {
    if (event.channel == kEgoMotion.name) return true;
  }
  return false;
}

/// Takes what is wanted of a motion besides its row in the table.
void take_motion(const vo_motion_t& motion, FrameResult* frame) {
  frame->interval_s = motion.interval_s;
  VoOutput output;
  if (from_wire(motion, &output) != nullptr) return;
  frame->features.assign(output.features.begin(), output.features.end());
}

/// Takes the results that a log holds, in whatever order they were recorded.
class RecordedResults {
 public:
  explicit RecordedResults(DriveResults* drive) : drive_(drive) {}

  void take(const LogEvent& event) {
    if (event.channel == kCamera.name) take_image(event);
    if (event.channel == kVoMotion.name) take_result<vo_motion_t>(event);
    if (event.channel == kGroundPlane.name) take_result<ground_plane_t>(event);
    if (event.channel == kEgoMotion.name) take_result<ego_motion_t>(event);
    if (event.channel == kObjects.name) take_result<objects_t>(event);
    if (event.channel == kMount.name) take_mount(event);
    if (event.channel.starts_with("HEALTH_")) take_health(event);
  }

  /// Completes the frames whose results are not all there.
  void finish() {
    for (FrameResult& frame : drive_->frames) {
      if (frame.csv_row.empty()) write_row(&frame);
    }
    if (num_refused_ > 0) {
      drive_->problems.push_back(format("%lld messages were refused, the first on %s",
                                        static_cast<long long>(num_refused_),
                                        first_refused_.c_str()));
    }
  }

 private:
  void refuse(const LogEvent& event) {
    if (num_refused_++ == 0) first_refused_ = event.channel;
  }

  FrameResult* frame_of(std::int64_t capture_us, std::int64_t seq) {
    FrameResult* frame = drive_->find(capture_us, seq);
    return frame != nullptr ? frame : drive_->add(capture_us, seq);
  }

  void take_image(const LogEvent& event) {
    ImageFrame image;
    if (read_image(event.data, &image) != nullptr) return refuse(event);
    frame_of(image.capture_us, image.seq);
  }

  template <typename Message>
  void take_result(const LogEvent& event) {
    Message message;
    if (!decode_bounded(event.data, &message)) return refuse(event);
    FrameResult* frame = frame_of(message.utime, message.seq);
    keep(message, frame);
    const auto motion = motions_.find({frame->capture_us, frame->seq});
    if (frame->ego && frame->plane && motion != motions_.end()) {
      write_row(frame);
      motions_.erase(motion);
    }
  }

  void keep(const vo_motion_t& message, FrameResult* frame) {
    motions_[{frame->capture_us, frame->seq}] = message;
    take_motion(message, frame);
  }
  static void keep(const ground_plane_t& message, FrameResult* frame) { frame->plane = message; }
  static void keep(const ego_motion_t& message, FrameResult* frame) { frame->ego = message; }
  static void keep(const objects_t& message, FrameResult* frame) { frame->objects = message; }

  void take_mount(const LogEvent& event) {
    mount_t mount;
    if (!decode_bounded(event.data, &mount)) return refuse(event);
    if (std::isfinite(mount.recent_rad[2])) drive_->mount_yaw_rad = mount.recent_rad[2];
  }

  void take_health(const LogEvent& event) {
    process_health_t health;
    if (!decode_bounded(event.data, &health)) return refuse(event);
    if (!drive_->frames.empty()) drive_->frames.back().health.push_back(health);
  }

  void write_row(FrameResult* frame) {
    FrameRecord record;
    record.seq = frame->seq;
    record.capture_us = frame->capture_us;
    const auto motion = motions_.find({frame->capture_us, frame->seq});
    if (motion != motions_.end()) record.vo = &motion->second;
    if (frame->plane) record.plane = &*frame->plane;
    if (frame->ego) record.ego = &*frame->ego;
    frame->csv_row = frame_csv_row(record, false);
  }

  DriveResults* drive_;
  std::map<std::pair<std::int64_t, std::int64_t>, vo_motion_t> motions_;  ///< without a row yet
  std::int64_t num_refused_ = 0;
  std::string first_refused_;
};

void take_calibration(const LogEvent& event, DriveResults* drive) {
  camera_calibration_t message;
  CameraModel camera;
  if (drive->camera || event.channel != kCameraCalibration.name) return;
  if (decode_bounded(event.data, &message) && from_wire(message, &camera) == nullptr)
    drive->camera = camera;
}

void add_problems(const LogReader& reader, DriveResults* drive) {
  for (const std::string& problem : reader.problems()) drive->problems.push_back(problem);
  const auto unlisted = reader.num_problems() - static_cast<std::int64_t>(reader.problems().size());
  if (unlisted > 0)
    drive->problems.push_back(
        format("%lld further damaged places", static_cast<long long>(unlisted)));
}

void read_recorded(const std::string& log, DriveResults* drive) {
  LogReader reader(log);
  Progress progress("reading", "images", reader.file_bytes());
  RecordedResults results(drive);
  LogEvent event;
  while (reader.next(&event)) {
    take_calibration(event, drive);
    results.take(event);
    progress.update(reader.offset_bytes(), static_cast<std::int64_t>(drive->frames.size()));
  }
  results.finish();
  progress.finish(true);
  add_problems(reader, drive);
}

void add_record(const FrameRecord& record, DriveResults* drive) {
  FrameResult* frame = drive->add(record.capture_us, record.seq);
  if (record.plane != nullptr) frame->plane = *record.plane;
  if (record.ego != nullptr) frame->ego = *record.ego;
  if (record.vo != nullptr) take_motion(*record.vo, frame);
  frame->csv_row = frame_csv_row(record, false);
}

void replay(const DriveOptions& options, DriveResults* drive) {
  PlumbConfig config;
  load_config(options.config, &config);
  LogReader reader(options.log);
  Chain chain(
      config, options.seed, nullptr,
      [drive](const FrameRecord& record) { add_record(record, drive); },
      [drive](const objects_t& objects) {
        if (FrameResult* frame = drive->find(objects.utime, objects.seq)) frame->objects = objects;
      });
  Progress progress("replaying", "images", reader.file_bytes());
  LogEvent event;
  while (reader.next(&event)) {
    take_calibration(event, drive);
    chain.take(event);
    progress.update(reader.offset_bytes(), chain.num_frames());
  }
  progress.finish(true);
  const double yaw_rad = chain.mount().recent_rad[2];
  if (std::isfinite(yaw_rad)) drive->mount_yaw_rad = yaw_rad;
  add_problems(reader, drive);
  if (chain.num_refused() > 0) {
    drive->problems.push_back(format("%lld messages were refused, the first: %s",
                                     static_cast<long long>(chain.num_refused()),
                                     chain.first_refusal().c_str()));
  }
}

}  // namespace

bool has_pose(const FrameResult& frame) {
  return frame.ego && frame.ego->status != ego_motion_t::STATUS_INITIALIZING &&
         frame.ego->status != ego_motion_t::STATUS_LOST;
}

bool has_plane(const FrameResult& frame) {
  return frame.plane && (frame.plane->status == ground_plane_t::STATUS_OK ||
                         frame.plane->status == ground_plane_t::STATUS_HELD);
}

FrameResult* DriveResults::find(std::int64_t capture_us, std::int64_t seq) {
  const auto place = places_.find({capture_us, seq});
  return place == places_.end() ? nullptr : &frames[place->second];
}

FrameResult* DriveResults::add(std::int64_t capture_us, std::int64_t seq) {
  places_[{capture_us, seq}] = frames.size();
  FrameResult& frame = frames.emplace_back();
  frame.seq = seq;
  frame.capture_us = capture_us;
  return &frame;
}

DriveResults read_drive(const DriveOptions& options) {
  DriveResults drive;
  drive.replayed = options.replay || !holds_results(options.log);
  if (drive.replayed) {
    replay(options, &drive);
  } else {
    read_recorded(options.log, &drive);
  }
  if (drive.frames.empty()) throw InputError(options.log + " holds neither an image nor a motion");
  return drive;
}

}  // namespace plumb
