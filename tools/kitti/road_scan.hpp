/// The road plane ahead of the camera from one scan of a Velodyne HDL-64.
///
/// Model:
///   A hundred planes through three drawn points each compete for the points that lie near them.
///   The best one is refined by least squares on the points near it, with Tukey's weights.
/// Frames:
///   velo: x forward, y left, z up. cam: the left rectified camera, x right, y down, z forward. The
///   plane is normal_cam . X = height; its normal points down.
/// Errors:
///   Functions that read files throw InputError.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <vector>

#include "core/se3.hpp"
#include "modules/datasets/kitti/plane_file.hpp"

namespace plumb {

/// Which points may be road. The defaults are those of the plane files that the tests compare with.
struct RoadScanOptions {
  double from_m = 5.0;  ///< distance ahead of the camera
  double to_m = 20.0;
  double half_width_m = 2.5;  ///< to either side
  double beam_deg = 0.0;      ///< by how much every beam really points higher than the file says
};

struct RoadScan {
  TruePlane plane;
  int num_candidates = 0;
  int num_inliers = 0;
  double rms_m = 0.0;  ///< of the inliers
};

/// Reads T_cam_velo of a drive: from calib.txt (Tr, or R0_rect and Tr_velo_to_cam), or from a raw
/// drive's calib_velo_to_cam.txt and calib_cam_to_cam.txt in its folder or the one above.
[[nodiscard]] Se3 read_T_cam_velo(const std::filesystem::path& drive);

/// Reads the points of a scan, rows of x, y, z in velo [m]. With a file of labels (SemanticKITTI,
/// one 32-bit word per point) only road and its markings are kept.
[[nodiscard]] std::vector<Eigen::Vector3d> read_scan(const std::filesystem::path& scan,
                                                     const std::filesystem::path& labels);

/// Returns nothing when fewer than a hundred points agree on a plane below the camera.
[[nodiscard]] std::optional<RoadScan> fit_road(const std::vector<Eigen::Vector3d>& points_velo,
                                               const Se3& T_cam_velo,
                                               const RoadScanOptions& options);

}  // namespace plumb
