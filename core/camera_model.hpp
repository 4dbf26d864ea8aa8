/// A pinhole camera with the radial distortion that rectification left in its images.
///
/// Frames:
///   cam: x right, y down, z forward, origin at the optical centre.
///   img: u right, v down; (0,0) is the centre of the upper left pixel.
/// Model:
///   With (x, y) = (X/Z, Y/Z), r2 = x^2 + y^2 and s = 1 + k1 r2 + k2 r2^2:
///   u = fx x s + cx,  v = fy y s + cy.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace plumb {

struct CameraModel {
  int width_px = 0;
  int height_px = 0;
  double fx_px = 0.0;
  double fy_px = 0.0;
  double cx_px = 0.0;
  double cy_px = 0.0;
  double residual_k1 = 0.0;      ///< [-] coefficient k1, of r^2
  double residual_k2 = 0.0;      ///< [-] coefficient k2, of r^4
  double camera_height_m = 0.0;  ///< optical centre above the road; 0 when it is not known
  double readout_s = 0.0;        ///< rolling shutter, first row to last; 0 for a global shutter

  /// Time of a row's exposure relative to the image's time stamp, which is that of the middle row.
  [[nodiscard]] double row_time_s(double v_px) const {
    return readout_s * ((v_px + 0.5) / height_px - 0.5);
  }

  /// Pixel of a point in cam. @pre p_cam.z() > 0
  [[nodiscard]] Eigen::Vector2d project(const Eigen::Vector3d& p_cam) const {
    return from_normalized(p_cam.head<2>() / p_cam.z());
  }

  /// Pixel of undistorted normalised coordinates (X/Z, Y/Z).
  [[nodiscard]] Eigen::Vector2d from_normalized(const Eigen::Vector2d& xy) const {
    const double s = radial(xy.squaredNorm());
    return {fx_px * xy.x() * s + cx_px, fy_px * xy.y() * s + cy_px};
  }

  /// Undistorted normalised coordinates (X/Z, Y/Z) of a pixel. The fixed-point iteration is
  /// accurate to 1e-9 where the radial terms move the pixel by less than 5 %.
  [[nodiscard]] Eigen::Vector2d to_normalized(const Eigen::Vector2d& px) const {
    const Eigen::Vector2d distorted((px.x() - cx_px) / fx_px, (px.y() - cy_px) / fy_px);
    Eigen::Vector2d xy = distorted;
    for (int i = 0; i < 8; ++i) xy = distorted / radial(xy.squaredNorm());
    return xy;
  }

  /// The ray through a pixel, scaled to z = 1.
  [[nodiscard]] Eigen::Vector3d unproject(const Eigen::Vector2d& px) const {
    return to_normalized(px).homogeneous();
  }

  /// d(distorted) / d(undistorted) normalised coordinates, 2 x 2 [-].
  [[nodiscard]] Eigen::Matrix2d distortion_jacobian(const Eigen::Vector2d& xy) const {
    const double r2 = xy.squaredNorm();
    return radial(r2) * Eigen::Matrix2d::Identity() +
           2.0 * (residual_k1 + 2.0 * residual_k2 * r2) * xy * xy.transpose();
  }

  /// Ratio s of the distorted to the undistorted radius.
  [[nodiscard]] double radial(double r2) const {
    return 1.0 + r2 * (residual_k1 + r2 * residual_k2);
  }
};

}  // namespace plumb
