/// A drive without pictures, with labels of known places and the tables of a replay with known
/// errors.
#pragma once

#include <filesystem>
#include <string>

#include "modules/datasets/text.hpp"
#include "modules/detections/road_plane.hpp"
#include "tests/support/temp_folder.hpp"

namespace plumb::test {

inline constexpr int kPlacedFrames = 12;
inline constexpr double kPlacedFx_px = 720.0;

/// Nose down by 0.6 degrees, which the calibration does not know.
inline RoadPlane placed_road() {
  RoadPlane road;
  road.pitch_rad = 0.01;
  road.height_m = 1.65;
  return road;
}

/// The camera drives 1 m per frame and 10 m/s.
class PlacedDrive {
 public:
  explicit PlacedDrive(bool with_images = true) {
    std::string times, poses;
    const Eigen::Vector3d ahead = placed_road().R_ground_cam().transpose().col(0);
    for (int i = 0; i < kPlacedFrames; ++i) {
      if (with_images) folder_.write(format("drive/image_0/%06d.png", i), "");
      times += format("%.1f\n", 0.1 * i);
      poses +=
          format("1 0 0 %.9f 0 1 0 %.9f 0 0 1 %.9f\n", i * ahead.x(), i * ahead.y(), i * ahead.z());
      frames_ += format("%d,ok,%.9f,%.9f,0\n", i, placed_road().height_m, placed_road().pitch_rad);
    }
    folder_.write("drive/times.txt", times);
    folder_.write("drive/poses.txt", poses);
    folder_.write("drive/calib.txt",
                  "P0: 720 0 600 0 0 720 170 0 0 0 1 0\nP2: 720 0 600 0 0 720 170 0 0 0 1 0\n"
                  "residual_k1: 0\ncamera_height_m: 1.65\n");
  }

  /// A labelled car, said to stand `off_m` too far. `cell`: x_std_m, y_std_m, xy_cov_m2.
  void add(int frame, int id, double x_m, double off_m, const std::string& cells,
           const std::string& type = "Car 0 0") {
    const Eigen::Vector3d foot = placed_road().cam_from_ground({x_m, 0.0, 0.0});
    // The foot is the box's lower edge half a car's length nearer.
    const double rear_m = foot.z() - 0.5 * 1.67 * 2.4;
    const RoadPlane road = placed_road();
    const Eigen::Vector3d n = road.normal_cam();
    const double bottom_px = 170.0 + kPlacedFx_px * (road.height_m / rear_m - n.z()) / n.y();
    labels_ += format("%d %d %s 0 590 %.9f 610 %.9f 1.5 1.67 4 %.9f %.9f %.9f -1.57\n", frame, id,
                      type.c_str(), bottom_px - 30.0, bottom_px, foot.x(), foot.y(), foot.z());
    objects_ += format("%d,%d,%.9f,0,", frame, id, x_m + off_m) + cells + "\n";
  }
  void add_row(const std::string& row) { objects_ += row + "\n"; }
  void add_label(const std::string& row) { labels_ += row + "\n"; }
  void write_boxes(const std::string& text) { folder_.write("drive/det2d/T.txt", text); }

  /// Folder of the drive; writes everything.
  std::filesystem::path write() {
    folder_.write("drive/label_02.txt", labels_);
    folder_.write("frames.csv", "seq,plane_status,height_m,pitch_rad,roll_rad\n" + frames_);
    folder_.write("objects.csv", "seq,track_id,x_m,y_m,x_std_m,y_std_m,xy_cov_m2\n" + objects_);
    return folder_ / "drive";
  }
  [[nodiscard]] std::filesystem::path file(const std::string& name) const { return folder_ / name; }

 private:
  TempFolder folder_;
  std::string labels_, frames_, objects_;
};

}  // namespace plumb::test
