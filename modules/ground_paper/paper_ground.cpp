#include "modules/ground_paper/paper_ground.hpp"

#include <algorithm>
#include <cmath>

#include "modules/detections/road_plane.hpp"
#include "modules/ground/ego/ego_motion.hpp"
#include "modules/ground/filter/plane_angles.hpp"
#include "modules/ground_paper/cue_fusion.hpp"
#include "modules/ground_paper/image_keeper.hpp"
#include "modules/ground_paper/paper_dense_cue.hpp"
#include "modules/ground_paper/paper_points_cue.hpp"
#include "modules/ground_paper/plane_kalman.hpp"

namespace plumb {
namespace {

// The start wants two frames in a row whose heights agree this well in ln h.
constexpr double kAgreeLnHeight = 0.15;
constexpr double kStartNormalStd = 0.02;
constexpr double kStartHeightRatio = 0.15;
// A correction beyond this factor is none: the search begins anew.
constexpr double kLargestCorrection = 5.0;

}  // namespace

struct PaperGround::Impl {
  Impl(const GroundConfig& config_in, const CameraModel& camera_in, const PaperModel& model_in)
      : config(config_in),
        camera(camera_in),
        model(model_in),
        height_m(camera_height_of(config, camera)),
        normal_calibrated(RoadPlane{config.paper.pitch_rad, config.paper.roll_rad}.normal_cam()),
        box(region_of(camera, config.paper.region_width_ratio, config.paper.region_height_ratio)),
        images(camera.width_px, camera.height_px),
        dense_cue(camera, box, config.paper.rho),
        matcher(box, ImageKeeper::kCapacity),
        points_cue(camera, normal_calibrated, config.paper.mu),
        filter({config.paper.normal_noise_rad, config.paper.height_noise_m}) {}

  void take_image(const GroundInput& input);
  void follow_scale_epoch(const VoOutput& vo);
  void measure(const VoOutput& vo, StageProbe& probe);
  void predict(const VoOutput& vo);
  bool choose_reference(const VoOutput& vo);
  void search_start(const VoOutput& vo);
  void fuse(const GroundInput& input);
  void correct_scale(const CueFusion& fused);
  void write_dense(const PaperDenseObservation& dense);
  void write_points(const PaperPointsObservation& points);
  void write_objects(std::span<const ObjectNormal> objects, CueFusion* fused);
  void write_plane(const VoOutput& vo);
  [[nodiscard]] GroundReason reason_held(const VoOutput& vo) const;
  [[nodiscard]] ScaleEstimate scale() const;
  [[nodiscard]] bool uses(const char* cue) const {
    return config.cues == "all" || config.cues == cue;
  }
  [[nodiscard]] double var_of(const LinearVariance& line, double belief) const {
    return config.covariance == "fixed" ? line.mean : line.of(belief);
  }

  GroundConfig config;
  CameraModel camera;
  PaperModel model;
  double height_m;  ///< h*, of the camera over its road
  Eigen::Vector3d normal_calibrated;
  PixelBox box;
  ImageKeeper images;
  PaperDenseCue dense_cue;
  SiftMatcher matcher;
  PaperPointsCue points_cue;
  PlaneKalman filter;
  EgoMotion ego;
  std::int32_t scale_epoch = 0;
  bool started = false;
  double metres_per_vo = 0.0;  ///< started only; corrected after every frame that saw a height
  double last_found_vo = 0.0;  ///< height that the last frame's start search found; 0: none
  GroundOutput out;

  /// What this frame brought; cleared at its begin.
  struct Frame {
    bool has_image = false;
    bool searched = false;  ///< an older image at a distance that tells depth
    std::size_t place = ImageKeeper::kNone;
    std::size_t old_place = ImageKeeper::kNone;
    Se3 T_old_cam;               ///< [m] by metres_per_vo
    double metres_per_vo = 0.0;  ///< that the cues' heights refer to
    bool measured = false;       ///< a height entered the filter
    double height_m = 0.0;       ///< fused observation, at the corrected scale
    double height_var = 0.0;     ///< its variance over the square of h*
    double var_before = 0.0;     ///< of h, before the cues
  };
  Frame frame;
};

PaperGround::PaperGround(const GroundConfig& config, const CameraModel& camera,
                         const PaperModel& model)
    : impl_(std::make_unique<Impl>(config, camera, model)) {}

PaperGround::~PaperGround() = default;

const GroundOutput& PaperGround::update(const GroundInput& input, StageProbe& probe) {
  Impl& m = *impl_;
  const VoOutput& vo = *input.vo;
  probe.begin();
  m.frame = Impl::Frame{};
  m.out.capture_us = vo.capture_us;
  m.out.seq = vo.seq;
  m.out.plane = PlaneOutput{};
  m.out.plane.cues.fill(absent_cue());

  m.follow_scale_epoch(vo);
  m.take_image(input);
  probe.mark("features");
  m.measure(vo, probe);
  m.fuse(input);
  m.write_plane(vo);
  probe.mark("fuse");
  const Eigen::Vector3d normal = m.started ? m.filter.normal() : m.normal_calibrated;
  m.ego.update(vo, m.scale(), normal, &m.out.ego);
  probe.mark("ego");
  return m.out;
}

/// A car that stands shows the same view again and again: one of them is enough.
void PaperGround::Impl::take_image(const GroundInput& input) {
  frame.has_image = images.fits(input.image);
  if (!frame.has_image) return;
  const bool stands = input.vo->status == VoStatus::kStandstill;
  frame.place = images.push(input.vo->seq, input.image, stands);
  dense_cue.take(input.image);
  if (uses("points")) matcher.detect(frame.place, input.image);
}

void PaperGround::Impl::follow_scale_epoch(const VoOutput& vo) {
  if (vo.scale_epoch == scale_epoch) return;
  scale_epoch = vo.scale_epoch;
  last_found_vo = 0.0;
  if (std::isnan(vo.scale_carry_std)) {
    started = false;
  } else if (started) {
    const double std_m = height_m * vo.scale_carry_std;
    filter.doubt_height(std_m * std_m);
  }
}

void PaperGround::Impl::measure(const VoOutput& vo, StageProbe& probe) {
  const bool moves = vo.status == VoStatus::kOk && frame.has_image;
  if (!started && moves) search_start(vo);
  if (started) predict(vo);
  frame.searched = started && moves && choose_reference(vo);
  if (frame.searched && uses("dense")) {
    const Eigen::Vector3d& n = normal_calibrated;
    const ImageView old_image = images.view(frame.old_place);
    write_dense(dense_cue.measure(old_image, frame.T_old_cam, {n.x(), n.z(), height_m}));
  }
  probe.mark("dense");
  if (frame.searched && uses("points")) {
    write_points(points_cue.measure(matcher.match(frame.place, frame.old_place), frame.T_old_cam));
  }
  probe.mark("points");
}

void PaperGround::Impl::predict(const VoOutput& vo) {
  frame.metres_per_vo = metres_per_vo;
  const bool moves = vo.status == VoStatus::kOk || vo.status == VoStatus::kCoasting;
  if (moves || vo.status == VoStatus::kRotationOnly) {
    const double m = moves ? metres_per_vo : 0.0;
    filter.predict({vo.T_prev_cam.R, m * vo.T_prev_cam.t});
  }
  frame.var_before = filter.cov()(3, 3);
}

/// The previous image, or at low speed the newest one at least `least_step_m` away.
bool PaperGround::Impl::choose_reference(const VoOutput& vo) {
  for (const WindowPose& pose : vo.window) {
    if (metres_per_vo * pose.T_window_cam.t.norm() < config.paper.least_step_m) continue;
    const std::size_t place = images.find(pose.seq);
    if (place == ImageKeeper::kNone) continue;
    frame.old_place = place;
    frame.T_old_cam = {pose.T_window_cam.R, metres_per_vo * pose.T_window_cam.t};
    return true;
  }
  return false;
}

/// The paper takes the scale at the beginning as given; here two frames in a row have to agree.
void PaperGround::Impl::search_start(const VoOutput& vo) {
  const std::size_t old_place = images.find(vo.prev_seq);
  if (old_place == ImageKeeper::kNone || !(vo.T_prev_cam.t.norm() > 0.0)) return;
  double found_vo = 0.0;
  if (uses("dense")) {
    found_vo = dense_cue.search_height(images.view(old_place), vo.T_prev_cam, normal_calibrated);
  }
  if (found_vo == 0.0 && uses("points")) {
    found_vo =
        points_cue.search_height(matcher.match(frame.place, old_place), vo.T_prev_cam, height_m);
  }
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

void PaperGround::Impl::write_dense(const PaperDenseObservation& dense) {
  CueObservation& cue = out.plane.cues[kCueDense];
  cue.status = dense.ok ? CueStatus::kUsed : CueStatus::kFailed;
  if (!dense.ok) return;
  const double m = frame.metres_per_vo;
  cue.n1 = dense.z(kN1);
  cue.n3 = dense.z(kN3);
  cue.height = dense.z(kH) / m;
  cue.n1_var = var_of(model.dense_n1, dense.width(kN1));
  cue.n3_var = var_of(model.dense_n3, dense.width(kN3));
  const double height_var = var_of(model.dense_h, dense.width(kH));
  cue.height_var = height_var / (m * m);
  cue.quality = std::min(1.0, model.dense_h.least / height_var);
  cue.features = {dense.width(kH), dense.width(kN1), dense.width(kN3)};
  cue.num_features = 3;
}

void PaperGround::Impl::write_points(const PaperPointsObservation& points) {
  if (points.num_matches == 0) return;
  CueObservation& cue = out.plane.cues[kCuePoints];
  cue.status = points.ok ? CueStatus::kUsed : CueStatus::kFailed;
  if (!points.ok) return;
  const double m = frame.metres_per_vo;
  const double height_var = var_of(model.points_h, points.score);
  cue.height = points.height / m;
  cue.height_var = height_var / (m * m);
  cue.quality = std::min(1.0, model.points_h.least / height_var);
  cue.features = {points.score};
  cue.num_features = 1;
}

/// Every object is a cue of its own; the one that is reported stands for all of them.
void PaperGround::Impl::write_objects(std::span<const ObjectNormal> objects, CueFusion* fused) {
  CueFusion together;
  for (const ObjectNormal& object : objects) {
    if (!std::isfinite(object.n3) || !(object.n3_var > 0.0)) continue;
    together.add(kN3, object.n3, object.n3_var);
    fused->add(kN3, object.n3, object.n3_var);
  }
  if (!together.observes(kN3)) return;
  CueObservation& cue = out.plane.cues[kCueObjects];
  cue.status = CueStatus::kUsed;
  cue.n3 = together.value(kN3);
  cue.n3_var = together.var(kN3);
  cue.quality = objects.front().quality;
  cue.features = {objects.front().belief};
  cue.num_features = 1;
}

void PaperGround::Impl::fuse(const GroundInput& input) {
  if (!started) return;
  CueFusion fused;
  write_objects(input.objects, &fused);
  const double m = frame.metres_per_vo;
  const CueObservation& dense = out.plane.cues[kCueDense];
  if (dense.status == CueStatus::kUsed) {
    fused.add(kN1, dense.n1, dense.n1_var);
    fused.add(kN3, dense.n3, dense.n3_var);
    fused.add(kH, m * dense.height, m * m * dense.height_var);
  } else if (frame.searched) {
    // Points take the pitch from calibration; it is all that is known of the normal now.
    fused.add(kN1, normal_calibrated.x(), kStartNormalStd * kStartNormalStd);
    fused.add(kN3, normal_calibrated.z(), kStartNormalStd * kStartNormalStd);
  }
  const CueObservation& points = out.plane.cues[kCuePoints];
  if (points.status == CueStatus::kUsed) {
    fused.add(kH, m * points.height, m * m * points.height_var);
  }
  filter.observe(fused);
  correct_scale(fused);
}

/// s = h / h*: VO's unit is s times what it was taken for. Without a height in this frame, the
/// scale and h stay.
void PaperGround::Impl::correct_scale(const CueFusion& fused) {
  frame.measured = fused.observes(kH);
  if (!frame.measured) {
    filter.hold_height(height_m);
    return;
  }
  const double s = filter.height() / height_m;
  if (!(s < kLargestCorrection && s > 1.0 / kLargestCorrection)) {
    started = frame.measured = false;
    last_found_vo = 0.0;
    return;
  }
  frame.height_m = fused.value(kH) / s;
  frame.height_var = fused.var(kH) / (height_m * height_m);
  metres_per_vo /= s;
  filter.divide_unit(s);
}

/// height_m: this frame's fused observation (5) at the corrected scale; it equals h* when the frame
/// agrees with the filter.
void PaperGround::Impl::write_plane(const VoOutput& vo) {
  PlaneOutput& plane = out.plane;
  if (vo.status == VoStatus::kLost) {
    plane.status = GroundStatus::kInvalid;
    plane.reason = GroundReason::kVoLost;
    return;
  }
  if (!started) {
    plane.status = GroundStatus::kInitializing;
    plane.reason = reason_held(vo);
    return;
  }
  plane.status = frame.measured ? GroundStatus::kOk : GroundStatus::kHeld;
  plane.reason = frame.measured ? GroundReason::kNone : reason_held(vo);
  plane.normal_cam = filter.normal();
  plane.pitch_rad = pitch_of(plane.normal_cam);
  plane.roll_rad = roll_of(plane.normal_cam);
  plane.height_m = frame.measured ? frame.height_m : height_m;

  const Eigen::Matrix4d& P = filter.cov();
  Eigen::Matrix2d tilt;
  tilt << P(0, 0), P(0, 2), P(2, 0), P(2, 2);
  const Eigen::Matrix2d J = angles_jacobian(plane.normal_cam);
  plane.cov.topLeftCorner<2, 2>() = J * tilt * J.transpose();
  plane.cov(2, 2) = P(3, 3) / (height_m * height_m) + frame.height_var;
}

GroundReason PaperGround::Impl::reason_held(const VoOutput& vo) const {
  if (vo.status == VoStatus::kInitializing || vo.status == VoStatus::kCoasting) {
    return GroundReason::kVoNotReady;
  }
  if (vo.status == VoStatus::kStandstill) return GroundReason::kStandstill;
  if (!frame.has_image) return GroundReason::kImageMissing;
  if (started && !frame.searched) return GroundReason::kLowBaseline;
  return GroundReason::kNoCue;
}

ScaleEstimate PaperGround::Impl::scale() const {
  ScaleEstimate scale;
  scale.known = started;
  if (!started) return scale;
  scale.measured_now = frame.measured;
  scale.log_scale = std::log(metres_per_vo);
  const double height_var = filter.cov()(3, 3);
  scale.var = height_var / (height_m * height_m);
  if (frame.var_before > 0.0) {
    scale.kept_ratio = std::clamp(height_var / frame.var_before, 0.0, 1.0);
  }
  return scale;
}

}  // namespace plumb
