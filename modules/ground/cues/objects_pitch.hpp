/// The camera's pitch from the detected objects of one image, and which of them are consistent with
/// it.
///
/// Frames:
///   cam, ground and the sign of the pitch as in road_plane.hpp.
/// Source:
///   Song and Chandraker, CVPR 2014: equation (9) in closed form, equation (10) for the confidence
///   in a box. In addition, a track keeps the height that was measured, and boxes are combined
///   robustly.
/// Memory:
///   Heights, votes and one mixture fit in place, 60 kB; nothing grows.
#pragma once

#include <array>
#include <cstdint>

#include "core/camera_model.hpp"
#include "modules/detections/box_screen.hpp"
#include "modules/detections/detection.hpp"
#include "modules/detections/detections_config.hpp"
#include "modules/ground/cues/candidate_mixture.hpp"
#include "modules/ground/cues/height_filter.hpp"
#include "modules/ground/cues/robust_mean.hpp"

namespace plumb {

struct ObjectsPitchInput {
  const DetectionFrame* frame = nullptr;  ///< never null
  double height_m = 0.0;                  ///< of the camera; never VO's, which drifts
  double height_std_ratio = 0.01;
  double roll_rad = 0.0;
  double roll_std_rad = 0.01;
  bool has_other = false;  ///< another cue has measured this frame's pitch:
  double other_pitch_rad = 0.0;
  double other_var_rad2 = 0.0;
};

/// Same numbers as ground_cue_t.status, as far as the objects decide it.
enum class ObjectsPitchStatus : std::int8_t { kValid = 0, kAbsent = 1, kFailed = 3 };

struct ObjectsPitchOutput {
  ObjectsPitchStatus status = ObjectsPitchStatus::kAbsent;
  // From the boxes alone, without any prior of the pitch: an observation to fuse. kValid only.
  double n3 = 0.0;
  double n3_var = 0.0;
  double quality = 0.0;  ///< [0, 1] share of the boxes' weight that agrees
  // From the boxes, the slow pitch and the other cue's pitch: an estimate to use. Always valid.
  double pitch_rad = 0.0;
  double pitch_var_rad2 = 0.0;

  int num_used = 0;
  Verdicts verdicts{};                                  ///< of every detection of the frame
  std::array<double, kMaxDetections> height_m{};        ///< present estimate; 0 where there is none
  std::array<double, kMaxDetections> confidence_px2{};  ///< the paper's a_d; 0 without candidates
};

/// One `update` per DETECTIONS message, in order of capture. Deterministic.
class ObjectsPitch {
 public:
  /// @pre config inside the ranges of its visit()
  ObjectsPitch(const DetectionsConfig& config, const CameraModel& camera);

  /// The result stays valid until the next call.
  const ObjectsPitchOutput& update(const ObjectsPitchInput& input);

 private:
  /// One box that passed the screen.
  struct Reading {
    std::size_t index = 0;  ///< in the frame
    std::size_t slot = 0;
    double log_height = 0.0;  ///< with which it was read
    double pitch_rad = 0.0;
    double J_height = 0.0;  ///< d pitch / d ln height
    double var_rad2 = 0.0;  ///< from the box, given its height
    double std_rad = 0.0;   ///< including the height's uncertainty
    double weight = 0.0;    ///< agreement with the others, 0 .. 1
  };
  using Readings = FixedVector<Reading, HeightFilter::kMaxHeights>;

  void begin(std::int64_t capture_us);
  [[nodiscard]] RoadPlane expected_plane(const ObjectsPitchInput& input) const;
  void read_boxes(const ObjectsPitchInput& input);
  bool read_box(const ObjectsPitchInput& input, Reading* reading);
  [[nodiscard]] double edge_var_px2(const DetectionFrame& frame, std::size_t index);
  void add_to_mixture(const Detection& detection);
  bool fit_candidates(const DetectionFrame& frame, std::size_t index);
  void judge(const ObjectsPitchInput& input);
  void combine(const ObjectsPitchInput& input);
  void finish(const ObjectsPitchInput& input);

  DetectionsConfig config_;
  CameraModel camera_;
  HeightFilter filter_;
  CandidateMixture mixture_;
  Readings readings_;
  Votes votes_;
  std::array<double, HeightFilter::kMaxHeights> disagreement_{};  ///< smoothed, in sigmas
  std::int64_t last_us_ = 0;
  bool started_ = false;
  ObjectsPitchOutput output_;
};

}  // namespace plumb
