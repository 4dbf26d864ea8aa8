/// One object followed over frames: two Kalman filters over its 3D box on the road, one for an
/// object that moves and one for an object that stands, weighed by how well each foretells the next
/// box. What stands is seen from ever new places, so its distance follows from the camera's way.
///
/// Frames  ground of the newest image: x forward, y left, z up, on the road under the camera.
/// Memory  three states of 9 and their covariances.
#pragma once

#include <cstdint>

#include "core/camera_model.hpp"
#include "modules/detections/detection.hpp"
#include "modules/detections/detections_config.hpp"
#include "modules/objects/box_fit.hpp"
#include "modules/objects/objects_config.hpp"

namespace plumb {

/// How the ground axes moved from one image to the next.
struct GroundMotion {
  double dt_s = 0.0;
  /// False: the camera's motion is not known, t_m and yaw_rad do not hold, and velocities are
  /// relative to it.
  bool known = false;
  Eigen::Vector2d t_m = Eigen::Vector2d::Zero();  ///< new origin in old axes
  double yaw_rad = 0.0;                           ///< new axes against old, left positive
};

/// Everything a track needs to read a box.
struct TrackView {
  const DetectionsConfig& detections;
  const ObjectsConfig& objects;
  const CameraModel& camera;
  RoadPlane plane;
};

class ObjectTrack {
 public:
  /// Begins with the best of several headings. False when the box fits no object on this road.
  bool start(const TrackView& view, const Detection& detection, const MeasuredBox& box);

  /// To the next image.
  void predict(const TrackView& view, const GroundMotion& motion);
  /// Takes the box of this track in this image. False when it fits badly: the track keeps its
  /// prediction, or begins anew when boxes went on not to fit.
  bool correct(const TrackView& view, const Detection& detection, const MeasuredBox& box);
  /// Mean and covariance of both filters together.
  [[nodiscard]] const StateEstimate& estimate() const { return estimate_; }
  [[nodiscard]] ObjectClass object_class() const { return object_class_; }
  /// Velocities are over ground; else relative to the camera.
  [[nodiscard]] bool over_ground() const { return over_ground_; }

 private:
  [[nodiscard]] StateEstimate prior(const TrackView& view, const Detection& detection,
                                    const MeasuredBox& box, double yaw_rad) const;

  /// Odds and survival of the two filters after a box was fitted to both. False: it fits neither.
  bool weigh(const BoxFitResult& moving, const BoxFitResult& standing);
  /// Heading of the moving filter from its velocity over ground, where there is one.
  void align_with_motion();
  /// The object may stand: what the moving filter would hold if it did.
  void seed_standing();
  void mix();

  StateEstimate estimate_;
  StateEstimate moving_;
  StateEstimate standing_;
  double standing_log_odds_ = 0.0;
  double unweighed_s_ = 0.0;  ///< since the odds last heard of a box
  ObjectClass object_class_ = ObjectClass::kUnknown;
  bool over_ground_ = false;
  bool fresh_ = true;         ///< since the start: velocities are those of the prior
  double heading_rad_ = 0.0;  ///< the heading that the start preferred
  bool was_whole_ = false;    ///< since the start
  int num_misfits_ = 0;       ///< in a row
  int num_other_class_ = 0;   ///< in a row
};

/// The box of a detection with the deviation of each edge: the detector's, larger for a hidden edge.
[[nodiscard]] MeasuredBox measured_box(const DetectionsConfig& config, const CameraModel& camera,
                                       const DetectionFrame& frame, std::size_t index);

}  // namespace plumb
