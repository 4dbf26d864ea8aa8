#include "tools/run/export/drive_sink.hpp"

#include <map>
#include <opencv2/imgcodecs.hpp>

#include "core/channels.hpp"
#include "core/input_error.hpp"
#include "modules/camera/image_wire.hpp"
#include "platform/log_file.hpp"
#include "tools/support/progress.hpp"
#include "tools/support/stop_flag.hpp"

namespace plumb {
namespace {

constexpr int kExportQuality = 95;

/// The frames of a drive, handed on in their order as far as the images have come.
class FrameQueue {
 public:
  FrameQueue(const DriveResults& drive, const std::vector<DriveSink*>& sinks)
      : drive_(drive), sinks_(sinks) {
    for (std::size_t i = 0; i < drive.frames.size(); ++i)
      places_.try_emplace({drive.frames[i].capture_us, drive.frames[i].seq}, i);
  }

  /// Hands on the frames before that of an image.
  void advance_to(const ImageFrame& image) {
    const auto place = places_.find({image.capture_us, image.seq});
    if (place != places_.end()) advance(place->second);
  }
  /// Hands on the frame of an image.
  void pass(const ImageFrame& image) {
    const auto place = places_.find({image.capture_us, image.seq});
    if (place != places_.end()) advance(place->second + 1);
  }
  void finish() { advance(drive_.frames.size()); }

 private:
  void advance(std::size_t end) {
    for (; next_ < end; ++next_) {
      for (DriveSink* sink : sinks_) sink->take_frame(drive_.frames[next_]);
    }
  }
  const DriveResults& drive_;
  const std::vector<DriveSink*>& sinks_;
  std::map<std::pair<std::int64_t, std::int64_t>, std::size_t> places_;
  std::size_t next_ = 0;
};

bool encode(const ImageFrame& image, std::vector<std::uint8_t>* jpeg) {
  const cv::Mat pixels(image.height_px, image.width_px, CV_8U,
                       const_cast<std::uint8_t*>(image.data.data()),
                       static_cast<std::size_t>(image.row_stride_bytes));
  return cv::imencode(".jpg", pixels, *jpeg, {cv::IMWRITE_JPEG_QUALITY, kExportQuality});
}

}  // namespace

void export_drive(const std::string& log, const DriveResults& drive,
                  const std::vector<DriveSink*>& sinks) {
  if (sinks.empty()) return;
  FrameQueue frames(drive, sinks);
  LogReader reader(log);
  Progress progress("exporting", "images", reader.file_bytes());
  std::int64_t num_images = 0;
  std::vector<std::uint8_t> jpeg;
  LogEvent event;
  while (!stop_requested() && reader.next(&event)) {
    ImageFrame image;
    if (event.channel != kCamera.name || read_image(event.data, &image) != nullptr) continue;
    if (!image.compressed && !encode(image, &jpeg)) throw InputError("cannot encode an image");
    frames.advance_to(image);
    const JpegImage out{image.capture_us, image.seq,
                        image.compressed ? image.data : std::span<const std::uint8_t>(jpeg)};
    for (DriveSink* sink : sinks) sink->take_image(out);
    frames.pass(image);
    progress.update(reader.offset_bytes(), ++num_images);
  }
  if (!stop_requested()) frames.finish();
  progress.finish(!stop_requested());
  for (DriveSink* sink : sinks) sink->close();
}

}  // namespace plumb
