/// What is reported about one object.
///
/// Frames:
///   ground of the newest image, as in objects.hpp.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "core/numbers.hpp"
#include "modules/detections/detection.hpp"
#include "modules/objects/object_track.hpp"
#include "modules/objects/track_view.hpp"

namespace plumb {

/// The numbers are those of object_t.STATUS_*.
enum class ObjectStatus : std::int8_t { kMeasured = 0, kPredicted = 1, kNotLocalised = 2 };

/// The numbers are those of object_t.REASON_*.
enum class ObjectReason : std::int8_t {
  kNone = 0,
  kCut = 1,              ///< measured with the edges that the image does not cut
  kHidden = 2,           ///< measured although nearer boxes hide an edge
  kCalibratedPlane = 3,  ///< measured on the calibrated plane, as GROUND_PLANE is not valid
  kNotSeen = 4,          ///< predicted, because the image has no box of it
  kMisfit = 5,           ///< predicted, because its box does not fit the track
  kNoFit = 6,            ///< not localised, because its box fits no object on the road
};

struct ObjectOutput {
  std::int32_t track_id = -1;  ///< the detector's id, or one from ObjectTracker::kFirstOwnId on
  ObjectClass object_class = ObjectClass::kUnknown;
  ObjectStatus status = ObjectStatus::kNotLocalised;
  ObjectReason reason = ObjectReason::kNone;
  double age_s = 0.0;
  // The fields below are valid unless the status is kNotLocalised.
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();
  Eigen::Matrix2d position_cov_m2 = Eigen::Matrix2d::Zero();
  bool velocity_valid = false;  ///< false while the camera's own motion is unknown
  Eigen::Vector2d velocity_m_s = Eigen::Vector2d::Zero();
  Eigen::Matrix2d velocity_cov_m2_s2 = Eigen::Matrix2d::Zero();
  double yaw_rad = 0.0;  ///< heading; only motion distinguishes front and rear
  double yaw_std_rad = 0.0;
  Eigen::Vector3d size_m = Eigen::Vector3d::Zero();  ///< length, width, height
  Eigen::Vector3d size_std_m = Eigen::Vector3d::Zero();
  /// Range over closing speed; NaN while the range does not decrease.
  double time_to_collision_s = kNan;
};

/// Fills the fields that follow from the state of a localised track.
[[nodiscard]] ObjectOutput output_of(const ObjectTrack& track, const TrackView& view,
                                     const GroundMotion& motion);

}  // namespace plumb
