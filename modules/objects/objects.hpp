/// Objects on the road in 3D: tracks over frames with place, heading, size and velocity, each with
/// its deviation.
///
/// Pure algorithm: no clock, no I/O, no heap after construction. `main.cpp` is the process around
/// it.
///
/// Frames  ground: x forward, y left, z up, on the road under the camera. Positions are of the
/// middle of
///         the footprint, velocities over ground, both in the axes of the newest image.
/// Units   SI.
/// Memory  kMaxObjects tracks in place, 95 kB; nothing grows. The nearest are kept when there are
/// more.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "core/camera_model.hpp"
#include "core/fixed_vector.hpp"
#include "modules/detections/detection.hpp"
#include "modules/detections/detections_config.hpp"
#include "modules/objects/object_track.hpp"
#include "modules/objects/objects_config.hpp"

namespace plumb {

inline constexpr std::size_t kMaxObjects = 32;

/// Same numbers as object_t.STATUS_*.
enum class ObjectStatus : std::int8_t { kMeasured = 0, kPredicted = 1, kNotLocalised = 2 };

/// Same numbers as object_t.REASON_*.
enum class ObjectReason : std::int8_t {
  kNone = 0,
  kCut = 1,              ///< measured from the edges that the image does not cut
  kHidden = 2,           ///< measured although nearer boxes hide an edge
  kCalibratedPlane = 3,  ///< measured on the calibrated plane: GROUND_PLANE does not hold
  kNotSeen = 4,          ///< predicted: no box in this image
  kMisfit = 5,           ///< predicted: its box does not fit it
  kNoFit = 6,            ///< not localised: the box fits no object on this road
};

struct ObjectOutput {
  std::int32_t track_id = -1;  ///< the detector's; kFirstOwnId and up where it has none
  ObjectClass object_class = ObjectClass::kUnknown;
  ObjectStatus status = ObjectStatus::kNotLocalised;
  ObjectReason reason = ObjectReason::kNone;
  // The rest holds unless kNotLocalised.
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();
  Eigen::Matrix2d position_cov_m2 = Eigen::Matrix2d::Zero();
  bool velocity_holds = false;  ///< false while the camera's own motion is not known
  Eigen::Vector2d velocity_m_s = Eigen::Vector2d::Zero();
  Eigen::Matrix2d velocity_cov_m2_s2 = Eigen::Matrix2d::Zero();
  double yaw_rad = 0.0;  ///< heading; front and rear are told apart once it moves
  double yaw_std_rad = 0.0;
  Eigen::Vector3d size_m = Eigen::Vector3d::Zero();  ///< length, width, height
  Eigen::Vector3d size_std_m = Eigen::Vector3d::Zero();
  double time_to_collision_s = 0.0;  ///< range over closing speed; NaN while it does not close
  double age_s = 0.0;
};

struct ObjectsInput {
  const DetectionFrame* frame = nullptr;  ///< never null
  RoadPlane plane;                        ///< of the frame's image
  bool plane_measured = false;            ///< false: `plane` is the calibrated one
  GroundMotion motion;                    ///< since the image of the previous update
};

struct ObjectsOutput {
  std::int64_t capture_us = 0;
  std::int64_t seq = 0;
  FixedVector<ObjectOutput, kMaxObjects> objects;  ///< nearest first
  std::int32_t num_refused = 0;                    ///< detections that found no room
};

/// One `update` per DETECTIONS message, in order of capture. Deterministic.
class ObjectTracker {
 public:
  static constexpr std::int32_t kFirstOwnId = 1 << 20;

  /// @pre configs inside the ranges of their visit()
  ObjectTracker(const DetectionsConfig& detections, const ObjectsConfig& objects,
                const CameraModel& camera);

  /// The result stays valid until the next call.
  const ObjectsOutput& update(const ObjectsInput& input);

 private:
  static constexpr std::size_t kNone = kMaxObjects;

  struct Slot {
    bool in_use = false;
    bool localised = false;
    bool seen = false;  ///< has a box in this image
    std::int32_t track_id = -1;
    ObjectTrack track;
    ObjectReason reason = ObjectReason::kNone;
    std::int64_t begun_us = 0;
    std::int64_t seen_us = 0;
  };
  using Matches = std::array<std::size_t, kMaxDetections>;  ///< slot of each detection

  void predict(const TrackView& view, const ObjectsInput& input);
  void match(const TrackView& view, const DetectionFrame& frame, Matches* matches);
  void match_by_overlap(const TrackView& view, const DetectionFrame& frame, Matches* matches);
  void take(const TrackView& view, const ObjectsInput& input, std::size_t index, std::size_t slot);
  [[nodiscard]] std::size_t room_for(const TrackView& view, const Detection& detection);
  void end_tracks(std::int64_t capture_us);
  void report(const TrackView& view, const ObjectsInput& input);

  DetectionsConfig detections_;
  ObjectsConfig objects_;
  CameraModel camera_;
  std::array<Slot, kMaxObjects> slots_{};
  std::array<std::array<double, kMaxObjects>, kMaxDetections> overlap_{};
  std::int32_t next_own_id_ = kFirstOwnId;
  ObjectsOutput output_;
};

}  // namespace plumb
