#include "modules/vo/vo_node.hpp"

#include <cstring>
#include <filesystem>

#include "core/principal_point.hpp"
#include "modules/integrity/stamp_difference.hpp"
#include "platform/config.hpp"
#include "platform/log.hpp"

namespace plumb {
namespace {

constexpr std::int64_t kKeepPeriod_us = 30'000'000;
// More than a dashboard and a bonnet take of a picture that is well aimed.
constexpr float kMuchAttached = 0.4F;

}  // namespace

VoNode::VoNode(const VoConfig& config, std::uint64_t seed, StageProbe* probe,
               const IntegrityConfig& integrity)
    : config_(config), integrity_(integrity), seed_(seed), probe_(probe) {}

VoNode::~VoNode() {
  if (attached_file_) attached_file_->save(estimator_->attached());
}

void VoNode::configure_camera(const CameraModel& camera) {
  calibration_.configure(camera);
  build();
}

const char* VoNode::take_calibration(const camera_calibration_t& message) {
  const char* refused = calibration_.take(message);
  build();
  return refused;
}

/// Makes everything that depends on the camera, when another one holds.
void VoNode::build() {
  if (!calibration_.take_change()) return;
  const CameraModel& camera = calibration_.camera();
  decoder_.emplace(camera.width_px, camera.height_px);
  judge_.emplace(integrity_, camera.width_px, camera.height_px);
  estimator_.emplace(config_, camera, seed_);
  restore_attached();
}

void VoNode::restore_attached() {
  if (config_.state_file.empty()) return;
  const CameraModel& camera = calibration_.camera();
  attached_file_.emplace(config_.state_file, camera.width_px, camera.height_px);
  std::error_code unknown;
  if (!std::filesystem::exists(config_.state_file, unknown) && !unknown) return;
  try {
    load_attached_regions(config_.state_file, camera.width_px, camera.height_px,
                          &estimator_->attached());
  } catch (const ConfigError& error) {
    log_warning("%s; what is attached to the camera will be learned again", error.what());
  }
}

/// Writes what is attached to the camera, now and then.
void VoNode::keep_attached() {
  if (!attached_file_) return;
  const std::int64_t passed_us = stamp_difference(motion_.utime, kept_us_);
  if (passed_us >= 0 && passed_us < kKeepPeriod_us) return;  // a clock may go back
  if (kept_us_ != 0) {
    if (const int error = attached_file_->error())
      log_warning("cannot write %s: %s", attached_file_->path().c_str(), std::strerror(error));
    attached_file_->save(estimator_->attached());
  }
  kept_us_ = motion_.utime;
}

const char* VoNode::take_image(std::span<const std::uint8_t> image_bytes, std::int64_t arrival_us) {
  fresh_ = false;
  probe_->begin();
  ImageFrame frame;
  if (const char* why = read_image(image_bytes, &frame)) return why;
  if (!calibrated()) return publish_without_calibration(frame);
  if (const char* why = decoder_->check(frame)) return why;
  if (const char* why = judge_->judge_time(frame, arrival_us)) return why;
  ImageView image;
  if (const char* why = decoder_->decode(frame, &image)) return why;
  probe_->mark("decode");
  const VoInput input = judge_->judge_picture(image);
  probe_->mark("judge");
  to_wire(estimator_->update(input, *probe_), &motion_);
  judge_->complete(&motion_);
  if (calibration_.is_doubted()) {
    motion_.status = vo_motion_t::STATUS_LOST;
    motion_.reason = vo_motion_t::REASON_CALIBRATION_DOUBTED;
  }
  motion_.session = session_;
  keep_attached();
  probe_->mark("to_wire");
  fresh_ = true;
  return nullptr;
}

const char* VoNode::concern() const {
  if (motion_.reason == vo_motion_t::REASON_IMAGE_UPSIDE_DOWN) return "the picture is upside down";
  if (calibrated() && !is_principal_point_central(calibration_.camera())) {
    return kPrincipalPointIsOff;
  }
  if (motion_.attached_share > kMuchAttached)
    return "much of the picture shows what is attached to the camera";
  return nullptr;
}

const char* VoNode::publish_without_calibration(const ImageFrame& frame) {
  VoOutput output;
  output.capture_us = frame.capture_us;
  output.seq = frame.seq;
  output.reason = VoReason::kNoCalibration;
  to_wire(output, &motion_);
  motion_.session = session_;
  fresh_ = true;
  return "image came before a calibration";
}

}  // namespace plumb
