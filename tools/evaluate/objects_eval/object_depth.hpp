/// Measures how far off objects are placed on KITTI tracking sequences, from boxes alone.
///
/// Methods:
///   The calibrated plane with and without the detection cue, each with the foot point alone and
///   with plumb-objects' tracks.
/// Metric:
///   |Z - Z*| / Z* for the middle of the footprint, as in Song and Chandraker, CVPR 2014, section
///   6.4. Up to Z* = 10 m an object is close. Cars and vans must be whole in the image and at
///   most partly hidden.
/// Fairness:
///   A sample counts for all methods or for none. All of them know boxes, tracks and the
///   calibration, and neither images nor the camera's motion.
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
  std::size_t num_labels = 0;  ///< labels that the metric takes, detected or not
  double pitch_rms_rad =
      0.0;  ///< of the cue against the plane through the labelled feet; NaN without any
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

/// All sequences together, as one sequence named "all".
[[nodiscard]] SequenceDepth pool(const std::vector<SequenceDepth>& sequences);

/// A table with the close and distant depth errors of all methods [%] per sequence.
[[nodiscard]] std::string depth_table(const std::vector<SequenceDepth>& sequences);

}  // namespace plumb
