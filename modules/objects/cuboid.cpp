#include "modules/objects/cuboid.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace plumb {
namespace {

constexpr double kNearest_m = 0.5;

/// A corner of the cuboid and its pixel.
struct Corner {
  double side_x = 0.0, side_y = 0.0;  ///< +1 or -1
  bool inset = false;                 ///< true for a point of contact with the road
  bool roof = false;                  ///< true for an upper corner
  Eigen::Vector2d px = Eigen::Vector2d::Zero();
};

/// The geometry that all corners share.
class View {
 public:
  View(const CameraModel& camera, const RoadPlane& plane, const StateVector& state, double inset_m)
      : camera_(camera), camera_height_m_(plane.height_m) {
    const double p = plane.pitch_rad + state(kPlaneError);
    const double cp = std::cos(p), sp = std::sin(p);
    const double cr = std::cos(plane.roll_rad), sr = std::sin(plane.roll_rad);
    forward_ = {-sp * sr, -sp * cr, cp};
    left_ = {-cr, sr, 0.0};
    up_ = {-cp * sr, -cp * cr, -sp};
    forward_by_roll_ = {-sp * cr, sp * sr, 0.0};
    left_by_roll_ = {sr, cr, 0.0};
    up_by_roll_ = {-cp * cr, cp * sr, 0.0};
    const double c = std::cos(state(kYaw)), s = std::sin(state(kYaw));
    along_axis_ = c * forward_ + s * left_;
    across_axis_ = c * left_ - s * forward_;
    middle_ = state(kX) * forward_ + state(kY) * left_ - camera_height_m_ * up_;
    half_length_ = 0.5 * length_of(state);
    half_width_ = 0.5 * width_of(state);
    height_ = height_of(state);
    inset_m_ = inset_m;
  }

  /// Computes the corner's position in cam and its pixel. Returns false when the corner is not in
  /// front of the camera.
  bool place(Corner* corner, Eigen::Vector3d* p_cam) const {
    *p_cam = middle_ + along(*corner) * along_axis_ + across(*corner) * across_axis_;
    if (corner->roof) *p_cam += height_ * up_;
    if (!(p_cam->z() > kNearest_m)) return false;
    corner->px = camera_.from_normalized(p_cam->head<2>() / p_cam->z());
    return true;
  }

  /// Writes the derivatives of the corner's u (axis 0) or v (axis 1) to row `edge` of `out`.
  void derive(Corner corner, int axis, int edge, ProjectedCuboid* out) const {
    Eigen::Vector3d p_cam;
    place(&corner, &p_cam);
    const Eigen::RowVector3d J_px = pixel_jacobian(p_cam).row(axis);
    // The corner relative to the camera, in ground axes.
    const Eigen::Vector3d q(forward_.dot(p_cam), left_.dot(p_cam), up_.dot(p_cam));
    const double by_ratio = J_px.dot(along_axis_) * corner.side_x * half_length_;
    auto J = out->J_state.row(edge);
    J.setZero();
    J(kX) = J_px.dot(forward_);
    J(kY) = J_px.dot(left_);
    J(kYaw) = J_px.dot(along(corner) * across_axis_ - across(corner) * along_axis_);
    J(kLogRatio) = by_ratio;
    J(kLogWidth) = by_ratio + J_px.dot(across_axis_) * corner.side_y * half_width_;
    J(kLogHeight) = corner.roof ? height_ * J_px.dot(up_) : 0.0;
    out->J_inset(edge) =
        corner.inset ? -J_px.dot(corner.side_x * along_axis_ + corner.side_y * across_axis_) : 0.0;
    J(kPlaneError) = J_px.dot(q.x() * up_ - q.z() * forward_);
    out->J_plane(edge, 0) = J(kPlaneError);
    out->J_plane(edge, 1) =
        J_px.dot(q.x() * forward_by_roll_ + q.y() * left_by_roll_ + q.z() * up_by_roll_);
    out->J_plane(edge, 2) = -camera_height_m_ * J_px.dot(up_);
  }

 private:
  [[nodiscard]] double along(const Corner& c) const {
    return c.side_x * std::max(half_length_ - (c.inset ? inset_m_ : 0.0), 0.0);
  }
  [[nodiscard]] double across(const Corner& c) const {
    return c.side_y * std::max(half_width_ - (c.inset ? inset_m_ : 0.0), 0.0);
  }

  [[nodiscard]] Eigen::Matrix<double, 2, 3> pixel_jacobian(const Eigen::Vector3d& p) const {
    const Eigen::Vector2d xy = p.head<2>() / p.z();
    Eigen::Matrix<double, 2, 3> J_xy;
    J_xy << 1.0, 0.0, -xy.x(), 0.0, 1.0, -xy.y();
    return Eigen::Vector2d(camera_.fx_px, camera_.fy_px).asDiagonal() *
           camera_.distortion_jacobian(xy) * J_xy / p.z();
  }

  const CameraModel& camera_;
  double camera_height_m_;
  double half_length_, half_width_, height_, inset_m_;
  Eigen::Vector3d forward_, left_, up_, forward_by_roll_, left_by_roll_, up_by_roll_;
  Eigen::Vector3d along_axis_, across_axis_, middle_;
};

/// The outermost corner so far at each edge: left, top, right, bottom.
struct Outline {
  std::array<Corner, 4> corners;
  bool empty = true;

  void stretch(int edge, int axis, double sign, const Corner& corner) {
    Corner& outermost = corners[static_cast<std::size_t>(edge)];
    if (empty || sign * corner.px(axis) > sign * outermost.px(axis)) outermost = corner;
  }
};

constexpr std::array<int, 4> kAxis{0, 1, 0, 1};

}  // namespace

std::optional<ProjectedCuboid> project_cuboid(const CameraModel& camera, const RoadPlane& plane,
                                              const StateVector& state, double contact_inset_m) {
  const View view(camera, plane, state, contact_inset_m);
  Outline outline;
  for (const double side_x : {-1.0, 1.0}) {
    for (const double side_y : {-1.0, 1.0}) {
      Corner low{side_x, side_y, false, false, {}};
      Corner contact{side_x, side_y, true, false, {}};
      Corner high{side_x, side_y, false, true, {}};
      Eigen::Vector3d p_cam;
      if (!view.place(&low, &p_cam) || !view.place(&contact, &p_cam) ||
          !view.place(&high, &p_cam)) {
        return std::nullopt;
      }
      outline.stretch(0, 0, -1.0, low);
      outline.stretch(1, 1, -1.0, high);
      outline.stretch(2, 0, 1.0, low);
      outline.stretch(3, 1, 1.0, contact);
      outline.empty = false;
      outline.stretch(0, 0, -1.0, high);
      outline.stretch(2, 0, 1.0, high);
    }
  }
  ProjectedCuboid projected;
  for (int edge = 0; edge < 4; ++edge) {
    const auto i = static_cast<std::size_t>(edge);
    projected.edges_px(edge) = outline.corners[i].px(kAxis[i]);
    view.derive(outline.corners[i], kAxis[i], edge, &projected);
  }
  return projected;
}

}  // namespace plumb
