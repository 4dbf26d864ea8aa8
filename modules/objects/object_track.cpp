#include "modules/objects/object_track.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/numbers.hpp"
#include "modules/detections/box_screen.hpp"

namespace plumb {
namespace {

constexpr double kHalfTurn = std::numbers::pi;
constexpr double kStartYawStd = 0.25;     ///< [rad] about each heading that is tried
constexpr double kYawTime_s = 2.0;        ///< over which a heading forgets
constexpr double kLogSizeRateStd = 0.01;  ///< [1/sqrt(s)]
constexpr double kMisfitChi2 = 30.0;      ///< of four edges
constexpr int kMostMisfits = 3;
constexpr double kUnknownMotionSpeedStd = 8.0;  ///< [m/s] when what velocities refer to changes
constexpr double kLeastSpeed_m_s = 2.0;         ///< slower motion does not tell the heading
constexpr double kLeastSpeedSigmas = 4.0;
constexpr double kCrabStd = 0.06;       ///< [rad] of the heading against the motion
constexpr double kHiddenEdgeStd = 0.5;  ///< shares of the height per share hidden

/// A heading that is tried at the start; -2 ln of its probability.
struct Heading {
  double yaw_rad;
  double cost;
};
constexpr std::array<Heading, 4> kHeadings{
    {{0.0, 0.0}, {0.5 * kHalfTurn, 4.0}, {0.25 * kHalfTurn, 5.0}, {-0.25 * kHalfTurn, 5.0}}};

constexpr double kNearestFoot_m = 3.0;
constexpr double kStandingSpeedStd = 0.1;  ///< [m/s]
constexpr double kWayErrorRatio = 0.02;    ///< of the camera's way over a frame
constexpr double kOddsTime_s = 10.0;    ///< over which evidence fades: boxes err alike for a while
constexpr double kEvidenceRate = 10.0;  ///< [1/s] the most that boxes can say, in log odds
constexpr double kReseedLogOdds = -6.0;
constexpr double kReseedSigmas2 = 6.0;
constexpr double kReseedSpeedStd = 3.0;  ///< [m/s]

/// In [-pi, pi].
double wrapped(double angle_rad) {
  return angle_rad - 2.0 * kHalfTurn * std::ceil((angle_rad - kHalfTurn) / (2.0 * kHalfTurn));
}

void set_prior(StateEstimate* estimate, StateRow row, double mean, double std) {
  estimate->x(row) = mean;
  estimate->P(row, row) = std * std;
}

HeightPrior height_prior(const TrackView& view, ObjectClass object_class) {
  const HeightPrior known = view.detections.height_prior(object_class);
  if (known.mean_m > 0.0) return known;
  return {view.objects.unknown_height_m, view.objects.unknown_height_std_m};
}

Contact contact_of(const ObjectsConfig& config, ObjectClass object_class) {
  const bool wheels =
      object_class != ObjectClass::kPedestrian && object_class != ObjectClass::kCyclist;
  return wheels ? Contact{config.contact_inset_m, config.contact_inset_std_m} : Contact{};
}

bool is_whole(const MeasuredBox& box) {
  return std::none_of(box.cut.begin(), box.cut.end(), [](bool cut) { return cut; });
}

/// Of the pitch at which the foot of an object is seen: the plane's own, the road's bend, and the
/// heights between the camera's lane and the object, which count for less the farther it is.
double plane_error_var(const TrackView& view, const Eigen::Vector2d& position_m) {
  const double distance_m = position_m.norm();
  const double height_var = square(view.objects.foot_height_std_m) +
                            square(view.objects.cross_slope_std * position_m.y());
  return view.plane.cov(0, 0) + square(view.detections.road_bend_std_rad_m * distance_m) +
         height_var / square(std::max(distance_m, kNearestFoot_m));
}

/// Velocity zero, known to be so, and independent of all else.
void pin(StateEstimate* estimate) {
  for (const StateRow row : {kVelocityX, kVelocityY}) {
    estimate->x(row) = 0.0;
    estimate->P.row(row).setZero();
    estimate->P.col(row).setZero();
    estimate->P(row, row) = square(kStandingSpeedStd);
  }
}

/// The newest ground axes, seen from the old ones.
struct AxesStep {
  Eigen::Matrix2d R_new_old = Eigen::Matrix2d::Identity();
  Eigen::Vector2d t_m = Eigen::Vector2d::Zero();
  double yaw_rad = 0.0;
};

/// One time step of a filter, without what acceleration adds.
void carry(const TrackView& view, const AxesStep& axes, double dt_s, double heading_rad,
           StateEstimate* estimate) {
  StateVector& x = estimate->x;
  StateMatrix F = StateMatrix::Identity();
  F(kX, kVelocityX) = F(kY, kVelocityY) = dt_s;
  x = F * x;
  // Into the new ground axes.
  x.head<2>() = axes.R_new_old * (x.head<2>() - axes.t_m);
  x.segment<2>(kVelocityX) = axes.R_new_old * x.segment<2>(kVelocityX).eval();
  x(kYaw) = wrapped(x(kYaw) - axes.yaw_rad);
  StateMatrix turn = StateMatrix::Identity();
  turn.topLeftCorner<2, 2>() = axes.R_new_old;
  turn.block<2, 2>(kVelocityX, kVelocityX) = axes.R_new_old;
  // First-order Gauss-Markov error of the plane.
  const double keep = std::exp(-dt_s / view.objects.plane_error_time_s);
  turn(kPlaneError, kPlaneError) = keep;
  x(kPlaneError) *= keep;
  // So is the heading, about that along the road or across it with which the track began.
  const double keep_yaw = std::exp(-dt_s / kYawTime_s);
  turn(kYaw, kYaw) = keep_yaw;
  x(kYaw) = heading_rad + keep_yaw * wrapped(x(kYaw) - heading_rad);
  const StateMatrix A = turn * F;
  StateMatrix& P = estimate->P;
  P = A * P * A.transpose();
  P(kYaw, kYaw) += (1.0 - square(keep_yaw)) * square(kStartYawStd);
  for (const StateRow row : {kLogWidth, kLogRatio, kLogHeight}) {
    P(row, row) += square(kLogSizeRateStd) * dt_s;
  }
  P(kPlaneError, kPlaneError) += (1.0 - keep * keep) * plane_error_var(view, x.head<2>());
}

/// White acceleration over the step.
void accelerate(double accel_var, double dt_s, StateEstimate* estimate) {
  StateMatrix& P = estimate->P;
  for (int axis = 0; axis < 2; ++axis) {
    const double both = accel_var * 0.5 * dt_s * square(dt_s);
    P(kX + axis, kX + axis) += accel_var * 0.25 * square(dt_s * dt_s);
    P(kVelocityX + axis, kVelocityX + axis) += accel_var * square(dt_s);
    P(kX + axis, kVelocityX + axis) += both;
    P(kVelocityX + axis, kX + axis) += both;
  }
}

}  // namespace

MeasuredBox measured_box(const DetectionsConfig& config, const CameraModel& camera,
                         const DetectionFrame& frame, std::size_t index) {
  const Box& box = frame.detections[index].box;
  const double var_px2 =
      square(config.edge_std_px) + square(config.edge_std_ratio * box.height_px());
  const HiddenEdges hidden = hidden_edges(frame, index);
  const CutSides cut = cut_sides(camera, box, config.border_px);
  MeasuredBox measured;
  measured.edges_px = {box.left_px, box.top_px, box.right_px, box.bottom_px};
  measured.var_px2.setConstant(var_px2);
  measured.var_px2(1) += square(kHiddenEdgeStd * hidden.upper_ratio * box.height_px());
  measured.var_px2(3) += square(kHiddenEdgeStd * hidden.lower_ratio * box.height_px());
  measured.cut = {cut.left, cut.top, cut.right, cut.bottom};
  return measured;
}

StateEstimate ObjectTrack::prior(const TrackView& view, const Detection& detection,
                                 const MeasuredBox& box, double yaw_rad) const {
  const HeightPrior height = height_prior(view, detection.object_class);
  const FootprintPrior& footprint = view.objects.footprint(detection.object_class);
  const double distance_m = height.mean_m * view.camera.fy_px / (box.edges_px(3) - box.edges_px(1));
  const Eigen::Vector2d middle_px(0.5 * (box.edges_px(0) + box.edges_px(2)), box.edges_px(3));
  const double left_m = -distance_m * view.camera.to_normalized(middle_px).x();
  // Wide enough to say nothing about where the object is, yet on the right side of the camera.
  const double position_std_m = 0.5 * distance_m + 5.0;

  StateEstimate estimate;
  set_prior(&estimate, kX, distance_m, position_std_m);
  set_prior(&estimate, kY, left_m, position_std_m);
  set_prior(&estimate, kVelocityX, 0.0, view.objects.start_speed_std_m_s);
  set_prior(&estimate, kVelocityY, 0.0, view.objects.start_speed_std_m_s);
  set_prior(&estimate, kYaw, yaw_rad, kStartYawStd);
  set_prior(&estimate, kLogWidth, std::log(footprint.width_m),
            footprint.width_std_m / footprint.width_m);
  set_prior(&estimate, kLogRatio, std::log(footprint.ratio), footprint.ratio_std / footprint.ratio);
  set_prior(&estimate, kLogHeight, std::log(height.mean_m), height.std_m / height.mean_m);
  set_prior(&estimate, kPlaneError, 0.0, std::sqrt(plane_error_var(view, {distance_m, left_m})));
  return estimate;
}

bool ObjectTrack::start(const TrackView& view, const Detection& detection, const MeasuredBox& box) {
  object_class_ = detection.object_class;
  num_misfits_ = 0;
  num_other_class_ = 0;
  was_whole_ = is_whole(box);
  bool found = false;
  double least = 0.0;
  for (const Heading& heading : kHeadings) {
    const BoxFitResult fit =
        fit_box(view.camera, view.plane, contact_of(view.objects, object_class_), box,
                prior(view, detection, box, heading.yaw_rad));
    const double cost = fit.cost + heading.cost;
    if (!fit.ok || fit.estimate.x(kX) <= 0.0 || (found && cost >= least)) continue;
    least = cost;
    moving_ = fit.estimate;
    heading_rad_ = heading.yaw_rad;
    found = true;
  }
  if (!found) return false;
  fresh_ = true;
  seed_standing();
  mix();
  return true;
}

void ObjectTrack::seed_standing() {
  standing_ = moving_;
  standing_log_odds_ = 0.0;
  unweighed_s_ = 0.0;
  Eigen::Matrix2d S = moving_.P.block<2, 2>(kVelocityX, kVelocityX);
  S.diagonal().array() += square(kStandingSpeedStd);
  const Eigen::Matrix<double, kStateSize, 2> K = moving_.P.middleCols<2>(kVelocityX) * S.inverse();
  standing_.x -= K * moving_.x.segment<2>(kVelocityX);
  standing_.P -= K * S * K.transpose();
  pin(&standing_);
}

void ObjectTrack::predict(const TrackView& view, const GroundMotion& motion) {
  const double dt_s = motion.dt_s;
  AxesStep axes;
  if (motion.known) {
    const double c = std::cos(motion.yaw_rad), s = std::sin(motion.yaw_rad);
    axes.R_new_old << c, s, -s, c;
    axes.t_m = motion.t_m;
    axes.yaw_rad = motion.yaw_rad;
  }
  carry(view, axes, dt_s, heading_rad_, &moving_);
  accelerate(
      square(motion.known ? view.objects.accel_std_m_s2 : view.objects.relative_accel_std_m_s2),
      dt_s, &moving_);
  if (motion.known != over_ground_ && !fresh_) {
    moving_.P.block<2, 2>(kVelocityX, kVelocityX).diagonal().array() +=
        square(kUnknownMotionSpeedStd);
    seed_standing();
  } else {
    carry(view, axes, dt_s, heading_rad_, &standing_);
    pin(&standing_);
    standing_.P.topLeftCorner<2, 2>().diagonal().array() +=
        square(kWayErrorRatio) * motion.t_m.squaredNorm();
    standing_log_odds_ *= std::exp(-dt_s / kOddsTime_s);
  }
  over_ground_ = motion.known;
  fresh_ = false;
  unweighed_s_ += dt_s;
  mix();
}

void ObjectTrack::mix() {
  estimate_ = moving_;
  if (!over_ground_) return;
  const double share = 1.0 / (1.0 + std::exp(-standing_log_odds_));
  StateVector apart = standing_.x - moving_.x;
  // Standing tells no front from a rear.
  apart(kYaw) = 0.5 * wrapped(2.0 * apart(kYaw));
  estimate_.x += share * apart;
  estimate_.x(kYaw) = wrapped(estimate_.x(kYaw));
  estimate_.P = (1.0 - share) * moving_.P + share * standing_.P +
                share * (1.0 - share) * (apart * apart.transpose());
}

bool ObjectTrack::weigh(const BoxFitResult& moving, const BoxFitResult& standing) {
  const bool moves = moving.ok && moving.chi2 <= kMisfitChi2;
  const bool stands = over_ground_ && standing.ok && standing.chi2 <= kMisfitChi2;
  const double most_evidence = kEvidenceRate * unweighed_s_;
  unweighed_s_ = 0.0;
  if (moves) moving_ = moving.estimate;
  if (stands) standing_ = standing.estimate;
  if (moves && stands) {
    const double evidence = 0.5 * (moving.chi2 + moving.log_det - standing.chi2 - standing.log_det);
    standing_log_odds_ += std::clamp(evidence, -most_evidence, most_evidence);
  } else if (stands) {
    standing_log_odds_ += most_evidence;
    moving_ = standing_;
    moving_.P.block<2, 2>(kVelocityX, kVelocityX).diagonal().array() += square(kReseedSpeedStd);
  } else if (moves) {
    standing_log_odds_ = std::min(standing_log_odds_, kReseedLogOdds);
  }
  if (moves && standing_log_odds_ <= kReseedLogOdds) {
    const Eigen::Vector2d v = moving_.x.segment<2>(kVelocityX);
    const Eigen::Matrix2d P = moving_.P.block<2, 2>(kVelocityX, kVelocityX);
    if (v.dot(P.inverse() * v) < kReseedSigmas2) seed_standing();
  }
  return moves || stands;
}

bool ObjectTrack::correct(const TrackView& view, const Detection& detection,
                          const MeasuredBox& box) {
  // A box that the image cuts leaves the heading open: until a whole one came, nothing is kept.
  if (!was_whole_) return start(view, detection, box);
  // One frame's change of mind about the class is not believed.
  num_other_class_ = detection.object_class == object_class_ ? 0 : num_other_class_ + 1;
  if (num_other_class_ >= kMostMisfits) return start(view, detection, box);
  const Contact contact = contact_of(view.objects, object_class_);
  const BoxFitResult moving = fit_box(view.camera, view.plane, contact, box, moving_);
  const BoxFitResult standing =
      over_ground_ ? fit_box(view.camera, view.plane, contact, box, standing_) : BoxFitResult{};
  if (!weigh(moving, standing)) {
    if (++num_misfits_ < kMostMisfits) return false;
    return start(view, detection, box);
  }
  num_misfits_ = 0;
  align_with_motion();
  mix();
  return true;
}

void ObjectTrack::align_with_motion() {
  if (!over_ground_) return;
  const Eigen::Vector2d v = moving_.x.segment<2>(kVelocityX);
  const double speed = v.norm();
  const double speed_var = moving_.P.block<2, 2>(kVelocityX, kVelocityX).trace();
  if (speed < kLeastSpeed_m_s || speed < kLeastSpeedSigmas * std::sqrt(speed_var)) return;
  // A box looks the same from both ends: the motion says which one is the front.
  double off_rad = wrapped(std::atan2(v.y(), v.x()) - moving_.x(kYaw));
  if (std::abs(off_rad) > 0.5 * kHalfTurn) {
    moving_.x(kYaw) = wrapped(moving_.x(kYaw) + kHalfTurn);
    heading_rad_ = wrapped(heading_rad_ + kHalfTurn);
    off_rad = wrapped(off_rad + kHalfTurn);
  }
  StateVector H = StateVector::Zero();
  H(kYaw) = 1.0;
  H(kVelocityX) = v.y() / square(speed);
  H(kVelocityY) = -v.x() / square(speed);
  const StateVector PH = moving_.P * H;
  const StateVector K = PH / (H.dot(PH) + square(kCrabStd));
  moving_.x += K * off_rad;
  moving_.x(kYaw) = wrapped(moving_.x(kYaw));
  moving_.P -= K * PH.transpose();
}

}  // namespace plumb
