#include "modules/objects/object_track.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

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

double square(double x) { return x * x; }

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

double contact_inset_m(const ObjectsConfig& config, ObjectClass object_class) {
  const bool wheels =
      object_class != ObjectClass::kPedestrian && object_class != ObjectClass::kCyclist;
  return wheels ? config.contact_inset_m : 0.0;
}

bool is_whole(const MeasuredBox& box) {
  return std::none_of(box.cut.begin(), box.cut.end(), [](bool cut) { return cut; });
}

double plane_error_var(const TrackView& view, double distance_m) {
  return view.plane.cov(0, 0) + square(view.detections.road_bend_std_rad_m * distance_m);
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
  set_prior(&estimate, kPlaneError, 0.0, std::sqrt(plane_error_var(view, distance_m)));
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
        fit_box(view.camera, view.plane, contact_inset_m(view.objects, object_class_), box,
                prior(view, detection, box, heading.yaw_rad));
    const double cost = fit.cost + heading.cost;
    if (!fit.ok || fit.estimate.x(kX) <= 0.0 || (found && cost >= least)) continue;
    least = cost;
    estimate_ = fit.estimate;
    heading_rad_ = heading.yaw_rad;
    found = true;
  }
  return found;
}

void ObjectTrack::predict(const TrackView& view, const GroundMotion& motion) {
  const double dt_s = motion.dt_s;
  StateMatrix F = StateMatrix::Identity();
  F(kX, kVelocityX) = F(kY, kVelocityY) = dt_s;
  estimate_.x = F * estimate_.x;
  // Into the new ground axes.
  const double yaw_rad = motion.known ? motion.yaw_rad : 0.0;
  const Eigen::Vector2d t_m = motion.known ? motion.t_m : Eigen::Vector2d(0.0, 0.0);
  const double c = std::cos(yaw_rad), s = std::sin(yaw_rad);
  Eigen::Matrix2d R_new_old;
  R_new_old << c, s, -s, c;
  estimate_.x.head<2>() = R_new_old * (estimate_.x.head<2>() - t_m);
  estimate_.x.segment<2>(kVelocityX) = R_new_old * estimate_.x.segment<2>(kVelocityX).eval();
  estimate_.x(kYaw) = wrapped(estimate_.x(kYaw) - yaw_rad);
  StateMatrix turn = StateMatrix::Identity();
  turn.topLeftCorner<2, 2>() = R_new_old;
  turn.block<2, 2>(kVelocityX, kVelocityX) = R_new_old;
  // First-order Gauss-Markov error of the plane.
  const double keep = std::exp(-dt_s / view.objects.plane_error_time_s);
  turn(kPlaneError, kPlaneError) = keep;
  estimate_.x(kPlaneError) *= keep;
  // So is the heading, about that along the road or across it with which the track began.
  const double keep_yaw = std::exp(-dt_s / kYawTime_s);
  turn(kYaw, kYaw) = keep_yaw;
  estimate_.x(kYaw) = heading_rad_ + keep_yaw * wrapped(estimate_.x(kYaw) - heading_rad_);
  const StateMatrix A = turn * F;
  estimate_.P = A * estimate_.P * A.transpose();

  const double accel_var =
      square(motion.known ? view.objects.accel_std_m_s2 : view.objects.relative_accel_std_m_s2);
  for (int axis = 0; axis < 2; ++axis) {
    // White acceleration over the step.
    estimate_.P(kX + axis, kX + axis) += accel_var * 0.25 * square(dt_s * dt_s);
    estimate_.P(kVelocityX + axis, kVelocityX + axis) += accel_var * square(dt_s);
    const double both = accel_var * 0.5 * dt_s * square(dt_s);
    estimate_.P(kX + axis, kVelocityX + axis) += both;
    estimate_.P(kVelocityX + axis, kX + axis) += both;
    if (motion.known != over_ground_) {
      estimate_.P(kVelocityX + axis, kVelocityX + axis) += square(kUnknownMotionSpeedStd);
    }
  }
  over_ground_ = motion.known;
  estimate_.P(kYaw, kYaw) += (1.0 - square(keep_yaw)) * square(kStartYawStd);
  for (const StateRow row : {kLogWidth, kLogRatio, kLogHeight}) {
    estimate_.P(row, row) += square(kLogSizeRateStd) * dt_s;
  }
  estimate_.P(kPlaneError, kPlaneError) +=
      (1.0 - keep * keep) * plane_error_var(view, estimate_.x.head<2>().norm());
}

bool ObjectTrack::correct(const TrackView& view, const Detection& detection,
                          const MeasuredBox& box) {
  // A box that the image cuts leaves the heading open: until a whole one came, nothing is kept.
  if (!was_whole_) return start(view, detection, box);
  // One frame's change of mind about the class is not believed.
  num_other_class_ = detection.object_class == object_class_ ? 0 : num_other_class_ + 1;
  if (num_other_class_ >= kMostMisfits) return start(view, detection, box);
  const BoxFitResult fit = fit_box(view.camera, view.plane,
                                   contact_inset_m(view.objects, object_class_), box, estimate_);
  if (!fit.ok || fit.chi2 > kMisfitChi2) {
    if (++num_misfits_ < kMostMisfits) return false;
    return start(view, detection, box);
  }
  num_misfits_ = 0;
  estimate_ = fit.estimate;
  return true;
}

void ObjectTrack::align_with_motion() {
  if (!over_ground_) return;
  const Eigen::Vector2d v = estimate_.x.segment<2>(kVelocityX);
  const double speed = v.norm();
  const double speed_var = estimate_.P.block<2, 2>(kVelocityX, kVelocityX).trace();
  if (speed < kLeastSpeed_m_s || speed < kLeastSpeedSigmas * std::sqrt(speed_var)) return;
  // A box looks the same from both ends: the motion says which one is the front.
  double off_rad = wrapped(std::atan2(v.y(), v.x()) - estimate_.x(kYaw));
  if (std::abs(off_rad) > 0.5 * kHalfTurn) {
    estimate_.x(kYaw) = wrapped(estimate_.x(kYaw) + kHalfTurn);
    heading_rad_ = wrapped(heading_rad_ + kHalfTurn);
    off_rad = wrapped(off_rad + kHalfTurn);
  }
  StateVector H = StateVector::Zero();
  H(kYaw) = 1.0;
  H(kVelocityX) = v.y() / square(speed);
  H(kVelocityY) = -v.x() / square(speed);
  const StateVector PH = estimate_.P * H;
  const StateVector K = PH / (H.dot(PH) + square(kCrabStd));
  estimate_.x += K * off_rad;
  estimate_.x(kYaw) = wrapped(estimate_.x(kYaw));
  estimate_.P -= K * PH.transpose();
}

}  // namespace plumb
