#include "tools/learn/calibrate/recorded_drive.hpp"

#include <cstring>
#include <optional>

#include "core/channels.hpp"
#include "core/input_error.hpp"
#include "modules/camera/image_wire.hpp"
#include "platform/bounded_decode.hpp"
#include "platform/log_file.hpp"
#include "plumb/ground_truth_t.hpp"

namespace plumb {
namespace {

constexpr std::size_t kFewestImages = 30;

void refuse(const std::string& log, const LogEvent& event, const char* why) {
  throw InputError(log + ": event " + std::to_string(event.number) + ": " + why);
}

void take_image(const LogEvent& event, ImageDecoder* decoder, RecordedDrive* drive) {
  ImageFrame frame;
  ImageView view;
  const char* why = read_image(event.data, &frame);
  if (why == nullptr) why = decoder->check(frame);
  if (why == nullptr) why = decoder->decode(frame, &view);
  if (why != nullptr) refuse(drive->log, event, why);
  RecordedImage image{frame.capture_us, frame.seq, {}};
  const auto width = static_cast<std::size_t>(view.width_px);
  image.grey.resize(width * static_cast<std::size_t>(view.height_px));
  for (int v = 0; v < view.height_px; ++v)
    std::memcpy(image.grey.data() + static_cast<std::size_t>(v) * width, view.row(v), width);
  drive->images.push_back(std::move(image));
}

}  // namespace

ImageView RecordedDrive::view(std::size_t i) const {
  return {images[i].grey.data(), camera.width_px, camera.height_px, camera.width_px};
}

RecordedDrive read_drive(const std::string& log, std::size_t most_images) {
  RecordedDrive drive;
  drive.log = log;
  LogReader reader(log);
  std::optional<ImageDecoder> decoder;
  LogEvent event;
  while (drive.images.size() < most_images && reader.next(&event)) {
    if (event.channel == kCameraCalibration.name && !decoder) {
      camera_calibration_t message;
      if (!decode_bounded(event.data, &message)) refuse(log, event, "not a camera_calibration_t");
      if (const char* why = from_wire(message, &drive.camera)) refuse(log, event, why);
      decoder.emplace(drive.camera.width_px, drive.camera.height_px);
    }
    if (event.channel == kGroundTruth.name) {
      ground_truth_t truth;
      if (!decode_bounded(event.data, &truth)) refuse(log, event, "not a ground_truth_t");
      drive.has_true_poses |= truth.has_pose != 0;
    }
    if (event.channel != kCamera.name) continue;
    if (!decoder) throw InputError(log + ": an image comes before any " + kCameraCalibration.name);
    take_image(event, &*decoder, &drive);
  }
  if (reader.num_problems() > 0) throw InputError(reader.problems().front());
  if (drive.images.size() < kFewestImages)
    throw InputError(log + ": fewer than " + std::to_string(kFewestImages) + " images");
  return drive;
}

}  // namespace plumb
