/// One object that is tracked over frames.
///
/// Two extended Kalman filters estimate its 3D box on the road: one for a moving object and one for
/// a stationary object. How well each predicts the next box decides their odds, and the estimate is
/// their mixture. The stationary filter measures the distance from the camera's own motion,
/// by triangulation.
///
/// Frames:
///   ground of the newest image: x forward, y left, z up, on the road under the camera.
/// Memory:
///   Three states of dimension 9 with their covariances.
#pragma once

#include "modules/detections/detection.hpp"
#include "modules/objects/box_fit.hpp"
#include "modules/objects/track_view.hpp"

namespace plumb {

class ObjectTrack {
 public:
  /// Starts the track with the best of several headings. Returns false when the box fits no object
  /// on this road.
  bool start(const TrackView& view, const Detection& detection, const MeasuredBox& box);

  /// Predicts the state for the next image.
  void predict(const TrackView& view, const GroundMotion& motion);
  /// Corrects the state with the box of this object. Returns false when the box does not fit; the
  /// track then keeps its prediction. After several consecutive misfits it restarts with the box.
  bool correct(const TrackView& view, const Detection& detection, const MeasuredBox& box);
  /// Mean and covariance of the mixture of both filters.
  [[nodiscard]] const StateEstimate& estimate() const { return estimate_; }
  [[nodiscard]] ObjectClass object_class() const { return object_class_; }
  /// True when velocities are over ground, false when they are relative to the camera.
  [[nodiscard]] bool over_ground() const { return over_ground_; }

 private:
  /// Updates the two filters and their odds with the fits of a box.
  /// Returns false when it fits neither.
  bool update_hypotheses(const BoxFitResult& moving, const BoxFitResult& stationary);
  /// Corrects the heading of the moving filter with its velocity over ground,
  /// when it is fast enough.
  void align_with_motion();
  /// Initialises the stationary filter with the moving one, conditioned on zero velocity.
  void init_stationary();
  /// Sets the estimate to the mean and covariance of the mixture.
  void mix();

  StateEstimate estimate_;
  StateEstimate moving_;
  StateEstimate stationary_;
  double stationary_log_odds_ = 0.0;
  double since_update_s_ = 0.0;  ///< time since the odds were updated
  ObjectClass object_class_ = ObjectClass::kUnknown;
  bool over_ground_ = false;
  bool fresh_ = true;         ///< no prediction since the start: velocities are the prior
  double heading_rad_ = 0.0;  ///< the heading that the track started with
  bool was_whole_ = false;    ///< the box of the start was whole
  int num_misfits_ = 0;       ///< consecutive boxes that did not fit
  int num_other_class_ = 0;   ///< consecutive boxes of another class
};

}  // namespace plumb
