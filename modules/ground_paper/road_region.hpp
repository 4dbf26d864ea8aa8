/// The region of interest of the paper, the middle fifth of the lower third, and its agreement with
/// the older image under a plane.
///
/// The plane's homography, equation (6), warps every pixel of the region in the newest image into
/// the older one: G = R + t n^T / h with (R, t) = T_old_cam and n pointing down. Both are compared
/// with bilinear interpolation. The radial term that rectification left is applied on both sides.
///
/// Frames:
///   cam of the newest image.
/// Units:
///   The unit of length is that of t; grey levels.
/// Memory:
///   Rays of the region, sized at construction.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/camera_model.hpp"
#include "core/image_view.hpp"
#include "core/se3.hpp"

namespace plumb {

/// Pixels [u0, u1) x [v0, v1).
struct PixelBox {
  int u0 = 0;
  int u1 = 0;
  int v0 = 0;
  int v1 = 0;
  [[nodiscard]] bool contains(double u, double v) const {
    return u >= u0 && u < u1 && v >= v0 && v < v1;
  }
};

/// Returns the middle `width_ratio` of the lowest `height_ratio` of the image.
[[nodiscard]] PixelBox region_of(const CameraModel& camera, double width_ratio,
                                 double height_ratio);

class RoadRegion {
 public:
  RoadRegion(const CameraModel& camera, const PixelBox& box);

  /// Takes the grey values of the newest image. @pre image has the camera's size
  void take(const ImageView& image);

  /// Mean absolute difference between the region and `old_image` under the plane q = n / h; NaN
  /// when less than half of the warped region lies in that image.
  [[nodiscard]] double sad(const ImageView& old_image, const Se3& T_old_cam,
                           const Eigen::Vector3d& q) const;

 private:
  CameraModel camera_;
  PixelBox box_;
  std::size_t size_ = 0;  ///< pixels; the vectors below are padded to whole lanes
  std::vector<float> x_;  ///< normalised rays
  std::vector<float> y_;
  std::vector<float> grey_;
};

}  // namespace plumb
