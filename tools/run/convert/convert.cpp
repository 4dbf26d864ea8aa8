#include "tools/run/convert/convert.hpp"

#include <limits>
#include <string>

#include "core/input_error.hpp"
#include "core/principal_point.hpp"
#include "modules/camera/camera_node.hpp"
#include "modules/camera/image_wire.hpp"
#include "modules/datasets/text.hpp"
#include "platform/log.hpp"
#include "plumb/vehicle_speed_t.hpp"
#include "tools/support/camera_log.hpp"
#include "tools/support/progress.hpp"
#include "tools/support/stop_flag.hpp"

namespace plumb {
namespace {

/// Of the speeds in a file, which states none: that of a speedometer.
constexpr double kVehicleSpeedScaleStd = 0.01;

class RecordingWriter {
 public:
  RecordingWriter(const CameraConfig& config, const RecordingOptions& options)
      : options_(options), node_(config, options.mask_folder, &probe_) {
    if (const char* why = from_wire(node_.calibration(0), &camera_)) throw InputError(why);
    if (!is_principal_point_central(camera_)) result_.concern = kPrincipalPointIsOff;
  }

  /// `index` counts the images of the recording from 0.
  void add(const GreyFrame& frame, std::size_t index) {
    if (!log_) log_.emplace(options_.out, camera_, options_.jpeg);
    const image_t& image = node_.take(frame);
    log_->begin_image(frame.capture_us);
    log_->write_image(frame.seq, {image.data.data(), image.width, image.height, image.row_stride});
    if (node_.fault() != ImageFault::kNone) ++result_.num_faulty;
    if (!options_.vehicle_speeds_m_s.empty()) write_vehicle_speed(frame.capture_us, index);
  }

  RecordingResult finish() {
    if (!log_) return result_;
    result_.num_frames = log_->num_images();
    result_.duration_s = log_->duration_s();
    result_.log_bytes = log_->close();
    return result_;
  }
  [[nodiscard]] std::int64_t num_frames() const { return log_ ? log_->num_images() : 0; }

 private:
  void write_vehicle_speed(std::int64_t capture_us, std::size_t index) {
    if (index >= options_.vehicle_speeds_m_s.size()) {
      throw InputError(format("--vehicle-speed has %zu speeds, and the recording more images",
                              options_.vehicle_speeds_m_s.size()));
    }
    vehicle_speed_t message{};
    message.utime = capture_us;
    message.speed_m_s = options_.vehicle_speeds_m_s[index];
    message.scale_std = kVehicleSpeedScaleStd;
    log_->write(kVehicleSpeed, message);
  }

  const RecordingOptions& options_;
  NullProbe probe_;
  CameraNode node_;
  CameraModel camera_;
  std::optional<CameraLog> log_;
  RecordingResult result_;
};

/// Hands the frames between start and end to the writer. Reads none behind the end.
void write_frames(const RecordingOptions& options, RecordedSource* source, Progress* progress,
                  RecordingWriter* writer) {
  const std::int64_t start = options.start.value_or(0);
  const std::int64_t end = options.end.value_or(std::numeric_limits<std::int64_t>::max());
  std::size_t num_read = 0;
  GreyFrame frame;
  while (!stop_requested() && source->read(&frame)) {
    if (frame.seq >= start && frame.seq <= end) writer->add(frame, num_read);
    progress->update(static_cast<std::int64_t>(++num_read), writer->num_frames());
    if (frame.seq >= end) break;
  }
}

}  // namespace

RecordingResult convert_recording(RecordedSource* source, const CameraConfig& config,
                                  const RecordingOptions& options) {
  RecordingWriter writer(config, options);
  for (const std::string& note : source->notes()) log_line("%s", note.c_str());
  Progress progress("converting", "frames", source->num_frames());
  try {
    write_frames(options, source, &progress, &writer);
  } catch (const InputError& error) {
    progress.finish(false);
    const RecordingResult result = writer.finish();
    if (result.num_frames == 0) throw;
    throw InputError(format("%s; %s holds the %lld frames before it", error.what(),
                            options.out.c_str(), static_cast<long long>(result.num_frames)));
  }
  RecordingResult result = writer.finish();
  result.stopped = stop_requested();
  progress.finish(!result.stopped);
  if (result.num_frames == 0 && !result.stopped)
    throw InputError("no frame of the recording lies between --start and --end");
  return result;
}

}  // namespace plumb
