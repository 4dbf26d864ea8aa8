// A fuzz target for the text files of KITTI: calibration, poses, times, planes, and the labels that
// serve as a file of detections. The first byte says which one the rest is.
#include <cmath>

#include "core/input_error.hpp"
#include "modules/datasets/folder/image_name.hpp"
#include "modules/datasets/kitti/calibration.hpp"
#include "modules/datasets/kitti/plane_file.hpp"
#include "modules/datasets/kitti/pose_file.hpp"
#include "modules/datasets/kitti/times.hpp"
#include "tests/fuzz/fuzz_input.hpp"
#include "tools/datasets/kitti_tracking/kitti_tracking.hpp"

namespace plumb {
namespace {

using fuzz::require;

void read_calibration(const std::string& path) {
  const CalibrationFile file(path);
  for (const char* key : {"residual_k1", "camera_height_m"}) {
    const auto number = file.optional_number(key);
    require(!number || std::isfinite(*number));
  }
  const RectifiedCamera camera = read_projection(file, "P0");
  require(camera.model.fx_px > 0.0 && camera.model.fy_px > 0.0);
  require(camera.t_left_cam_m.allFinite());
}

void read_labels(const std::string& path) {
  const std::vector<TrackingRow> rows = read_tracking(path);
  if (rows.empty()) return;
  (void)detections_of_frame(rows, rows.front().frame);
  for (const TrackingRow& row : rows) require(std::isfinite(row.rotation_y_rad));
}

void read_pose_rows(const std::string& path) {
  for (const PoseMatrix& pose : read_poses(path)) require(pose.allFinite());
}

void read_plane_rows(const std::string& path) {
  for (const auto& [frame, plane] : read_planes(path)) {
    require(plane.height_m > 0.0 && plane.normal_cam.y() > 0.0);
    require(std::isfinite(plane.pitch_rad()) && std::isfinite(plane.roll_rad()));
  }
}

void read_names(std::string_view text) {
  std::vector<ImageName> names;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    names.push_back(read_image_name(std::string(text.substr(0, end))));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  if (names.empty()) return;
  (void)are_named_by_time(names);
  if (const auto numbers = count_by_names(names)) require(common_step(*numbers) >= 1);
}

void read_one(fuzz::Orders orders) {
  static const fuzz::MemoryFile kFile;
  const std::uint8_t kind = orders.byte() % 8;
  const fuzz::Bytes content = orders.rest();
  kFile.write(content);
  const std::string path = kFile.path();
  switch (kind) {
    case 0:
      return read_calibration(path);
    case 1:
      return read_pose_rows(path);
    case 2:
      return read_plane_rows(path);
    case 3:
      return (void)read_odometry_times_us(path);
    case 4:
      return (void)read_raw_times_us(path);
    case 5:
      return read_labels(path);
    case 6:
      return (void)read_tracking_camera(path);
    default:
      return read_names(fuzz::as_text(content));
  }
}

}  // namespace
}  // namespace plumb

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer's name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    plumb::read_one(plumb::fuzz::Orders({data, size}));
  } catch (const plumb::InputError&) {
  }
  return 0;
}
