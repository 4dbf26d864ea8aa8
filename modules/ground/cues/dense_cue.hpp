/// Dense cue: the plane q = n/h that makes the road of this image agree with one or two older
/// images.
///
/// Gauss-Newton on q with gain and bias per image pair, Student-t weights, coarse to fine, after a
/// sweep over heights that keeps it out of a wrong minimum.
///
/// Frames  cam of the newest image.  Units  [vo], grey levels.  Memory  one RoadPixels; no heap
/// after construction.
#pragma once

#include <Eigen/Core>

#include "core/fixed_vector.hpp"
#include "modules/ground/cues/image_ring.hpp"
#include "modules/ground/cues/plane_warp.hpp"
#include "modules/ground/cues/road_pixels.hpp"
#include "modules/ground/cues/row_clock.hpp"
#include "modules/vo/vo.hpp"

namespace plumb {

inline constexpr std::size_t kMaxImagePairs = 2;

/// An older image and the motion to it.
struct ImagePair {
  const Pyramid* old_image = nullptr;
  Se3 T_old_cam;
  double lag_per_y = 0.0;  ///< of RowClock
};
using ImagePairs = FixedVector<ImagePair, kMaxImagePairs>;

/// Where to look.
struct DenseRequest {
  Eigen::Vector3d normal_cam = Eigen::Vector3d::UnitY();  ///< expected; also a weak prior
  double height = 0.0;                                    ///< expected [vo]
  double sweep_ln_range = 0.0;                            ///< half range of the sweep in ln h
  RoadShape road;
};

struct DenseObservation {
  bool ok = false;
  Eigen::Vector3d q = Eigen::Vector3d::Zero();            ///< n / h [1/vo]
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();  ///< of q, pixel noise alone
  double sigma_grey = 0.0;                                ///< scale of the residuals
  double sad = 0.0;  ///< mean |residual| at q, gain and bias removed
  double ncc = 0.0;  ///< correlation at q
  /// The same if nothing had moved in the image. Above `ncc` it is no road that is seen but what travels with us: an
  /// overlay, or the back of a truck.
  double still_ncc = 0.0;
  int num_pixels = 0;  ///< at the finest level, all pairs
};

/// Images to compare with: one at a short and, when held, one at a long baseline, in multiples of
/// `height`.
[[nodiscard]] ImagePairs choose_image_pairs(const VoOutput& vo, const ImageRing& ring,
                                            const RowClock& clock, double height);

class DenseCue {
 public:
  DenseCue(const CameraModel& ring_camera, int num_levels);

  /// @pre pairs not empty, request.height > 0
  [[nodiscard]] DenseObservation measure(const Pyramid& now, const ImagePairs& pairs,
                                         const DenseRequest& request);

 private:
  struct Solution;
  double sweep(const Pyramid& now, const ImagePairs& pairs, const DenseRequest& request);
  bool refine(int level, const Pyramid& now, const ImagePairs& pairs, const DenseRequest& request,
              Solution* solution);
  void rate(const ImagePairs& pairs, DenseObservation* out);

  CameraModel camera_;
  int num_levels_;
  RoadPixels pixels_;
};

}  // namespace plumb
