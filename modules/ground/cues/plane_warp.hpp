/// Compares the road of the newest image with an older one under a plane, and sums the normal
/// equations of their alignment.
///
/// A pixel with ray m sees the plane q = n/h at X = m / (q . m). In the older image it lies at
/// W = project((R + t q^T) m) with T_old_cam = (R, t). The residual is
/// r = I_old(W) - (1 + a) I(m) - b.
///
/// Frames:
///   T_old_cam maps cam now to the older cam.
///   img: the rows that ImageRing keeps.
/// Units:
///   [vo]; grey levels 0..255.
#pragma once

#include <Eigen/Core>

#include "core/image_view.hpp"
#include "core/se3.hpp"
#include "modules/ground/cues/road_pixels.hpp"

namespace plumb {

/// Exposure change from the newest image to the older one.
struct Photometric {
  double gain = 0.0;  ///< a
  double bias = 0.0;  ///< b, grey levels
};

inline constexpr int kNumPairParams = 5;  ///< q, gain, bias

/// Weighted sums over pixels of one image pair; J = dr/d(q, a, b).
struct PairSums {
  Eigen::Matrix<double, kNumPairParams, kNumPairParams> H;  ///< sum w J J^T
  Eigen::Matrix<double, kNumPairParams, 1> b;               ///< -sum w J r
  double weighted_square = 0.0;                             ///< sum w r^2
  int num_pixels = 0;
};

/// Agreement of the two images under a plane.
struct Likeness {
  int num_pixels = 0;
  double sad = 0.0;  ///< mean |I_old(W) - I - mean difference|, grey levels
  double ncc = 0.0;  ///< correlation, [-1, 1]
};

class PlaneWarp {
 public:
  /// @param lag_per_y  RowClock::lag_per_y() for this pair of images
  PlaneWarp(const ImageView& old_image, const LevelCamera& camera, const Se3& T_old_cam,
            double lag_per_y);

  /// Linearises the residuals at (q, photometric), with Student-t weights of scale `sigma_grey`.
  void accumulate(const RoadPixels& pixels, const Eigen::Vector3d& q,
                  const Photometric& photometric, double sigma_grey, PairSums* sums) const;

  [[nodiscard]] Likeness compare(const RoadPixels& pixels, const Eigen::Vector3d& q) const;

 private:
  ImageView image_;
  LevelCamera camera_;
  Se3 T_old_cam_;
  double lag_per_y_;
};

}  // namespace plumb
