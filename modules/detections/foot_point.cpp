#include "modules/detections/foot_point.hpp"

#include <Eigen/LU>
#include <cmath>

namespace plumb {
namespace {

/// At a smaller n . ray the road would be more than 10^4 camera heights away.
constexpr double kLeastSlope = 1e-4;

/// Undistorted normalised coordinates of a pixel, and their Jacobian with respect to the pixel.
struct NormalizedPixel {
  Eigen::Vector2d xy = Eigen::Vector2d::Zero();
  Eigen::Matrix2d J_px = Eigen::Matrix2d::Zero();
};

NormalizedPixel normalize_pixel(const CameraModel& camera, const Eigen::Vector2d& px) {
  NormalizedPixel result;
  result.xy = camera.to_normalized(px);
  const Eigen::Vector2d inverse_focal(1.0 / camera.fx_px, 1.0 / camera.fy_px);
  result.J_px = camera.distortion_jacobian(result.xy).inverse() * inverse_focal.asDiagonal();
  return result;
}

}  // namespace

std::optional<Eigen::Vector3d> back_project_foot(const CameraModel& camera, const RoadPlane& plane,
                                                 const Eigen::Vector2d& foot_px) {
  const Eigen::Vector3d ray = camera.unproject(foot_px);
  const double slope = plane.normal_cam().dot(ray);
  if (!(slope > kLeastSlope)) return std::nullopt;
  return plane.height_m / slope * ray;
}

std::optional<PitchFromBox> pitch_from_box(const CameraModel& camera, double roll_rad,
                                           const Eigen::Vector2d& foot_px, double head_v_px,
                                           double height_ratio) {
  const NormalizedPixel foot = normalize_pixel(camera, foot_px);
  const NormalizedPixel head = normalize_pixel(camera, {foot_px.x(), head_v_px});
  // In an image rotated by the roll about the optical axis, the road's normal has no n1.
  const Eigen::RowVector2d turn(std::sin(roll_rad), std::cos(roll_rad));
  const Eigen::RowVector2d turn_change(turn.y(), -turn.x());
  const double y_foot = turn * foot.xy;
  const double y_head = turn * head.xy;
  const double k = height_ratio;
  const double d = y_foot - y_head;
  if (!(d > 0.0) || !(k > 0.0)) return std::nullopt;

  // The equation of the header reads a y_h^2 + b y_h + c = 0. The root taken is the one that stays
  // finite for a -> 0.
  const double a = d + k * y_head;
  const double b = k * (1.0 - y_head * y_foot);
  const double c = d - k * y_foot;
  const double discriminant = b * b - 4.0 * a * c;
  if (!(b > 0.0) || !(discriminant > 0.0)) return std::nullopt;
  const double root = std::sqrt(discriminant);
  const double y_h = -2.0 * c / (b + root);
  if (!(y_h < y_foot)) return std::nullopt;

  // The derivatives follow from F = a y_h^2 + b y_h + c = 0 by the implicit function theorem:
  // F_foot = dF/dy_foot and so on, and dF/dy_h is the square root of the discriminant.
  const double F_foot = y_h * y_h - k * y_head * y_h + 1.0 - k;
  const double F_head = (k - 1.0) * y_h * y_h - k * y_foot * y_h - 1.0;
  const double F_k = y_head * y_h * y_h + (1.0 - y_head * y_foot) * y_h - y_foot;
  const double pitch_slope = 1.0 / (root * (1.0 + y_h * y_h));

  const Eigen::RowVector2d foot_change = turn * foot.J_px;
  const Eigen::RowVector2d head_change = turn * head.J_px;
  PitchFromBox result;
  result.pitch_rad = -std::atan(y_h);
  result.J_px = pitch_slope * Eigen::Vector3d(F_foot * foot_change.x() + F_head * head_change.x(),
                                              F_foot * foot_change.y(), F_head * head_change.y());
  result.J_roll = pitch_slope * (F_foot * turn_change.dot(foot.xy.transpose()) +
                                 F_head * turn_change.dot(head.xy.transpose()));
  result.J_log_ratio = pitch_slope * F_k * k;
  return result;
}

}  // namespace plumb
