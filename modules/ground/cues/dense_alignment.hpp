/// Dense alignment: the plane q = n/h that makes the road of this image agree with one or two older
/// images.
///
/// A sweep over heights finds the basin of the right minimum. Then Gauss-Newton refines q, with
/// gain and bias for each image pair and Student-t weights, from coarse to fine.
///
/// Frames:
///   cam of the newest image.
/// Units:
///   [vo], grey levels.
/// Memory:
///   One RoadPixels; no heap after construction.
#pragma once

#include <Eigen/Core>

#include "core/fixed_vector.hpp"
#include "modules/ground/cues/image_ring.hpp"
#include "modules/ground/cues/plane_warp.hpp"
#include "modules/ground/cues/road_pixels.hpp"
#include "modules/ground/cues/row_clock.hpp"
#include "modules/ground/types/cue_measurements.hpp"
#include "modules/vo/vo.hpp"

namespace plumb {

inline constexpr std::size_t kMaxImagePairs = 2;

/// An older image and the motion to it.
struct ImagePair {
  const Pyramid* old_image = nullptr;
  Se3 T_old_cam;
  double lag_per_y = 0.0;  ///< RowClock::lag_per_y()
};
using ImagePairs = FixedVector<ImagePair, kMaxImagePairs>;

/// Where to look for the road.
struct DenseRequest {
  Eigen::Vector3d normal_cam = Eigen::Vector3d::UnitY();  ///< expected; also a weak prior
  double height = 0.0;                                    ///< expected [vo]
  double sweep_ln_range = 0.0;                            ///< half range of the sweep in ln h
  RoadShape road;
};

/// Chooses the images to compare with: one at a short baseline and, when the ring has it, one at a
/// long baseline, in multiples of `height`.
[[nodiscard]] ImagePairs choose_image_pairs(const VoOutput& vo, const ImageRing& ring,
                                            const RowClock& clock, double height);

class DenseAlignment {
 public:
  DenseAlignment(const CameraModel& ring_camera, int num_levels);

  /// @pre pairs not empty, request.height > 0
  [[nodiscard]] DenseMeasurement measure(const Pyramid& now, const ImagePairs& pairs,
                                         const DenseRequest& request);

 private:
  struct Solution;
  double sweep(const Pyramid& now, const ImagePairs& pairs, const DenseRequest& request);
  bool refine(int level, const Pyramid& now, const ImagePairs& pairs, const DenseRequest& request,
              Solution* solution);
  void rate(const ImagePairs& pairs, DenseMeasurement* out);

  CameraModel camera_;
  int num_levels_;
  RoadPixels pixels_;
};

}  // namespace plumb
