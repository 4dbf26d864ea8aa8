#include "tools/run/convert/convert.hpp"

#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "core/input_error.hpp"
#include "core/principal_point.hpp"
#include "modules/camera/camera_node.hpp"
#include "modules/camera/image_wire.hpp"
#include "modules/datasets/text.hpp"
#include "platform/log.hpp"
#include "tools/support/message_log.hpp"
#include "tools/support/progress.hpp"
#include "tools/support/stop_flag.hpp"

namespace plumb {
namespace {

constexpr std::int64_t kCalibrationPeriod_us = 1'000'000;
constexpr int kJpegQuality = 95;

class RecordingWriter {
 public:
  RecordingWriter(const CameraConfig& config, const RecordingOptions& options)
      : options_(options), node_(config, options.mask_folder, &probe_) {
    CameraModel camera;
    if (const char* why = from_wire(node_.calibration(0), &camera)) throw InputError(why);
    if (!is_principal_point_central(camera)) result_.concern = kPrincipalPointIsOff;
  }

  void add(const GreyFrame& frame) {
    if (!log_) {
      log_.emplace(options_.out.string());
      first_us_ = frame.capture_us;
    }
    if (result_.num_frames == 0 || frame.capture_us - calibration_us_ >= kCalibrationPeriod_us) {
      calibration_us_ = frame.capture_us;
      log_->write(frame.capture_us, kCameraCalibration, node_.calibration(frame.capture_us));
    }
    const image_t& image = node_.take(frame);
    log_->write(frame.capture_us, kCamera, options_.jpeg ? compressed(frame, image) : image);
    if (node_.fault() != ImageFault::kNone) ++result_.num_faulty;
    ++result_.num_frames;
    result_.duration_s = 1e-6 * static_cast<double>(frame.capture_us - first_us_);
  }

  RecordingResult finish() {
    if (!log_) return result_;
    log_->close();
    result_.log_bytes = static_cast<std::int64_t>(std::filesystem::file_size(options_.out));
    return result_;
  }
  [[nodiscard]] std::int64_t num_frames() const { return result_.num_frames; }

 private:
  const image_t& compressed(const GreyFrame& frame, const image_t& image) {
    const cv::Mat pixels(image.height, image.width, CV_8U,
                         const_cast<std::uint8_t*>(image.data.data()),
                         static_cast<std::size_t>(image.row_stride));
    cv::imencode(".jpg", pixels, jpeg_, {cv::IMWRITE_JPEG_QUALITY, kJpegQuality});
    to_wire_jpeg(frame.capture_us, frame.seq, image.width, image.height, jpeg_, &jpeg_image_);
    return jpeg_image_;
  }

  const RecordingOptions& options_;
  NullProbe probe_;
  CameraNode node_;
  std::optional<MessageLog> log_;
  RecordingResult result_;
  std::int64_t first_us_ = 0;
  std::int64_t calibration_us_ = 0;
  std::vector<std::uint8_t> jpeg_;
  image_t jpeg_image_{};
};

/// Hands the frames between start and end to the writer. Reads none behind the end.
void write_frames(const RecordingOptions& options, RecordedSource* source, Progress* progress,
                  RecordingWriter* writer) {
  const std::int64_t start = options.start.value_or(0);
  const std::int64_t end = options.end.value_or(std::numeric_limits<std::int64_t>::max());
  std::int64_t num_read = 0;
  GreyFrame frame;
  while (!stop_requested() && source->read(&frame)) {
    if (frame.seq >= start && frame.seq <= end) writer->add(frame);
    progress->update(++num_read, writer->num_frames());
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
