#include "modules/camera/device_source.hpp"

#include <algorithm>
#include <cmath>

#include "platform/log.hpp"
#include "platform/process.hpp"

namespace plumb {
namespace {

PixelFormat format_of(const std::string& fourcc) {
  if (fourcc == "YUYV") return PixelFormat::kYuyv;
  if (fourcc == "NV12") return PixelFormat::kNv12;
  if (fourcc == "MJPG") return PixelFormat::kMjpeg;
  return PixelFormat::kGrey;
}

V4l2Request request_of(const CameraConfig& config, const std::string& device) {
  V4l2Request request;
  request.device = device;
  // The cheapest format comes first: a luma plane is used in place, packed luma is copied, and
  // MJPEG is decoded.
  request.fourccs = {"GREY", "NV12", "YUYV", "MJPG"};
  if (config.pixel_format != "auto") request.fourccs = {config.pixel_format};
  request.width_px = config.width_px;
  request.height_px = config.height_px;
  request.rate_hz = config.rate_hz;
  request.num_buffers = config.num_buffers;
  return request;
}

}  // namespace

DeviceSource::DeviceSource(const CameraConfig& config, const std::string& device)
    : request_(request_of(config, device)),
      stamp_offset_us_(std::llround(config.stamp_offset_s * 1e6)) {}

void DeviceSource::open_first(CameraConfig* config) {
  if (!camera_.open(request_)) throw UsageError(camera_.why());
  const V4l2Format& format = camera_.format();
  request_.width_px = config->width_px = format.width_px;
  request_.height_px = config->height_px = format.height_px;
  jpeg_.emplace(format.width_px, format.height_px);
  grey_.resize(static_cast<std::size_t>(format.width_px) *
               static_cast<std::size_t>(format.height_px));
  prepare();
}

bool DeviceSource::reopen() {
  if (!camera_.open(request_)) {
    why_ = camera_.why();
    return false;
  }
  reopened_ = true;
  prepare();
  return true;
}

void DeviceSource::prepare() {
  const V4l2Format& format = camera_.format();
  format_ = format_of(format.fourcc);
  log_line("%s: %s, %s %dx%d, %.4g frames/s, %d buffers", request_.device.c_str(),
           format.card.c_str(), format.fourcc.c_str(), format.width_px, format.height_px,
           format.rate_hz, format.num_buffers);
}

void DeviceSource::give_up(const std::string& why) {
  why_ = why;
  camera_.close();
}

DeviceStep DeviceSource::take(GreyFrame* frame) {
  V4l2Frame raw;
  const V4l2Status status = camera_.take(&raw);
  if (status == V4l2Status::kNothing) return DeviceStep::kNothing;
  if (status == V4l2Status::kGone || status == V4l2Status::kFailed) {
    give_up(camera_.why());
    return DeviceStep::kLost;
  }
  if (!raw.stamped_by_driver)
    log_limited("the driver gives no capture time; the arrival time is used");
  const std::int64_t capture_us = raw.stamp_us + stamp_offset_us_;
  count_silence(capture_us);
  const std::int64_t seq = sequence_.next(raw.sequence);
  if (status == V4l2Status::kCorrupt) return reject("the driver marks a frame as damaged");
  // The time is compared with the newest stamp, rejected or not, so that a clock that was set back
  // costs only one frame.
  const bool backwards = has_last_ && capture_us <= last_capture_us_;
  has_last_ = true;
  last_capture_us_ = capture_us;
  if (backwards) return reject("capture time runs backwards");
  frame->capture_us = capture_us;
  frame->seq = seq;
  if (const char* why = to_grey(raw, &frame->image)) return reject(why);
  return DeviceStep::kFrame;
}

DeviceStep DeviceSource::reject(const char* why) {
  rejection_ = why;
  return DeviceStep::kRejected;
}

void DeviceSource::count_silence(std::int64_t capture_us) {
  if (!reopened_) return;
  reopened_ = false;
  const double rate_hz = camera_.format().rate_hz;
  const double silence_s =
      has_last_ ? static_cast<double>(capture_us - last_capture_us_) * 1e-6 : 0.0;
  // The gap is at least one frame, so that every reader notices the interruption.
  sequence_.restart(std::max<std::int64_t>(1, std::llround(silence_s * rate_hz) - 1));
}

const char* DeviceSource::to_grey(const V4l2Frame& raw, ImageView* image) {
  const V4l2Format& format = camera_.format();
  if (format_ == PixelFormat::kMjpeg) {
    ImageFrame jpeg;
    jpeg.width_px = format.width_px;
    jpeg.height_px = format.height_px;
    jpeg.compressed = true;
    jpeg.data = raw.bytes;
    return jpeg_->decode(jpeg, image);
  }
  const std::size_t stride =
      std::max(format.stride_bytes, required_stride(format_, format.width_px));
  if (raw.bytes.size() < required_bytes(format_, format.height_px, stride))
    return "a frame is cut off";
  *image = luma_plane(format_, raw.bytes.data(), format.width_px, format.height_px, stride);
  if (!image->empty()) return nullptr;
  yuyv_to_grey(raw.bytes.data(), format.width_px, format.height_px, stride, grey_.data());
  *image = {grey_.data(), format.width_px, format.height_px, format.width_px};
  return nullptr;
}

}  // namespace plumb
