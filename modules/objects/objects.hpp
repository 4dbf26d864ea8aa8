/// Tracks objects on the road over frames and reports their position, heading, size and velocity in
/// 3D, each with its standard deviation. This is an algorithm without a
/// clock and without input or output.
///
/// Frames:
///   ground of the newest image: x forward, y left, z up, on the road under the camera. Positions
///   are those of the centre of the footprint; velocities are over ground.
/// Units:
///   SI.
/// Memory:
///   kMaxObjects tracks in place, 95 kB. Nothing is allocated after construction. When there are
///   more objects, the nearest are kept.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "core/camera_model.hpp"
#include "core/fixed_vector.hpp"
#include "modules/detections/detection.hpp"
#include "modules/detections/detections_config.hpp"
#include "modules/objects/object_output.hpp"
#include "modules/objects/object_track.hpp"
#include "modules/objects/objects_config.hpp"

namespace plumb {

inline constexpr std::size_t kMaxObjects = 32;

struct ObjectsInput {
  const DetectionFrame* frame = nullptr;  ///< not null
  RoadPlane plane;                        ///< plane in the image of the frame
  bool plane_measured = false;            ///< false when `plane` is the calibrated one
  GroundMotion motion;                    ///< motion since the image of the previous update
};

struct ObjectsOutput {
  std::int64_t capture_us = 0;
  std::int64_t seq = 0;
  FixedVector<ObjectOutput, kMaxObjects> objects;  ///< nearest first
  std::int32_t num_refused = 0;                    ///< detections without a free track
};

/// Takes one update() per DETECTIONS message, in the order of capture. Deterministic.
class ObjectTracker {
 public:
  static constexpr std::int32_t kFirstOwnId = 1 << 20;

  /// @pre the settings are inside the ranges of their visit()
  ObjectTracker(const DetectionsConfig& detections, const ObjectsConfig& objects,
                const CameraModel& camera);

  /// The result is valid until the next call.
  const ObjectsOutput& update(const ObjectsInput& input);

 private:
  static constexpr std::size_t kNone = kMaxObjects;

  struct Slot {
    bool in_use = false;
    bool localised = false;
    bool seen = false;  ///< a box of this image belongs to the object
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
  void update_slot(const TrackView& view, const ObjectsInput& input, std::size_t index,
                   std::size_t slot);
  [[nodiscard]] std::size_t slot_for(const TrackView& view, const Detection& detection);
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
