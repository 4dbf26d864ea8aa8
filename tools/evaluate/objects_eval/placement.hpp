/// Compares the places of objects in plumb-replay's tables with the labels of the drive.
///
/// Metric:
///   |Z - Z*| / Z* for the middle of the footprint, as in Song and Chandraker, CVPR 2014, section
///   6.4, and the distance in space over Z*. Up to Z* = 10 m an object is close. Labels must be
///   whole in the image and at most partly hidden.
/// Beside:
///   The foot point of the same box alone, on the reported plane and on the calibrated one
///   (eq. (2)), serves for comparison.
/// Frames:
///   cam: the camera of the images with the boxes (P2 of a KITTI drive); ground: on the road
///   under the camera, on the plane that the chain reported for the image.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "modules/detections/road_plane.hpp"
#include "modules/objects/objects_config.hpp"

namespace plumb {

struct PlacementOptions {
  std::string boxes =
      "label_02.txt";  ///< file in the drive's folder with the boxes that were replayed
  std::vector<ObjectClass> classes{ObjectClass::kCar, ObjectClass::kVan};
  ObjectsConfig objects;
  double calibrated_pitch_rad = 0.0;
  double camera_height_m = 1.65;  ///< used when the drive's calibration states none
};

/// A label with a place in the table.
struct PlacementSample {
  int frame = 0;
  std::int32_t track_id = -1;  ///< the label's
  double truth_m = 0.0;        ///< Z*
  double depth_m = 0.0;        ///< Z
  double depth_std_m = 0.0;
  double position_error_m = 0.0;  ///< in space
  double depth_nees = 0.0;        ///< squared error over variance, along the road
  double position_nees = 0.0;     ///< normalised squared error in the plane, over its 2 dimensions
  double foot_m = 0.0;            ///< Z of the foot point on the reported plane
  double foot_calibrated_m = 0.0;
  double speed_m_s = 0.0;  ///< true speed over ground, mean over up to a second; NaN when unknown
};

struct DrivePlacement {
  std::string name;
  std::size_t num_labels = 0;  ///< labels that the metric takes, placed or not
  std::vector<PlacementSample> samples;
};

/// `drive` is a folder with calib.txt, label_02.txt, images and, to tell what moves, poses. A
/// folder without images has one row per frame in times.txt and poses.txt. plumb-replay wrote
/// `frames_csv` and `objects_csv` for the drive with --csv and --objects. Throws InputError.
[[nodiscard]] DrivePlacement evaluate_placement(const std::filesystem::path& drive,
                                                const std::filesystem::path& frames_csv,
                                                const std::filesystem::path& objects_csv,
                                                const PlacementOptions& options);

}  // namespace plumb
