/// The height that one cue measures in one frame over a road whose normal is known.
///
/// Units:
///   [vo]; slope d(ln h) / d(n1, n3).
#pragma once

#include <Eigen/Core>

#include "modules/ground/types/cue_measurements.hpp"

namespace plumb {

struct HeightMeasurement {
  double ln_height = 0.0;
  double var = 0.0;  ///< from the cue's own noise; > 0
  Eigen::RowVector2d slope = Eigen::RowVector2d::Zero();
};

/// Height of the plane with normal `n` that fits the dense cue best: the minimum over 1/h of
/// (n/h - q)^T I (n/h - q) is h = n^T I n / (n^T I q).
[[nodiscard]] double height_given_normal(const DenseMeasurement& dense, const Eigen::Vector3d& n);

/// Mean of several height measurements, weighted by their inverse variances.
class HeightMean {
 public:
  void add(const HeightMeasurement& height);
  /// @pre at least one height was added
  [[nodiscard]] HeightMeasurement mean() const;

 private:
  HeightMeasurement sum_;  ///< each member weighted
  double information_ = 0.0;
};

}  // namespace plumb
