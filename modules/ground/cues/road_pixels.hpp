/// Selects the pixels that show the road ahead: a trapezoid bent along the path, thinned to a fixed
/// number.
///
/// Frames:
///   img: the rows of the newest image that ImageRing keeps.
///   cam of the same image.
/// Units:
///   [vo]; plane q = n / h, so that 1/Z = q . (x, y, 1).
/// Memory:
///   kMaxRoadPixels in place, structure of arrays.
#pragma once

#include <Eigen/Core>

#include "core/camera_model.hpp"
#include "core/image_view.hpp"
#include "core/simd.hpp"

namespace plumb {

inline constexpr int kMaxRoadPixels = 4096;

/// Camera of one pyramid level, in float for the pixel loops.
struct LevelCamera {
  float fx = 0.0F;
  float fy = 0.0F;
  float cx = 0.0F;
  float cy = 0.0F;
  float k1 = 0.0F;
  float k2 = 0.0F;

  /// Same as CameraModel::radial, for one or several squared radii.
  template <typename T>
  [[nodiscard]] T radial(const T& r2) const {
    return 1.0F + r2 * (k1 + r2 * k2);
  }
};

[[nodiscard]] LevelCamera camera_of_level(const CameraModel& camera, int level);

/// Shape of the searched road, in multiples of the camera height; curvature in 1/[vo].
struct RoadShape {
  double near_ratio = 0.0;
  double far_ratio = 0.0;
  double half_width_ratio = 0.0;
  double curvature = 0.0;
};

/// Undistorted ray (x, y, 1) and grey value of each pixel, padded with zeros to whole lanes.
struct RoadPixels {
  int size = 0;
  alignas(32) float x[kMaxRoadPixels + kNumLanes] = {};
  alignas(32) float y[kMaxRoadPixels + kNumLanes] = {};
  alignas(32) float grey[kMaxRoadPixels + kNumLanes] = {};

  [[nodiscard]] int padded_size() const { return (size + kNumLanes - 1) / kNumLanes * kNumLanes; }
};

/// Fills `pixels` with at most `max_pixels` of `image`, evenly thinned.
/// @pre max_pixels <= kMaxRoadPixels
void select_road_pixels(const ImageView& image, const LevelCamera& camera, const RoadShape& shape,
                        const Eigen::Vector3d& q, int max_pixels, RoadPixels* pixels);

}  // namespace plumb
