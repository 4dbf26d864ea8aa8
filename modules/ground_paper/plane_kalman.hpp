/// The Kalman filter of the paper, equations (3) and (4): the state x = (n, h) is a plane that
/// stays in the world while the camera moves.
///
/// With n pointing down and n . X = h, a camera that moves by (R, t) = T_prev_cam sees
///   n' = R^T n,  h' = h - n . t.
/// The paper prints A = [R t; 0 1]^T, which is this for a normal that points up.
///
/// Frames:
///   cam of the newest image.
/// Units:
///   The unit of length is that of t.
#pragma once

#include <Eigen/Core>

#include "core/se3.hpp"
#include "modules/ground_paper/cue_fusion.hpp"

namespace plumb {

class PlaneKalman {
 public:
  struct Noise {
    double normal_std = 0.0;  ///< of each component of n, per frame
    double height_std = 0.0;  ///< of h, per frame
  };

  explicit PlaneKalman(const Noise& noise) : noise_(noise) {}

  void start(const Eigen::Vector3d& normal, double height, double normal_var, double height_var);
  void predict(const Se3& T_prev_cam);
  /// Fuses z = H x, where H selects those of n1, n3 and h that were observed.
  void observe(const CueFusion& fused);

  /// Changes the unit of length: h becomes h / s.
  void divide_unit(double s);
  /// Adds to the variance of h.
  void add_height_var(double var) { P_(3, 3) += var; }
  /// Sets h to `height` and keeps its variance.
  void hold_height(double height) { h_ = height; }

  [[nodiscard]] const Eigen::Vector3d& normal() const { return n_; }
  [[nodiscard]] double height() const { return h_; }
  [[nodiscard]] const Eigen::Matrix4d& cov() const { return P_; }

 private:
  Noise noise_;
  Eigen::Vector3d n_ = Eigen::Vector3d::UnitY();
  double h_ = 0.0;
  Eigen::Matrix4d P_ = Eigen::Matrix4d::Zero();
};

}  // namespace plumb
