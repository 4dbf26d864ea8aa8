/// How far off objects are placed, on KITTI tracking sequences without images: the calibrated plane,
/// with and without the detection cue, by the foot point alone and by plumb-objects' tracks.
///
/// Metric   |Z - Z*| / Z* of the middle of the footprint, as in Song and Chandraker, CVPR 2014, section
///          6.4; close is Z* <= 10 m. Cars and vans that are whole and at most partly hidden in the
///          labels.
/// Fairness a sample counts for all methods or for none. Nothing but boxes, tracks and the calibration
///          is known: neither images nor the camera's own motion.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "modules/detections/detections_config.hpp"
#include "modules/objects/objects_config.hpp"

namespace plumb {

/// Foot: eq. (2) of the box's lower middle, half a class's length added. Track: plumb-objects.
enum PlacementMethod : std::size_t {
  kFootCalibrated = 0,
  kFootCue = 1,
  kTrackCalibrated = 2,
  kTrackCue = 3,
  kNumMethods = 4,
};
inline constexpr std::array<const char*, kNumMethods> kMethodNames{
    "foot point, calibrated plane", "foot point, detection cue", "3D track, calibrated plane",
    "3D track, detection cue"};

struct DepthErrors {
  std::size_t num_samples = 0;
  std::array<double, kNumMethods> sum_ratio{};     ///< of |Z - Z*| / Z*
  std::array<double, kNumMethods> sum_position{};  ///< of the distance in the plane over Z*
  double sum_nees = 0.0;  ///< kTrackCue: normalised squared error over its 2 dimensions

  void add(const DepthErrors& other);
  [[nodiscard]] double depth_percent(PlacementMethod method) const;     ///< NaN without samples
  [[nodiscard]] double position_percent(PlacementMethod method) const;  ///< NaN without samples
  [[nodiscard]] double mean_nees() const;                               ///< NaN without samples
};

struct SequenceDepth {
  std::string name;
  DepthErrors close;
  DepthErrors distant;
  std::size_t num_labels = 0;  ///< that the metric takes, found by the detector or not
  double pitch_rms_rad =
      0.0;  ///< of the cue against the plane through the labelled feet; NaN without
};

struct ObjectDepthOptions {
  std::filesystem::path root;  ///< holds calib/ and label_02/
  std::string boxes =
      "label_02";  ///< folder under root with the boxes to use: label_02, det2d/CIWT, ...
  std::vector<std::string> sequences;
  double camera_height_m = 1.65;
  DetectionsConfig detections;
  ObjectsConfig objects;
};

/// One entry per sequence. Throws InputError for files that are missing or wrong.
[[nodiscard]] std::vector<SequenceDepth> evaluate_object_depth(const ObjectDepthOptions& options);

/// All sequences together, as one of the name "all".
[[nodiscard]] SequenceDepth pool(const std::vector<SequenceDepth>& sequences);

/// A table: per sequence close and distant depth errors of all methods [%].
[[nodiscard]] std::string depth_table(const std::vector<SequenceDepth>& sequences);

}  // namespace plumb
