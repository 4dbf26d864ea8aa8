#include "modules/ground_paper/paper_ground.hpp"

#include <cmath>

#include "modules/detections/road_plane.hpp"
#include "modules/ground_paper/image_keeper.hpp"
#include "modules/ground_paper/paper_cues.hpp"
#include "modules/ground_paper/paper_plane.hpp"

namespace plumb {
namespace {

// The start wants two frames in a row whose heights agree this well in ln h.
constexpr double kAgreeLnHeight = 0.15;
constexpr double kStartNormalStd = 0.02;
constexpr double kStartHeightRatio = 0.15;
// A correction beyond this factor is an error: the search begins again.
constexpr double kLargestCorrection = 5.0;

}  // namespace

struct PaperGround::Impl {
  /// An older image to compare with.
  struct Reference {
    std::size_t place = ImageKeeper::kNone;
    Se3 T_old_cam;  ///< [m] by metres_per_vo
  };

  Impl(const GroundConfig& ground, const PaperConfig& paper, const DetectionsConfig& detections,
       const CameraModel& camera, const PaperModel& model)
      : config(paper),
        variances{model, ground.covariance == "fixed"},
        height_m(camera_height_of(ground, camera).height_m),
        normal_calibrated(RoadPlane{paper.pitch_rad, paper.roll_rad}.normal_cam()),
        box(region_of(camera, paper.region_width_ratio, paper.region_height_ratio)),
        images(camera.width_px, camera.height_px),
        dense_cue(camera, box, paper.rho),
        matcher(box, ImageKeeper::kCapacity),
        points_cue(camera, normal_calibrated, paper.mu),
        objects_cue(detections, camera, paper.pitch_rad),
        filter({paper.normal_noise_rad, paper.height_noise_m}),
        ego(ground.ego) {}

  std::size_t take_image(const GroundInput& input);
  void take_height(const CameraHeight& height);
  void follow_scale_epoch(const VoOutput& vo);
  PaperFrame measure(const VoOutput& vo, std::size_t place, StageProbe& probe);
  void predict(const VoOutput& vo, PaperFrame* frame);
  [[nodiscard]] Reference choose_reference(const VoOutput& vo) const;
  [[nodiscard]] double find_height(const VoOutput& vo, std::size_t place);
  void search_start(const VoOutput& vo, std::size_t place);
  void fuse(const GroundInput& input, PaperFrame* frame);
  void correct_scale(const CueFusion& fused, PaperFrame* frame);
  [[nodiscard]] bool uses(const char* cue) const {
    return config.cues == "all" || config.cues == cue;
  }

  PaperConfig config;
  PaperVariances variances;
  double height_m;  ///< h*, of the camera over its road
  Eigen::Vector3d normal_calibrated;
  PixelBox box;
  ImageKeeper images;
  PaperDenseCue dense_cue;
  SiftMatcher matcher;
  PaperPointsCue points_cue;
  PaperObjectsCue objects_cue;
  PlaneKalman filter;
  EgoMotion ego;
  std::int32_t scale_epoch = 0;
  bool started = false;
  double metres_per_vo = 0.0;  ///< started only; corrected after every frame that measured a height
  double last_found_vo = 0.0;  ///< height that the last frame's start search found; 0: none
  GroundOutput out;
};

PaperGround::PaperGround(const GroundConfig& config, const PaperConfig& paper,
                         const DetectionsConfig& detections, const CameraModel& camera,
                         const PaperModel& model)
    : impl_(std::make_unique<Impl>(config, paper, detections, camera, model)) {}

PaperGround::~PaperGround() = default;

const GroundOutput& PaperGround::update(const GroundInput& input, StageProbe& probe) {
  Impl& m = *impl_;
  const VoOutput& vo = *input.vo;
  probe.begin();
  m.out.capture_us = vo.capture_us;
  m.out.seq = vo.seq;
  m.out.plane = PlaneOutput{};

  m.follow_scale_epoch(vo);
  if (input.camera_height.height_m > 0.0) m.take_height(input.camera_height);
  const std::size_t place = m.take_image(input);
  probe.mark("features");
  PaperFrame frame = m.measure(vo, place, probe);
  m.fuse(input, &frame);
  write_plane(m.started ? &m.filter : nullptr, frame, m.height_m, &m.out.plane);
  probe.mark("fuse");
  const Eigen::Vector3d normal = m.started ? m.filter.normal() : m.normal_calibrated;
  // A height that was found in a picture that may be upside down is not known yet.
  const bool knows_scale = m.started && vo.reason != VoReason::kOrientationUnproven;
  const ScaleEstimate scale =
      knows_scale ? paper_scale(m.filter, frame, m.metres_per_vo, m.height_m) : ScaleEstimate{};
  m.ego.update(vo, scale, normal, &m.out.ego);
  probe.mark("ego");
  return m.out;
}

/// A car at standstill shows the same view again and again: one of them is enough.
std::size_t PaperGround::Impl::take_image(const GroundInput& input) {
  if (!images.fits(input.image)) return ImageKeeper::kNone;
  const bool stands = input.vo->status == VoStatus::kStandstill;
  const std::size_t place = images.push(input.vo->seq, input.image, stands);
  dense_cue.take(input.image);
  if (uses("points")) matcher.detect(place, input.image);
  return place;
}

/// The scale stays when the body rises or sinks, so that h changes with h*.
void PaperGround::Impl::take_height(const CameraHeight& height) {
  if (started && height.height_m != height_m) {
    filter.hold_height(filter.height() * height.height_m / height_m);
  }
  height_m = height.height_m;
}

void PaperGround::Impl::follow_scale_epoch(const VoOutput& vo) {
  if (vo.scale_epoch == scale_epoch) return;
  scale_epoch = vo.scale_epoch;
  last_found_vo = 0.0;
  if (std::isnan(vo.scale_carry_std)) {
    started = false;
  } else if (started) {
    const double std_m = height_m * vo.scale_carry_std;
    filter.add_height_var(std_m * std_m);
  }
}

PaperFrame PaperGround::Impl::measure(const VoOutput& vo, std::size_t place, StageProbe& probe) {
  PaperFrame frame;
  frame.vo_status = vo.status;
  frame.has_image = place != ImageKeeper::kNone;
  const bool moves = vo.status == VoStatus::kOk && frame.has_image;
  if (!started && moves) search_start(vo, place);
  if (started) predict(vo, &frame);
  Reference reference;
  if (started && moves) reference = choose_reference(vo);
  frame.measurable = reference.place != ImageKeeper::kNone;
  if (frame.measurable && uses("dense")) {
    const Eigen::Vector3d& n = normal_calibrated;
    const PaperDenseMeasurement dense = dense_cue.measure(
        images.view(reference.place), reference.T_old_cam, {n.x(), n.z(), height_m});
    out.plane.cues[kCueDense] = report_of(dense, variances, metres_per_vo);
  }
  probe.mark("dense");
  if (frame.measurable && uses("points")) {
    const PaperPointsMeasurement points =
        points_cue.measure(matcher.match(place, reference.place), reference.T_old_cam);
    out.plane.cues[kCuePoints] = report_of(points, variances, metres_per_vo);
  }
  probe.mark("points");
  return frame;
}

void PaperGround::Impl::predict(const VoOutput& vo, PaperFrame* frame) {
  frame->metres_per_vo = metres_per_vo;
  const bool moves = vo.status == VoStatus::kOk || vo.status == VoStatus::kCoasting;
  if (moves || vo.status == VoStatus::kRotationOnly) {
    const double m = moves ? metres_per_vo : 0.0;
    filter.predict({vo.T_prev_cam.R, m * vo.T_prev_cam.t});
  }
  frame->var_before = filter.cov()(3, 3);
}

/// The previous image, or at low speed the newest one at least `least_step_m` away.
PaperGround::Impl::Reference PaperGround::Impl::choose_reference(const VoOutput& vo) const {
  for (const WindowPose& pose : vo.window) {
    if (metres_per_vo * pose.T_window_cam.t.norm() < config.least_step_m) continue;
    const std::size_t place = images.find(pose.seq);
    if (place == ImageKeeper::kNone) continue;
    return {place, {pose.T_window_cam.R, metres_per_vo * pose.T_window_cam.t}};
  }
  return {};
}

/// The height in [vo] when the unit is not known yet; 0 when the frame does not show it.
double PaperGround::Impl::find_height(const VoOutput& vo, std::size_t place) {
  const std::size_t old_place = images.find(vo.prev_seq);
  double found_vo = 0.0;
  if (uses("dense")) {
    found_vo = dense_cue.search_height(images.view(old_place), vo.T_prev_cam, normal_calibrated);
  }
  if (found_vo == 0.0 && uses("points")) {
    found_vo = points_cue.search_height(matcher.match(place, old_place), vo.T_prev_cam, height_m);
  }
  return found_vo;
}

/// The paper assumes that the scale at the beginning is given. Here two frames in a row have to
/// agree on it.
void PaperGround::Impl::search_start(const VoOutput& vo, std::size_t place) {
  if (images.find(vo.prev_seq) == ImageKeeper::kNone || !(vo.T_prev_cam.t.norm() > 0.0)) return;
  const double found_vo = find_height(vo, place);
  const bool agrees = found_vo > 0.0 && last_found_vo > 0.0 &&
                      std::abs(std::log(found_vo / last_found_vo)) < kAgreeLnHeight;
  last_found_vo = found_vo;
  if (!agrees) return;
  started = true;
  metres_per_vo = height_m / found_vo;
  const double height_std = kStartHeightRatio * height_m;
  filter.start(normal_calibrated, height_m, kStartNormalStd * kStartNormalStd,
               height_std * height_std);
}

void PaperGround::Impl::fuse(const GroundInput& input, PaperFrame* frame) {
  if (!started) return;
  CueFusion fused;
  if (input.due.frame != nullptr && uses("objects")) {
    out.plane.cues[kCueObjects] = add_objects(objects_cue.measure(*input.due.frame, height_m),
                                              input.due.R_newest_due, variances, &fused);
  }
  const CueReport& dense = out.plane.cues[kCueDense];
  add_report(dense, frame->metres_per_vo, &fused);
  if (dense.status != CueStatus::kUsed && frame->measurable) {
    // The points take the pitch from the calibration: nothing else is known of the normal now.
    fused.add(kN1, normal_calibrated.x(), kStartNormalStd * kStartNormalStd);
    fused.add(kN3, normal_calibrated.z(), kStartNormalStd * kStartNormalStd);
  }
  add_report(out.plane.cues[kCuePoints], frame->metres_per_vo, &fused);
  filter.observe(fused);
  correct_scale(fused, frame);
}

/// s = h / h*: VO's unit is s times what it was taken for. Without a height in this frame, the
/// scale and h stay.
void PaperGround::Impl::correct_scale(const CueFusion& fused, PaperFrame* frame) {
  frame->measured = fused.observes(kH);
  if (!frame->measured) {
    filter.hold_height(height_m);
    return;
  }
  const double s = filter.height() / height_m;
  if (!(s < kLargestCorrection && s > 1.0 / kLargestCorrection)) {
    started = frame->measured = false;
    last_found_vo = 0.0;
    return;
  }
  frame->height_m = fused.value(kH) / s;
  frame->height_var = fused.var(kH) / (height_m * height_m);
  metres_per_vo /= s;
  filter.divide_unit(s);
}

}  // namespace plumb
