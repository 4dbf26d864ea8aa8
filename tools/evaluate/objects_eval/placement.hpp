/// How far off the whole chain places objects: plumb-replay's tables against the labels of the drive.
///
/// Metric   |Z - Z*| / Z* of the middle of the footprint, as in Song and Chandraker, CVPR 2014, section 6.4, and the
///          distance in space over Z*; close is Z* <= 10 m. Labels that are whole and at most partly hidden.
/// Beside   the foot point of the same box alone, on the reported plane and on the calibrated one (eq. (2)).
/// Frames   cam: that of the images the boxes are of (P2 of a KITTI drive); ground: on the road under it, of the
///          plane that the chain reported for the image.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "modules/detections/road_plane.hpp"
#include "modules/objects/objects_config.hpp"

namespace plumb {

struct PlacementOptions {
  std::string boxes =
      "label_02.txt";  ///< in the drive's folder: those that the table was made from
  std::vector<ObjectClass> classes{ObjectClass::kCar, ObjectClass::kVan};
  ObjectsConfig objects;
  double calibrated_pitch_rad = 0.0;
  double camera_height_m = 1.65;  ///< where the drive's calibration states none
};

/// A label that the table has a place for.
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
  double speed_m_s = 0.0;  ///< true, over ground, mean of up to a second; NaN when not known
};

struct DrivePlacement {
  std::string name;
  std::size_t num_labels = 0;  ///< that the metric takes, placed or not
  std::vector<PlacementSample> samples;
};

/// `drive`: folder with images, calib.txt, label_02.txt and, to tell what moves, poses. `frames_csv` and `objects_csv`:
/// what plumb-replay wrote with --csv and --objects for it. Throws InputError.
[[nodiscard]] DrivePlacement evaluate_placement(const std::filesystem::path& drive,
                                                const std::filesystem::path& frames_csv,
                                                const std::filesystem::path& objects_csv,
                                                const PlacementOptions& options);

}  // namespace plumb
