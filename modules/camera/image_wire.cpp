#include "modules/camera/image_wire.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string_view>

#include "modules/camera/image_queue_config.hpp"
#include "platform/bounded_decode.hpp"

namespace plumb {
namespace {

constexpr int kMinSide_px = 64;
constexpr int kMaxSide_px = 8192;
constexpr int kMaxMetadata = 16;
constexpr std::string_view kSeqKey = "seq";
constexpr std::string_view kSessionKey = "session";

bool is_key(std::span<const std::uint8_t> text, std::string_view key) {
  return text.size() == key.size() && std::memcmp(text.data(), key.data(), key.size()) == 0;
}

const char* read_metadata(WireCursor* cursor, ImageFrame* frame) {
  const std::int32_t count = cursor->i32();
  if (!cursor->ok() || count < 0 || count > kMaxMetadata) return "image metadata does not decode";
  bool has_seq = false;
  frame->session = 0;
  for (std::int32_t i = 0; i < count; ++i) {
    const auto key = cursor->text();
    const auto value = cursor->take(cursor->i32());
    if (!cursor->ok()) return "image metadata does not decode";
    const bool is_seq = is_key(key, kSeqKey);
    if (!is_seq && !is_key(key, kSessionKey)) continue;
    if (value.size() != 8) return "image metadata 'seq' or 'session' is not 8 bytes";
    (is_seq ? frame->seq : frame->session) = WireCursor(value).i64();
    has_seq = has_seq || is_seq;
  }
  return has_seq ? nullptr : "image has no sequence number ('seq' metadata)";
}

const char* check_layout(const ImageFrame& frame, std::int32_t format) {
  if (frame.width_px < 1 || frame.width_px > kMaxSide_px || frame.height_px < 1 ||
      frame.height_px > kMaxSide_px) {
    return "image size is outside [1, 8192]";
  }
  if (format == image_t::PIXEL_FORMAT_MJPEG) {
    return frame.data.empty() ? "compressed image is empty" : nullptr;
  }
  if (format != image_t::PIXEL_FORMAT_GRAY) return "pixel format is neither 8-bit grey nor MJPEG";
  const std::size_t stride = static_cast<std::size_t>(std::max(frame.row_stride_bytes, 0));
  if (frame.row_stride_bytes < frame.width_px ||
      frame.data.size() != stride * static_cast<std::size_t>(frame.height_px)) {
    return "image data length, row stride and size contradict each other";
  }
  return nullptr;
}

void fill_number(std::string_view key, std::int64_t number, image_metadata_t* entry) {
  entry->key = key;
  entry->n = 8;
  entry->value.resize(8);
  for (std::size_t i = 0; i < 8; ++i) {
    entry->value[i] =
        static_cast<std::uint8_t>(static_cast<std::uint64_t>(number) >> (8U * (7U - i)));
  }
}

void fill(std::int64_t capture_us, std::int64_t seq, std::int64_t session, int width_px,
          int height_px, image_t* message) {
  message->utime = capture_us;
  message->width = width_px;
  message->height = height_px;
  message->size = static_cast<std::int32_t>(message->data.size());
  message->nmetadata = session == 0 ? 1 : 2;
  message->metadata.resize(static_cast<std::size_t>(message->nmetadata));
  fill_number(kSeqKey, seq, &message->metadata.front());
  if (session != 0) fill_number(kSessionKey, session, &message->metadata.back());
}

// Checks width and height in the header of the JPEG, before the decoder allocates for them.
bool jpeg_has_size(std::span<const std::uint8_t> jpeg, int width_px, int height_px) {
  if (jpeg.size() < 4 || jpeg[0] != 0xFF || jpeg[1] != 0xD8) return false;
  std::size_t at = 2;
  while (at + 9 <= jpeg.size() && jpeg[at] == 0xFF) {
    const unsigned marker = jpeg[at + 1];
    const bool frame_header =
        marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
    if (frame_header) {
      return (jpeg[at + 5] << 8U | jpeg[at + 6]) == height_px &&
             (jpeg[at + 7] << 8U | jpeg[at + 8]) == width_px;
    }
    at += 2 + static_cast<std::size_t>(jpeg[at + 2] << 8U | jpeg[at + 3]);
  }
  return false;
}

// libjpeg fills missing rows with grey and reports success, so the end marker is checked here. Many
// cameras append zeros to it.
bool jpeg_is_complete(std::span<const std::uint8_t> jpeg) {
  while (!jpeg.empty() && jpeg.back() == 0) jpeg = jpeg.first(jpeg.size() - 1);
  return jpeg.size() >= 4 && jpeg[jpeg.size() - 2] == 0xFF && jpeg.back() == 0xD9;
}

}  // namespace

const char* read_image(std::span<const std::uint8_t> bytes, ImageFrame* frame) {
  WireCursor cursor(bytes);
  if (cursor.i64() != image_t::getHash()) return "not an image_t";
  frame->capture_us = cursor.i64();
  frame->width_px = cursor.i32();
  frame->height_px = cursor.i32();
  frame->row_stride_bytes = cursor.i32();
  const std::int32_t format = cursor.i32();
  frame->compressed = format == image_t::PIXEL_FORMAT_MJPEG;
  frame->data = cursor.take(cursor.i32());
  if (!cursor.ok()) return "image data is cut off or its length is corrupt";
  if (const char* why = read_metadata(&cursor, frame)) return why;
  if (!cursor.at_end()) return "bytes follow the image";
  return check_layout(*frame, format);
}

void to_wire(std::int64_t capture_us, std::int64_t seq, const ImageView& image, image_t* message,
             std::int64_t session) {
  const auto width = static_cast<std::size_t>(image.width_px);
  message->data.resize(width * static_cast<std::size_t>(image.height_px));
  for (int v = 0; v < image.height_px; ++v)
    std::memcpy(message->data.data() + static_cast<std::size_t>(v) * width, image.row(v), width);
  message->row_stride = image.width_px;
  message->pixelformat = image_t::PIXEL_FORMAT_GRAY;
  fill(capture_us, seq, session, image.width_px, image.height_px, message);
}

void to_wire_jpeg(std::int64_t capture_us, std::int64_t seq, int width_px, int height_px,
                  std::span<const std::uint8_t> jpeg, image_t* message) {
  message->data.assign(jpeg.begin(), jpeg.end());
  message->row_stride = 0;
  message->pixelformat = image_t::PIXEL_FORMAT_MJPEG;
  fill(capture_us, seq, 0, width_px, height_px, message);
}

camera_calibration_t to_wire(const CameraModel& camera, std::int64_t utime) {
  camera_calibration_t message{};
  message.utime = utime;
  message.width = camera.width_px;
  message.height = camera.height_px;
  message.fx_px = camera.fx_px;
  message.fy_px = camera.fy_px;
  message.cx_px = camera.cx_px;
  message.cy_px = camera.cy_px;
  message.residual_k1 = camera.residual_k1;
  message.residual_k2 = camera.residual_k2;
  message.readout_s = camera.readout_s;
  message.camera_height_m = camera.camera_height_m;
  return message;
}

const char* from_wire(const camera_calibration_t& message, CameraModel* camera) {
  const auto inside = [](double value, double low, double high) {
    return value >= low && value <= high;  // false for NaN
  };
  if (message.width < kMinSide_px || message.width > kMaxSide_px || message.height < kMinSide_px ||
      message.height > kMaxSide_px) {
    return "calibration: image size is outside [64, 8192]";
  }
  if (std::int64_t{message.width} * message.height > ImageQueueConfig::kMaxPixels)
    return "calibration: the images have more pixels than 1920 x 1200";
  if (!inside(message.fx_px, 1.0, 1e5) || !inside(message.fy_px, 1.0, 1e5))
    return "calibration: focal length is outside [1, 100000]";
  if (!inside(message.cx_px, -0.5, message.width - 0.5) ||
      !inside(message.cy_px, -0.5, message.height - 0.5)) {
    return "calibration: principal point is outside the image";
  }
  if (!inside(message.residual_k1, -0.5, 0.5)) return "calibration: k1 is outside [-0.5, 0.5]";
  if (!inside(message.residual_k2, -0.5, 0.5)) return "calibration: k2 is outside [-0.5, 0.5]";
  if (!inside(message.readout_s, 0.0, 0.1)) return "calibration: readout is outside [0, 0.1] s";
  if (message.camera_height_m != 0.0 && !inside(message.camera_height_m, 0.3, 4.0))
    return "calibration: camera height is neither 0 nor in [0.3, 4]";
  *camera = {message.width,           message.height,   message.fx_px,       message.fy_px,
             message.cx_px,           message.cy_px,    message.residual_k1, message.residual_k2,
             message.camera_height_m, message.readout_s};
  return nullptr;
}

bool same_camera(const CameraModel& a, const CameraModel& b) {
  return a.width_px == b.width_px && a.height_px == b.height_px && a.fx_px == b.fx_px &&
         a.fy_px == b.fy_px && a.cx_px == b.cx_px && a.cy_px == b.cy_px &&
         a.residual_k1 == b.residual_k1 && a.residual_k2 == b.residual_k2 &&
         a.camera_height_m == b.camera_height_m && a.readout_s == b.readout_s;
}

ImageDecoder::ImageDecoder(int width_px, int height_px)
    : width_px_(width_px), height_px_(height_px) {}

const char* ImageDecoder::check(const ImageFrame& frame) const {
  return frame.width_px == width_px_ && frame.height_px == height_px_
             ? nullptr
             : "image size differs from the calibration";
}

const char* ImageDecoder::decode(const ImageFrame& frame, ImageView* view) {
  if (const char* why = check(frame)) return why;
  if (!frame.compressed) {
    *view = {frame.data.data(), width_px_, height_px_, frame.row_stride_bytes};
    return nullptr;
  }
  if (!jpeg_has_size(frame.data, width_px_, height_px_)) return "JPEG header contradicts the image";
  if (!jpeg_is_complete(frame.data)) return "JPEG is cut off";
  if (!jpeg_) jpeg_.emplace(width_px_, height_px_);
  return jpeg_->decode(frame.data, view);
}

}  // namespace plumb
