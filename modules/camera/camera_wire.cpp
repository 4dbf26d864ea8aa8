#include "modules/camera/camera_wire.hpp"

namespace plumb {
namespace {

constexpr const char* kSeqKey = "seq";
constexpr std::size_t kSeqBytes = 8;

}  // namespace

ImageMessage::ImageMessage(int width_px, int height_px) : message_{} {
  message_.width = width_px;
  message_.height = height_px;
  message_.row_stride = width_px;
  message_.pixelformat = image_t::PIXEL_FORMAT_GRAY;
  message_.size = width_px * height_px;
  message_.data.resize(static_cast<std::size_t>(message_.size));
  message_.nmetadata = 1;
  message_.metadata.resize(1);
  message_.metadata[0].key = kSeqKey;
  message_.metadata[0].n = static_cast<std::int32_t>(kSeqBytes);
  message_.metadata[0].value.resize(kSeqBytes);
}

const image_t& ImageMessage::stamped(std::int64_t capture_us, std::int64_t seq) {
  message_.utime = capture_us;
  for (std::size_t i = 0; i < kSeqBytes; ++i) {
    const std::size_t shift = 8 * (kSeqBytes - 1 - i);
    message_.metadata[0].value[i] =
        static_cast<std::uint8_t>(static_cast<std::uint64_t>(seq) >> shift);
  }
  return message_;
}

std::size_t ImageMessage::encoded_bytes() const {
  return static_cast<std::size_t>(message_.getEncodedSize());
}

bool read_seq(const image_t& message, std::int64_t* seq) {
  for (const image_metadata_t& entry : message.metadata) {
    if (entry.key != kSeqKey || entry.value.size() != kSeqBytes) continue;
    std::uint64_t bits = 0;
    for (const std::uint8_t byte : entry.value) bits = bits << 8 | byte;
    *seq = static_cast<std::int64_t>(bits);
    return true;
  }
  return false;
}

camera_calibration_t to_wire(const CameraModel& model, std::int64_t capture_us) {
  camera_calibration_t message{};
  message.utime = capture_us;
  message.width = model.width_px;
  message.height = model.height_px;
  message.fx_px = model.fx_px;
  message.fy_px = model.fy_px;
  message.cx_px = model.cx_px;
  message.cy_px = model.cy_px;
  message.residual_k1 = model.residual_k1;
  message.camera_height_m = model.camera_height_m;
  return message;
}

}  // namespace plumb
