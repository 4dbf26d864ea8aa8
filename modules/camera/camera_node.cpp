#include "modules/camera/camera_node.hpp"

#include "modules/camera/image_wire.hpp"
#include "modules/camera/mask_source.hpp"
#include "platform/process.hpp"

namespace plumb {
namespace {

/// Reads the mask file. Returns an empty mask without a file.
MaskPicture read_mask(const CameraConfig& config, const std::filesystem::path& folder) {
  if (config.mask_file.empty()) return {};
  const std::string file = (folder / config.mask_file).string();
  MaskPicture mask = read_mask_picture(file);
  if (mask.empty()) throw UsageError("camera.mask_file: cannot read " + file + " as PGM or PNG");
  if (mask.width_px != config.width_px || mask.height_px != config.height_px) {
    throw UsageError("camera.mask_file: " + file + " is " + std::to_string(mask.width_px) + "x" +
                     std::to_string(mask.height_px) + ", the images are " +
                     std::to_string(config.width_px) + "x" + std::to_string(config.height_px));
  }
  return mask;
}

FrontEnd make_front_end(const CameraConfig& config, const std::filesystem::path& folder) {
  const MaskPicture mask = read_mask(config, folder);
  const std::uint8_t* marked = mask.empty() ? nullptr : mask.marked.data();
  const std::string why = why_unusable(config, config.width_px, config.height_px, marked);
  if (!why.empty()) throw UsageError(why);
  return {config, config.width_px, config.height_px, marked};
}

}  // namespace

CameraNode::CameraNode(const CameraConfig& config, const std::filesystem::path& folder,
                       StageProbe* probe, std::int64_t session)
    : model_(published_model(config, config.width_px, config.height_px)),
      probe_(probe),
      session_(session),
      front_end_(make_front_end(config, folder)),
      published_(static_cast<std::size_t>(config.width_px) *
                 static_cast<std::size_t>(config.height_px)) {}

const image_t& CameraNode::take(const GreyFrame& frame) {
  fault_ = front_end_.process(frame.image, published_.data(), probe_);
  const ImageView image{published_.data(), model_.width_px, model_.height_px, model_.width_px};
  to_wire(frame.capture_us, frame.seq, image, &message_, session_);
  probe_->mark("to_wire");
  return message_;
}

camera_calibration_t CameraNode::calibration(std::int64_t capture_us) const {
  return to_wire(model_, capture_us);
}

std::size_t CameraNode::max_bytes() const { return max_image_bytes(published_.size()); }

}  // namespace plumb
