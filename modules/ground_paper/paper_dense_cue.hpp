/// Plane-guided dense stereo of the paper: the plane at which the road region of this image and the
/// older one differ least.
///
/// The cost (7), f = 1 - rho^(-SAD) with SAD the mean absolute difference per pixel, is minimised
/// over (h, n1, n3) by Nelder and Mead's simplex from the expected plane. The confidence in each
/// component is the width of a Gaussian fitted to 50 samples of f along it, with the others fixed.
///
/// Frames:
///   cam of the newest image.
/// Units:
///   The unit of length is that of t.
/// Memory:
///   One RoadRegion.
#pragma once

#include <Eigen/Core>

#include "core/se3.hpp"
#include "modules/ground_paper/gaussian_fit.hpp"
#include "modules/ground_paper/plane_vector.hpp"
#include "modules/ground_paper/road_region.hpp"

namespace plumb {

struct PaperDenseMeasurement {
  bool ok = false;
  Eigen::Vector3d z = Eigen::Vector3d::Zero();  ///< (n1, n3, h)
  double sad = 0.0;                             ///< grey levels, at z
  /// Widths of the slices in the same order; infinite where the slice shows no dip.
  Eigen::Vector3d width = Eigen::Vector3d::Zero();
  int num_evaluations = 0;  ///< of the cost, until the simplex settled
};

class PaperDenseCue {
 public:
  PaperDenseCue(const CameraModel& camera, const PixelBox& box, double rho);

  /// Takes the newest image. @pre it has the camera's size
  void take(const ImageView& image) { region_.take(image); }

  /// @pre |T_old_cam.t| > 0, expected(kH) > 0
  [[nodiscard]] PaperDenseMeasurement measure(const ImageView& old_image, const Se3& T_old_cam,
                                              const Eigen::Vector3d& expected) const;

  /// The cost at 50 places along one component of z, with the others fixed (section 5.1.1).
  [[nodiscard]] Slice slice(const ImageView& old_image, const Se3& T_old_cam,
                            const Eigen::Vector3d& z, PlaneComponent along) const;

  /// Finds the height at which a road of that normal fits best, over all plausible speeds; 0 when
  /// none does. It serves the start, when the unit of t is not known yet.
  [[nodiscard]] double search_height(const ImageView& old_image, const Se3& T_old_cam,
                                     const Eigen::Vector3d& normal_cam) const;

 private:
  [[nodiscard]] double cost(const ImageView& old_image, const Se3& T_old_cam,
                            const Eigen::Vector3d& z) const;

  RoadRegion region_;
  double ln_rho_;
};

}  // namespace plumb
