#include "modules/ground/ground.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/numbers.hpp"
#include "modules/ground/covariance/cue_covariance.hpp"
#include "modules/ground/covariance/cue_report.hpp"
#include "modules/ground/covariance/ground_sight.hpp"
#include "modules/ground/covariance/learned_covariance.hpp"
#include "modules/ground/covariance/plane_dissent.hpp"
#include "modules/ground/covariance/seen_height.hpp"
#include "modules/ground/cues/dense_cue.hpp"
#include "modules/ground/cues/image_ring.hpp"
#include "modules/ground/cues/points_cue.hpp"
#include "modules/ground/cues/travel.hpp"
#include "modules/ground/ego/ego_motion.hpp"
#include "modules/ground/filter/plane_angles.hpp"
#include "modules/ground/filter/plane_filter.hpp"

namespace plumb {
namespace {

// A shorter chord does not tell the direction of travel, nor new points their depth. In camera
// heights.
constexpr double kShortestChordRatio = 0.25;
// Points nearer to the horizon than this (y/z) are too far to help.
constexpr double kMinPointRaySlope = 0.028;

// A start from one sight of the road wants a clear one; a running filter, or several sights that agree, less.
constexpr double kStartDenseQuality = 0.8;
constexpr double kLeastDenseQuality = 0.4;
constexpr double kAgreeLnHeight = 0.03;
constexpr int kLeastPoints = 4;
constexpr int kLeastPointsToStart = 8;

// Half range of the height sweep in ln h, when the filter is sure of its height and when it is not.
constexpr double kSweepSettled = 0.2;
constexpr double kSweepWide = 0.45;
constexpr double kSettledLnStd = 0.05;

// Steps per camera height that a start tries when the road points give no height, each with the wide sweep around it:
// at 1.65 m and 10 images/s from 1.3 to 60 m/s.
constexpr std::array<double, 6> kStartSteps{0.12, 0.26, 0.5, 0.95, 1.7, 3.0};

std::unique_ptr<const CueCovariance> make_covariance(const GroundConfig& config,
                                                     const GroundModel& model) {
  if (config.covariance == "fixed") return std::make_unique<FloorCovariance>();
  return std::make_unique<LearnedCovariance>(model);
}

}  // namespace

double camera_height_of(const GroundConfig& config, const CameraModel& camera) {
  return camera.camera_height_m > 0.0 ? camera.camera_height_m : config.camera_height_m;
}

struct GroundEstimator::Impl {
  Impl(const GroundConfig& config_in, const CameraModel& camera, const GroundModel& model)
      : config(config_in),
        camera_height_m(camera_height_of(config_in, camera)),
        ring(camera),
        row_clock(camera),
        dense_cue(ring.camera(), ring.num_levels()),
        covariance(make_covariance(config_in, model)),
        scale_bias_var(square(covariance->ln_scale_bias_std())),
        filter(covariance->road_bend()) {}

  void take_image(const GroundInput& input);
  void follow_scale_epoch(const VoOutput& vo);
  void measure_cues(const VoOutput& vo, StageProbe& probe);
  bool prepare_plane(const VoOutput& vo);
  void measure_dense(const VoOutput& vo);
  void measure_points(const VoOutput& vo);
  bool search_start(const VoOutput& vo);
  void fuse();
  void fuse_objects(const GroundInput& input);
  void start_filter();
  void write_plane(const VoOutput& vo, bool has_image);
  void write_height();
  [[nodiscard]] GroundReason reason_held(const VoOutput& vo, bool has_image) const;
  [[nodiscard]] ScaleEstimate scale() const;
  [[nodiscard]] RoadShape road_shape() const;

  GroundConfig config;
  double camera_height_m;
  ImageRing ring;
  RowClock row_clock;
  DenseCue dense_cue;
  PointsCue points_cue;
  std::unique_ptr<const CueCovariance> covariance;
  double scale_bias_var;
  PlaneFilter filter;
  PlaneDissent dissent;
  EgoMotion ego;
  std::int32_t scale_epoch = 0;
  GroundOutput out;

  /// What this frame brought; cleared at its begin.
  struct Frame : GroundSight {
    const Pyramid* image = nullptr;
    Eigen::Vector3d normal_cam = Eigen::Vector3d::UnitY();  ///< expected
    double height = 0.0;                                    ///< expected [vo]
    double var_before = 0.0;                                ///< of ln h, before the cues
    bool predicted = false;  ///< the filter has gone on to this image

    [[nodiscard]] bool height_measured() const {
      return dense_status == CueStatus::kUsed || points_status == CueStatus::kUsed;
    }
    [[nodiscard]] bool height_refused() const {
      return dense_status == CueStatus::kGated || points_status == CueStatus::kGated;
    }
  };
  Frame frame;
};

GroundEstimator::GroundEstimator(const GroundConfig& config, const CameraModel& camera,
                                 const GroundModel& model)
    : impl_(std::make_unique<Impl>(config, camera, model)) {}

GroundEstimator::~GroundEstimator() = default;

std::unique_ptr<GroundAlgorithm> make_ground_estimator(const GroundConfig& config,
                                                       const CameraModel& camera,
                                                       const GroundModel& model) {
  return std::make_unique<GroundEstimator>(config, camera, model);
}

const GroundSight* GroundEstimator::sight() const { return &impl_->frame; }

const GroundOutput& GroundEstimator::update(const GroundInput& input, StageProbe& probe) {
  Impl& m = *impl_;
  const VoOutput& vo = *input.vo;
  probe.begin();
  m.frame = Impl::Frame{};
  m.out.capture_us = vo.capture_us;
  m.out.seq = vo.seq;

  m.row_clock.take(vo.seq, vo.capture_us);
  m.take_image(input);
  probe.mark("pyramid");
  m.follow_scale_epoch(vo);
  m.measure_cues(vo, probe);
  m.fuse();
  m.fuse_objects(input);
  m.frame.filter_started = m.filter.started();
  m.frame.state = m.filter.ahead();
  m.frame.cov = m.filter.ahead_cov();
  m.frame.plane_context = m.dissent.context();
  m.frame.plane_added = m.covariance->plane(m.dissent.context());
  m.frame.ln_scale_bias_var = m.scale_bias_var;
  m.out.plane = PlaneOutput{};
  m.out.plane.cues = observations_of(m.frame, *m.covariance);
  m.write_plane(vo, m.frame.image != nullptr);
  probe.mark("fuse");
  const Eigen::Vector3d normal =
      m.filter.started() ? m.filter.normal() : Eigen::Vector3d(Eigen::Vector3d::UnitY());
  m.ego.update(vo, m.scale(), normal, &m.out.ego);
  probe.mark("ego");
  return m.out;
}

/// A car that stands shows the same view again and again: one of them is enough, beside the older views.
void GroundEstimator::Impl::take_image(const GroundInput& input) {
  if (!ring.fits(input.image)) return;
  const std::int64_t seq = input.vo->seq;
  const bool stands = input.vo->status == VoStatus::kStandstill;
  frame.image = stands ? &ring.replace_newest(seq, input.image) : &ring.push(seq, input.image);
}

void GroundEstimator::Impl::follow_scale_epoch(const VoOutput& vo) {
  if (vo.scale_epoch == scale_epoch) return;
  scale_epoch = vo.scale_epoch;
  if (filter.started()) filter.change_unit(vo.scale_carry_std);
}

void GroundEstimator::Impl::measure_cues(const VoOutput& vo, StageProbe& probe) {
  bool prepared = prepare_plane(vo);
  if (prepared) measure_dense(vo);
  if (!filter.sure() && frame.dense_status != CueStatus::kUsed && search_start(vo)) {
    prepared = true;
  }
  probe.mark("dense");
  if (prepared) measure_points(vo);
  probe.mark("points");
}

/// Predicts the plane and decides whether this frame can measure it.
bool GroundEstimator::Impl::prepare_plane(const VoOutput& vo) {
  const bool turned = vo.status == VoStatus::kOk || vo.status == VoStatus::kRotationOnly ||
                      vo.status == VoStatus::kCoasting;
  if (!turned) return false;
  frame.travel = measure_travel(vo);
  if (filter.started()) {
    const double step = vo.status == VoStatus::kRotationOnly ? 0.0 : frame.travel.step;
    filter.predict(vo.T_prev_cam.R, step / filter.height());
    frame.predicted = true;
  }
  frame.var_before = filter.started() ? filter.cov()(2, 2) : 0.0;
  if (vo.status != VoStatus::kOk || !frame.travel.valid) return false;

  const double n1 = filter.started() ? filter.state()(0) : 0.0;
  frame.normal_cam =
      filter.sure() ? normal_of_state(filter.ahead()) : normal_across(frame.travel.direction, n1);
  if (filter.sure()) {
    frame.height = filter.height();
  } else {
    PointsRequest request{frame.normal_cam, 0.0, kMinPointRaySlope, road_shape()};
    const PointsObservation first = points_cue.measure(vo, request);
    const bool enough = first.ok && first.num_inliers >= kLeastPointsToStart;
    frame.height = enough             ? std::exp(first.ln_height)
                   : filter.started() ? filter.height()
                                      : points_cue.rough_height(vo, frame.normal_cam);
  }
  if (!(frame.height > 0.0)) return false;
  frame.context = {std::abs(frame.travel.curvature) * frame.height,
                   frame.travel.step / frame.height};
  frame.searched = frame.travel.chord_length > kShortestChordRatio * frame.height;
  return frame.searched;
}

RoadShape GroundEstimator::Impl::road_shape() const {
  return {config.road_near_m / camera_height_m, config.road_far_m / camera_height_m,
          config.road_half_width_m / camera_height_m, frame.travel.curvature};
}

void GroundEstimator::Impl::measure_dense(const VoOutput& vo) {
  if (frame.image == nullptr) return;
  const ImagePairs pairs = choose_image_pairs(vo, ring, row_clock, frame.height);
  if (pairs.empty()) return;
  const bool settled = filter.started() && filter.ln_height_std() < kSettledLnStd;
  const DenseRequest request{frame.normal_cam, frame.height, settled ? kSweepSettled : kSweepWide,
                             road_shape()};
  frame.dense = dense_cue.measure(*frame.image, pairs, request);
  const double least = filter.sure() ? kLeastDenseQuality : kStartDenseQuality;
  const bool good = frame.dense.ok && covariance->dense_quality(frame.dense) >= least;
  frame.dense_status = good ? CueStatus::kUsed : CueStatus::kFailed;
}

void GroundEstimator::Impl::measure_points(const VoOutput& vo) {
  const bool refined = frame.dense_status == CueStatus::kUsed && !filter.sure();
  const double height = refined ? 1.0 / frame.dense.q.norm() : frame.height;
  const PointsRequest request{frame.normal_cam, height, kMinPointRaySlope, road_shape()};
  frame.points = points_cue.measure(vo, request);
  if (frame.points.num_candidates == 0) return;
  const bool good = frame.points.ok && frame.points.num_inliers >= kLeastPoints;
  frame.points_status = good ? CueStatus::kUsed : CueStatus::kFailed;
}

/// At high speed VO may hold on to far points alone, and then no road point tells the height at which the dense cue
/// starts. The road itself does: the height that most plausible ones end at, if at least two of them do.
bool GroundEstimator::Impl::search_start(const VoOutput& vo) {
  if (vo.status != VoStatus::kOk || !frame.travel.valid || frame.image == nullptr) return false;
  const Frame before = frame;
  std::array<DenseObservation, kStartSteps.size()> seen;
  for (std::size_t i = 0; i < kStartSteps.size(); ++i) {
    frame.height = frame.travel.step / kStartSteps[i];
    if (frame.travel.chord_length <= kShortestChordRatio * frame.height) continue;
    frame.dense = {};  // a height without a pair of images must not show the last one's sight
    measure_dense(vo);
    if (covariance->dense_quality(frame.dense) >= kLeastDenseQuality) seen[i] = frame.dense;
  }
  int most = 1;
  for (const DenseObservation& one : seen) {
    if (!one.ok) continue;
    const auto agrees = [&one](const DenseObservation& other) {
      return other.ok && std::abs(std::log(other.q.norm() / one.q.norm())) < kAgreeLnHeight;
    };
    const auto num = static_cast<int>(std::count_if(seen.begin(), seen.end(), agrees));
    if (num <= most) continue;
    most = num;
    frame.dense = one;
  }
  if (most < 2) {
    frame = before;
    return false;
  }
  frame.height = 1.0 / frame.dense.q.norm();
  frame.context = {std::abs(frame.travel.curvature) * frame.height,
                   frame.travel.step / frame.height};
  frame.dense_status = CueStatus::kUsed;
  frame.searched = true;
  return true;
}

/// First estimate: the dense cue's, else that of many agreeing points.
void GroundEstimator::Impl::start_filter() {
  if (frame.dense_status == CueStatus::kUsed) {
    filter.start(frame.normal_cam, std::log(height_given_normal(frame.dense, frame.normal_cam)));
  } else if (frame.points_status == CueStatus::kUsed &&
             frame.points.num_inliers >= kLeastPointsToStart) {
    filter.start(frame.normal_cam, frame.points.ln_height);
  }
}

void GroundEstimator::Impl::fuse() {
  if (!frame.searched) return;
  const bool starts = !filter.started();
  if (starts) {
    start_filter();
    dissent.forget();
  }
  if (!filter.started()) return;
  filter.observe_level_roll();
  const CueContext& context = frame.context;
  filter.observe_travel(frame.travel.direction, covariance->travel(frame.travel, context));
  if (frame.dense_status == CueStatus::kUsed) {
    const Eigen::Matrix3d cov = with_height_repeated(covariance->dense(frame.dense, context),
                                                     covariance->dense_repetition(context));
    if (!filter.observe_plane(state_of_plane(frame.dense.q), cov))
      frame.dense_status = CueStatus::kGated;
  }
  if (frame.points_status == CueStatus::kUsed) {
    const double var =
        covariance->points_repetition(context) * covariance->points(frame.points, context);
    if (!filter.observe_point(frame.points.centre, var)) frame.points_status = CueStatus::kGated;
  }
  if (starts && frame.height_refused()) filter.forget();  // not the road: a truck's back, a mirror
  filter.end_frame(frame.height_measured(), frame.height_refused());
  dissent.add(frame, filter.ahead());
}

/// The last of the cues, so that the gate holds it against this frame's others. Not at rest: the same boxes again and
/// again would feign certainty.
void GroundEstimator::Impl::fuse_objects(const GroundInput& input) {
  if (input.objects.empty()) return;
  frame.objects = input.objects.front();
  if (!filter.started() || !frame.predicted) return;
  const double var = covariance->objects_repetition() * frame.objects.n3_var;
  const bool taken = filter.observe_pitch(frame.objects.n3, var);
  frame.objects_status = taken ? CueStatus::kUsed : CueStatus::kGated;
}

/// The road ahead. height_m (write_height): the heights that this frame's cues saw, weighted and seen along the fused
/// normal, times the filtered scale. It equals the nominal camera height when the frame agrees with the filter and the
/// road is flat, and differs with the road's bend and with the cues' noise.
void GroundEstimator::Impl::write_plane(const VoOutput& vo, bool has_image) {
  PlaneOutput& plane = out.plane;
  if (vo.status == VoStatus::kLost) {
    plane.status = GroundStatus::kInvalid;
    plane.reason = GroundReason::kVoLost;
    return;
  }
  if (!filter.started()) {
    plane.status = GroundStatus::kInitializing;
    plane.reason = reason_held(vo, has_image);
    return;
  }
  const bool measured = frame.height_measured();
  plane.status = measured ? GroundStatus::kOk : GroundStatus::kHeld;
  plane.reason = measured && has_image ? GroundReason::kNone : reason_held(vo, has_image);
  plane.normal_cam = normal_of_state(filter.ahead());
  plane.pitch_rad = pitch_of(plane.normal_cam);
  plane.roll_rad = roll_of(plane.normal_cam);

  const Eigen::Matrix2d J = angles_jacobian(plane.normal_cam);
  plane.cov.topLeftCorner<2, 2>() = J * filter.ahead_cov().topLeftCorner<2, 2>() * J.transpose();
  plane.cov(0, 0) += frame.plane_added.pitch_rad2;
  plane.cov(1, 1) += frame.plane_added.roll_rad2;
  write_height();
}

void GroundEstimator::Impl::write_height() {
  PlaneOutput& plane = out.plane;
  const double ln_height_here = filter.state()(2);
  if (!frame.height_measured()) {
    plane.height_m = camera_height_m * std::exp(filter.ahead()(2) - ln_height_here);
    plane.cov(2, 2) = filter.cov()(2, 2) + filter.ahead_var(Eigen::RowVector3d::UnitZ());
  } else {
    const SeenHeight seen = see_height(frame, *covariance, filter.ahead());
    plane.height_m = camera_height_m * std::exp(seen.ln_height - ln_height_here);
    plane.cov(2, 2) = seen.var + filter.ahead_var({seen.slope(0), seen.slope(1), 0.0});
  }
  plane.cov(2, 2) += frame.plane_added.ln_height;
}

GroundReason GroundEstimator::Impl::reason_held(const VoOutput& vo, bool has_image) const {
  if (vo.status == VoStatus::kInitializing || vo.status == VoStatus::kCoasting) {
    return GroundReason::kVoNotReady;
  }
  if (vo.status == VoStatus::kStandstill) return GroundReason::kStandstill;
  if (!has_image) return GroundReason::kImageMissing;
  if (!frame.searched) return GroundReason::kLowBaseline;
  return frame.height_refused() ? GroundReason::kCuesRejected : GroundReason::kNoCue;
}

ScaleEstimate GroundEstimator::Impl::scale() const {
  ScaleEstimate scale;
  scale.known = filter.started();
  if (!scale.known) return scale;
  scale.measured_now = frame.height_measured();
  scale.log_scale = std::log(camera_height_m) - filter.state()(2);
  scale.var = filter.cov()(2, 2) + scale_bias_var;
  if (frame.var_before > 0.0) {
    scale.kept_ratio = std::clamp(scale.var / (frame.var_before + scale_bias_var), 0.0, 1.0);
  }
  return scale;
}

}  // namespace plumb
