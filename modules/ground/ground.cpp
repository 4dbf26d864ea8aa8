#include "modules/ground/ground.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/numbers.hpp"
#include "modules/ground/covariance/fixed_covariance.hpp"
#include "modules/ground/covariance/learned_covariance.hpp"
#include "modules/ground/covariance/residual_statistics.hpp"
#include "modules/ground/cue_fuser.hpp"
#include "modules/ground/cues/chord.hpp"
#include "modules/ground/cues/dense_cue.hpp"
#include "modules/ground/cues/motion_cue.hpp"
#include "modules/ground/cues/objects_cue.hpp"
#include "modules/ground/cues/points_cue.hpp"
#include "modules/ground/ego/ego_motion.hpp"
#include "modules/ground/ego/unit_watch.hpp"
#include "modules/ground/filter/scale_drift.hpp"
#include "modules/ground/motion_judge.hpp"
#include "modules/ground/plane_report.hpp"

namespace plumb {
namespace {

// A start is proven by this many images with a measured height, and has failed after this many
// others.
constexpr int kStartProven = 3;
constexpr int kStartFailed = 3;

// The doubt about a start falls to a half within this time: errors of images that follow each other
// more quickly are the same ones.
constexpr double kDoubtTime_s = 0.1;

// How far the height of a cue may have misled the filter that the road's speed disproves later.
constexpr double kDoubtedHeightStd = 0.1;

std::unique_ptr<const CueCovariance> make_covariance(const GroundConfig& config,
                                                     const GroundModel& model) {
  if (config.covariance == "fixed") return std::make_unique<FixedCovariance>();
  return std::make_unique<LearnedCovariance>(model);
}

/// Time since the previous image; 0 when it is not known.
double passed_s(const VoOutput& vo) { return vo.interval_s > 0.0 ? vo.interval_s : 0.0; }

/// VO's result holds a rotation since the previous image.
bool has_rotation(const VoOutput& vo) {
  return vo.status == VoStatus::kOk || vo.status == VoStatus::kRotationOnly ||
         vo.status == VoStatus::kCoasting;
}

}  // namespace

/// What speaks for a start of the filter and against it, until enough does.
struct StartTrial {
  int num_used = 0;     ///< images with a measured height since the start or a new unit
  double used_s = 0.0;  ///< from the first of them to the last one
  int num_missed = 0;   ///< images in which the road should have been seen
  bool open = false;    ///< the start can still turn out to be wrong

  void take(bool used, double dt_s) {
    if (used && num_used > 0) used_s += dt_s;
    (used ? num_used : num_missed) += 1;
  }
};

struct GroundEstimator::Impl {
  Impl(const GroundConfig& config_in, const CameraModel& camera, const GroundModel& model)
      : config(config_in),
        camera_height(camera_height_of(config_in, camera)),
        ring(camera),
        row_clock(camera),
        covariance(make_covariance(config_in, model)),
        dense_cue(config.filter, *covariance, ring, row_clock),
        points_cue(config.filter, *covariance),
        objects_cue(*covariance),
        motion_cue(config.filter),
        filter(covariance->road_bend(), config.filter),
        drift(config.filter),
        ego(config.ego),
        unit_watch(config.ego) {}

  CueFrame take(const GroundInput& input);
  void take_height(const GroundInput& input);
  void measure_road_step(const VoOutput& vo, bool measured);
  void watch_unit(const VoOutput& vo, CueFrame* frame);
  void follow_drift(const VoOutput& vo, bool measured);
  FramePrior predict(const CueFrame& frame);
  void expect_plane(const CueFrame& frame, FramePrior* prior);
  Observations measure(const CueFrame& frame, FramePrior* prior, StageProbe& probe);
  void fuse(const CueFrame& frame, const FramePrior& prior, Observations* observations);
  void fuse_height(const CueFrame& frame, const FramePrior& prior, Observations* observations);
  void report(const CueFrame& frame, const FramePrior& prior, const Observations& observations);
  void try_start(bool used, bool rejected, double dt_s);
  void diagnose(const CueFrame& frame, const FramePrior& prior);
  [[nodiscard]] HeightMeasurement height_seen(const Observations& observations) const;
  [[nodiscard]] RoadShape road_shape(const Chord& chord) const;
  [[nodiscard]] ScaleEstimate scale(const VoOutput& vo, const FramePrior& prior,
                                    bool measured) const;

  GroundConfig config;
  CameraHeight camera_height;
  ImageRing ring;
  RowClock row_clock;
  std::unique_ptr<const CueCovariance> covariance;
  DenseCue dense_cue;
  PointsCue points_cue;
  ObjectsCue objects_cue;
  MotionCue motion_cue;
  std::array<Cue*, kNumCues> cues{&dense_cue, &points_cue, &objects_cue,
                                  &motion_cue};  ///< as in kCueTable
  PlaneFilter filter;
  ResidualStatistics residuals;
  ScaleDrift drift;
  EgoMotion ego;
  UnitWatch unit_watch;
  std::int32_t scale_epoch = 0;
  bool unit_proven = true;
  StartTrial trial;
  MotionJudge motion_judge;
  GroundOutput out;
  CueDiagnostics diagnostics;
};

GroundEstimator::GroundEstimator(const GroundConfig& config, const CameraModel& camera,
                                 const GroundModel& model)
    : impl_(std::make_unique<Impl>(config, camera, model)) {}

GroundEstimator::~GroundEstimator() = default;

const CueDiagnostics* GroundEstimator::diagnostics() const { return &impl_->diagnostics; }

const GroundOutput& GroundEstimator::update(const GroundInput& input, StageProbe& probe) {
  Impl& m = *impl_;
  probe.begin();
  const CueFrame frame = m.take(input);
  probe.mark("pyramid");
  FramePrior prior = m.predict(frame);
  Observations observations = m.measure(frame, &prior, probe);
  m.fuse(frame, prior, &observations);
  m.report(frame, prior, observations);
  probe.mark("fuse");
  const Eigen::Vector3d normal =
      m.filter.started() ? m.filter.normal() : Eigen::Vector3d(Eigen::Vector3d::UnitY());
  const bool measured = any_height(observations, CueStatus::kUsed);
  m.follow_drift(*frame.vo, measured);
  m.ego.update(*frame.vo, m.scale(*frame.vo, prior, measured), normal, &m.out.ego);
  m.measure_road_step(*frame.vo, measured);
  probe.mark("ego");
  return m.out;
}

/// A car at standstill shows the same view again and again: the ring keeps one of them beside the
/// older views.
CueFrame GroundEstimator::Impl::take(const GroundInput& input) {
  const VoOutput& vo = *input.vo;
  CueFrame frame;
  frame.vo = &vo;
  frame.objects = input.objects;
  if (has_rotation(vo)) frame.chord = measure_chord(vo);
  take_height(input);
  watch_unit(vo, &frame);
  row_clock.take(vo.seq, vo.capture_us);
  if (ring.fits(input.image)) {
    const bool stands = vo.status == VoStatus::kStandstill;
    frame.image =
        stands ? &ring.replace_newest(vo.seq, input.image) : &ring.push(vo.seq, input.image);
  }
  return frame;
}

/// Applies what is known of VO's unit in this image. While VO's steps mean nothing, no cue measures
/// anything by them.
void GroundEstimator::Impl::watch_unit(const VoOutput& vo, CueFrame* frame) {
  if (vo.scale_epoch != scale_epoch) {
    scale_epoch = vo.scale_epoch;
    if (filter.started()) filter.change_unit(vo.scale_carry_std);
    drift.change_unit();
    trial = {};
  }
  const double metres_per_vo = filter.started() ? camera_height.height_m / filter.height() : 0.0;
  const UnitVerdict verdict = unit_watch.watch(vo, metres_per_vo);
  unit_proven = verdict != UnitVerdict::kUnproven;
  if (verdict == UnitVerdict::kSteady) return;
  frame->chord.valid = false;
  if (verdict == UnitVerdict::kUnproven) return;
  if (verdict == UnitVerdict::kJump) drift.change_unit();
  filter.reset();
}

/// While the car stands, VO holds its position, and its unit does not drift.
void GroundEstimator::Impl::follow_drift(const VoOutput& vo, bool measured) {
  const double dt_s = vo.interval_s;
  if (!filter.started() || !(dt_s > 0.0)) return;
  if (measured) {
    drift.measured(filter.state()(2), filter.cov()(2, 2), dt_s);
  } else if (vo.status == VoStatus::kOk || vo.status == VoStatus::kCoasting) {
    filter.add_height_var(drift.held(dt_s));
  }
}

/// The scale stays when the body rises or sinks: the height in VO's unit changes with the metric
/// one. When the height is only known better, the scale changes with it.
void GroundEstimator::Impl::take_height(const GroundInput& input) {
  const CameraHeight& height = input.camera_height;
  if (!(height.height_m > 0.0)) return;
  const bool moves = !input.is_height_correction && height.height_m != camera_height.height_m;
  if (filter.started() && moves) {
    filter.change_height(std::log(height.height_m / camera_height.height_m));
  }
  camera_height = height;
}

void GroundEstimator::Impl::measure_road_step(const VoOutput& vo, bool measured) {
  if (!measured || vo.status != VoStatus::kOk || !filter.converged()) return;
  out.ego.road_step_heights = vo.T_prev_cam.t.norm() / filter.height();
  out.ego.road_step_ln_var = filter.cov()(2, 2) + square(motion_judge.excess());
}

FramePrior GroundEstimator::Impl::predict(const CueFrame& frame) {
  const VoOutput& vo = *frame.vo;
  FramePrior prior;
  if (!has_rotation(vo)) return prior;
  if (filter.started()) {
    const double step = vo.status == VoStatus::kRotationOnly ? 0.0 : frame.chord.step;
    filter.predict(vo.T_prev_cam.R, step / filter.height());
    prior.predicted = true;
    prior.ln_height_var = filter.cov()(2, 2);
    prior.ln_height_std = filter.ln_height_std();
  }
  prior.converged = filter.converged();
  if (vo.status == VoStatus::kOk && frame.chord.valid) expect_plane(frame, &prior);
  return prior;
}

/// Before the filter has converged, the path gives the normal and the road points the height.
void GroundEstimator::Impl::expect_plane(const CueFrame& frame, FramePrior* prior) {
  const Chord& chord = frame.chord;
  prior->road = road_shape(chord);
  if (prior->converged) {
    prior->normal_cam = normal_of_state(filter.ahead());
    prior->height = filter.height();
  } else {
    const bool started = filter.started();
    prior->normal_cam = normal_across(chord.direction, started ? filter.state()(0) : 0.0);
    const bool told = frame.vo->road_height > 0.0;
    prior->height =
        told ? frame.vo->road_height
             : points_cue.find_height(*frame.vo, *prior, started ? filter.height() : 0.0);
  }
  if (!(prior->height > 0.0)) return;
  prior->context = {std::abs(chord.curvature) * prior->height, chord.step / prior->height};
  prior->measurable = chord.length > config.filter.shortest_chord_ratio * prior->height;
}

RoadShape GroundEstimator::Impl::road_shape(const Chord& chord) const {
  const double h = camera_height.height_m;
  return {config.road_near_m / h, config.road_far_m / h, config.road_half_width_m / h,
          chord.curvature};
}

/// Runs every cue of the table. `prior` becomes that of the last cue: a cue may have found a
/// height.
Observations GroundEstimator::Impl::measure(const CueFrame& frame, FramePrior* prior,
                                            StageProbe& probe) {
  Observations observations;
  // The other cues of the height would count the same pixels twice.
  const bool motion_only = frame.vo->reason == VoReason::kRoadMotion;
  for (std::size_t i = 0; i < kNumCues; ++i) {
    const bool skipped = motion_only && kCueTable[i].measures_height && i != kCueMotion;
    observations[i] = skipped ? nothing_observed(*prior) : cues[i]->measure(frame, *prior);
    *prior = observations[i].prior;
    probe.mark(kCueTable[i].name);
  }
  const bool doubts = motion_judge.judge(passed_s(*frame.vo), &observations);
  if (doubts && filter.started()) filter.doubt_height(square(kDoubtedHeightStd));
  return observations;
}

void GroundEstimator::Impl::fuse(const CueFrame& frame, const FramePrior& prior,
                                 Observations* observations) {
  if (prior.measurable) fuse_height(frame, prior, observations);
  if (filter.started()) fuse_cues(false, &filter, observations);
}

/// Initialises the filter if necessary, then fuses the level car, the direction of translation and
/// the cues of the height.
void GroundEstimator::Impl::fuse_height(const CueFrame& frame, const FramePrior& prior,
                                        Observations* observations) {
  const bool starts = !filter.started();
  if (starts) {
    start_filter(*observations, &filter);
    residuals.reset();
    motion_judge.forget_filter();
    trial = {};
    trial.open = true;
  }
  if (!filter.started()) return;
  filter.fuse(filter.level_roll());
  PlaneObservation path;
  path.function = observe_direction;
  path.value = frame.chord.direction;
  path.cov(0, 0) = covariance->chord(frame.chord, prior.context);
  path.road = RoadPart::kUnderCar;
  path.gated = false;
  filter.fuse(path);
  motion_judge.follow_filter((*observations)[kCueMotion], filter.state()(2));
  fuse_cues(true, &filter, observations);
  const bool rejected = any_height(*observations, CueStatus::kGated);
  const bool used = any_height(*observations, CueStatus::kUsed);
  // Cues that contradict each other did not start on the road, but on a truck's back or a mirror.
  if (starts && rejected) filter.reset();
  try_start(used, rejected, passed_s(*frame.vo));
  filter.end_frame(used, rejected);
  const bool dense_used = (*observations)[kCueDense].report.status == CueStatus::kUsed;
  residuals.add({prior.context, frame.chord.direction, dense_used ? &dense_cue.last() : nullptr},
                filter.ahead());
}

/// A start that the next images do not confirm was none. One cue that contradicts is enough: what
/// is attached to a truck ahead can agree on a plane for an image.
void GroundEstimator::Impl::try_start(bool used, bool rejected, double dt_s) {
  trial.take(used, dt_s);
  if (!trial.open) return;
  trial.open = trial.num_used < kStartProven;
  if (trial.open && (rejected || trial.num_missed >= kStartFailed)) filter.reset();
}

void GroundEstimator::Impl::report(const CueFrame& frame, const FramePrior& prior,
                                   const Observations& observations) {
  out.capture_us = frame.vo->capture_us;
  out.seq = frame.vo->seq;
  out.plane = PlaneOutput{};
  for (std::size_t i = 0; i < kNumCues; ++i) out.plane.cues[i] = observations[i].report;
  PlaneEvidence evidence;
  evidence.vo_status = frame.vo->status;
  evidence.has_image = frame.image != nullptr;
  evidence.measurable = prior.measurable;
  evidence.height_measured = any_height(observations, CueStatus::kUsed);
  evidence.height_rejected = any_height(observations, CueStatus::kGated);
  if (evidence.height_measured) evidence.height_seen = height_seen(observations);
  evidence.added = covariance->plane(residuals.context());
  evidence.camera_height = camera_height;
  write_plane(filter, evidence, &out.plane);
  diagnose(frame, prior);
}

HeightMeasurement GroundEstimator::Impl::height_seen(const Observations& observations) const {
  HeightMean mean;
  for (std::size_t i = 0; i < kNumCues; ++i) {
    const bool used = observations[i].report.status == CueStatus::kUsed;
    if (used && kCueTable[i].measures_height) mean.add(cues[i]->height_over(filter.ahead()));
  }
  return mean.mean();
}

void GroundEstimator::Impl::diagnose(const CueFrame& frame, const FramePrior& prior) {
  diagnostics.measurable = prior.measurable;
  diagnostics.chord = frame.chord;
  diagnostics.context = prior.context;
  diagnostics.dense = dense_cue.last();
  diagnostics.points = points_cue.last();
  diagnostics.cues = out.plane.cues;
  diagnostics.filter_started = filter.started();
  diagnostics.state = filter.ahead();
  diagnostics.cov = filter.ahead_cov();
  diagnostics.plane_context = residuals.context();
  diagnostics.plane_added = covariance->plane(residuals.context());
  diagnostics.ln_scale_bias_var = covariance->ln_scale_bias_std() * covariance->ln_scale_bias_std();
}

/// A height that was found in a picture that may be upside down is not known yet.
ScaleEstimate GroundEstimator::Impl::scale(const VoOutput& vo, const FramePrior& prior,
                                           bool measured) const {
  ScaleEstimate scale;
  scale.known = filter.started() && vo.reason != VoReason::kOrientationUnproven;
  if (!scale.known) return scale;
  const double bias_std = covariance->ln_scale_bias_std();
  const double constant_var = bias_std * bias_std + camera_height.var_ratio();
  scale.measured_now = measured;
  scale.log_scale = std::log(camera_height.height_m) - filter.state()(2);
  // A single height may be wrong by more than its own image can tell.
  const double doubt = config.filter.start_doubt_std / (1.0 + trial.used_s / kDoubtTime_s);
  scale.var = filter.cov()(2, 2) + constant_var + doubt * doubt + square(motion_judge.excess());
  const bool confirmed = !trial.open || trial.num_used >= config.filter.start_confirmations;
  scale.known = unit_proven && confirmed && scale.var <= square(config.ego.most_log_scale_std);
  if (prior.ln_height_var > 0.0) {
    scale.kept_ratio = std::clamp(scale.var / (prior.ln_height_var + constant_var), 0.0, 1.0);
  }
  return scale;
}

}  // namespace plumb
