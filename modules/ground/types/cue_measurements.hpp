/// What each cue measures in one frame, before any covariance is attached to it.
///
/// Frames:
///   cam of the newest image: x right, y down, z forward; the normal points down.
/// Units:
///   [vo], VO's own unit of length; grey levels 0..255.
#pragma once

#include <Eigen/Core>

namespace plumb {

/// Direction of translation over a chord of the camera's path (chord.hpp).
struct Chord {
  bool valid = false;
  double step = 0.0;                                     ///< |t| of this frame [vo]
  int num_frames = 0;                                    ///< images between the chord's ends
  double length = 0.0;                                   ///< [vo]
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  ///< along the chord, in cam now
  double curvature = 0.0;                                ///< of the path, seen from above [1/vo]
};

/// The plane at which the newest image agrees with older ones (dense_alignment.hpp).
struct DenseMeasurement {
  bool ok = false;
  Eigen::Vector3d q = Eigen::Vector3d::Zero();            ///< n / h [1/vo]
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();  ///< of q, from pixel noise alone
  double sigma_grey = 0.0;                                ///< scale of the residuals
  double sad = 0.0;  ///< mean |residual| at q, gain and bias removed
  double ncc = 0.0;  ///< correlation of the images at q
  /// Correlation of the images if nothing had moved. If it exceeds `ncc`, the pixels show something
  /// that moves with the camera instead of road: an overlay or the back of a truck.
  double still_ncc = 0.0;
  int num_pixels = 0;  ///< at the finest level, all pairs
};

/// The height on which the road points agree (road_point_vote.hpp).
struct PointsMeasurement {
  bool ok = false;
  double ln_height = 0.0;                            ///< along the requested normal
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< weighted mean of the agreeing points
  double ln_height_std = 0.0;                        ///< spread of the agreeing points
  double score = 0.0;                                ///< of the winning point
  int num_candidates = 0;
  int num_inliers = 0;
};

/// The camera's pitch from detected objects (objects_queue.hpp).
struct ObjectsMeasurement {
  double n3 = 0.0;
  double n3_var = 0.0;      ///< > 0
  double confidence = 0.0;  ///< feature that n3_var was predicted from: variance by the boxes alone
  double quality = 0.0;     ///< [0, 1]
};

}  // namespace plumb
