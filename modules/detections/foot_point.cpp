#include "modules/detections/foot_point.hpp"

#include <Eigen/LU>
#include <cmath>

namespace plumb {
namespace {

constexpr double kLeastSlope = 1e-4;  ///< n . ray below this: no road within 10^4 camera heights

}  // namespace

NormalizedPixel normalize_pixel(const CameraModel& camera, const Eigen::Vector2d& px) {
  NormalizedPixel result;
  result.xy = camera.to_normalized(px);
  const Eigen::Vector2d inverse_focal(1.0 / camera.fx_px, 1.0 / camera.fy_px);
  result.J_px = camera.distortion_jacobian(result.xy).inverse() * inverse_focal.asDiagonal();
  return result;
}

std::optional<FootPoint> back_project_foot(const CameraModel& camera, const RoadPlane& plane,
                                           const Eigen::Vector2d& foot_px,
                                           const Eigen::Matrix2d& cov_px2) {
  const NormalizedPixel foot = normalize_pixel(camera, foot_px);
  const Eigen::Vector3d ray = foot.xy.homogeneous();
  const Eigen::Vector3d n = plane.normal_cam();
  const double slope = n.dot(ray);
  if (!(slope > kLeastSlope)) return std::nullopt;

  FootPoint result;
  result.p_cam = plane.height_m / slope * ray;
  const Eigen::Matrix3d J_ray =
      plane.height_m / slope * (Eigen::Matrix3d::Identity() - ray * n.transpose() / slope);
  result.J_px = J_ray.leftCols<2>() * foot.J_px;
  const Eigen::Vector2d slope_change = plane.normal_jacobian().transpose() * ray;
  result.J_plane.leftCols<2>() = -result.p_cam / slope * slope_change.transpose();
  result.J_plane.col(2) = result.p_cam;
  result.cov_cam_m2 = result.J_px * cov_px2 * result.J_px.transpose() +
                      result.J_plane * plane.cov * result.J_plane.transpose();
  return result;
}

std::optional<HeightEstimate> object_height(const CameraModel& camera, const RoadPlane& plane,
                                            const Eigen::Vector2d& foot_px, double head_v_px,
                                            const Eigen::Matrix3d& cov_px2) {
  const auto foot = back_project_foot(camera, plane, foot_px, Eigen::Matrix2d::Zero());
  if (!foot) return std::nullopt;
  const NormalizedPixel head = normalize_pixel(camera, {foot_px.x(), head_v_px});
  const Eigen::Vector3d n = plane.normal_cam();
  const Eigen::Vector3d B = foot->p_cam;
  const double y = head.xy.y();
  // Up the normal from B until the row is reached: (B - height n) has y' / z' = y.
  const double denominator = n.y() - y * n.z();
  const double numerator = B.y() - y * B.z();
  if (!(denominator > 0.0) || !(numerator > 0.0)) return std::nullopt;

  HeightEstimate result;
  result.height_m = numerator / denominator;
  const Eigen::RowVector3d J_foot = Eigen::RowVector3d(0.0, 1.0, -y) / denominator;
  const Eigen::RowVector3d J_normal =
      result.height_m / denominator * Eigen::RowVector3d(0.0, -1.0, y);
  const double J_y = (-B.z() + result.height_m * n.z()) / denominator;
  const Eigen::RowVector2d J_foot_px = J_foot * foot->J_px;
  result.J_px = {J_foot_px.x() + J_y * head.J_px(1, 0), J_foot_px.y(), J_y * head.J_px(1, 1)};
  result.J_plane = (J_foot * foot->J_plane).transpose();
  result.J_plane.head<2>() += (J_normal * plane.normal_jacobian()).transpose();
  result.var_m2 =
      result.J_px.dot(cov_px2 * result.J_px) + result.J_plane.dot(plane.cov * result.J_plane);
  return result;
}

std::optional<PitchFromBox> pitch_from_box(const CameraModel& camera, double roll_rad,
                                           const Eigen::Vector2d& foot_px, double head_v_px,
                                           double height_ratio) {
  const NormalizedPixel foot = normalize_pixel(camera, foot_px);
  const NormalizedPixel head = normalize_pixel(camera, {foot_px.x(), head_v_px});
  // Turned by the roll about the optical axis the road has no n1.
  const Eigen::RowVector2d turn(std::sin(roll_rad), std::cos(roll_rad));
  const Eigen::RowVector2d turn_change(turn.y(), -turn.x());
  const double y_foot = turn * foot.xy;
  const double y_head = turn * head.xy;
  const double k = height_ratio;
  const double d = y_foot - y_head;
  if (!(d > 0.0) || !(k > 0.0)) return std::nullopt;

  // The relation of the header as a y_h^2 + b y_h + c = 0; the root that stays finite for a -> 0.
  const double a = d + k * y_head;
  const double b = k * (1.0 - y_head * y_foot);
  const double c = d - k * y_foot;
  const double discriminant = b * b - 4.0 * a * c;
  if (!(b > 0.0) || !(discriminant > 0.0)) return std::nullopt;
  const double root = std::sqrt(discriminant);
  const double y_h = -2.0 * c / (b + root);
  if (!(y_h < y_foot)) return std::nullopt;

  // Implicit derivatives of F = a y_h^2 + b y_h + c: F_foot = dF/dy_foot and so on; dF/dy_h is the
  // root of the discriminant.
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
