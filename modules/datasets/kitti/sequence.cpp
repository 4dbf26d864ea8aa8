#include "modules/datasets/kitti/sequence.hpp"

#include <algorithm>

#include "core/input_error.hpp"
#include "modules/datasets/kitti/calibration.hpp"
#include "modules/datasets/kitti/image_list.hpp"
#include "modules/datasets/kitti/oxts.hpp"
#include "modules/datasets/kitti/times.hpp"
#include "modules/datasets/text.hpp"

namespace plumb {
namespace {

namespace fs = std::filesystem;

struct Layout {
  bool raw = false;
  fs::path images;
  fs::path times;
};

Layout find_layout(const SequenceOptions& options) {
  if (!fs::is_directory(options.folder)) {
    throw InputError(options.folder.string() + " is not a folder");
  }
  const std::string camera = std::to_string(options.camera);
  const fs::path odometry = options.folder / ("image_" + camera);
  const fs::path raw = options.folder / ("image_0" + camera);
  if (fs::is_directory(odometry)) return {false, odometry, options.folder / "times.txt"};
  if (fs::is_directory(raw)) return {true, raw / "data", raw / "timestamps.txt"};
  if (!options.need_images) return {false, {}, options.folder / "times.txt"};
  throw InputError(options.folder.string() + " is not a KITTI sequence: it has neither " +
                   odometry.filename().string() + " nor " + raw.filename().string() + "/data");
}

/// The images of the layout. Without an image folder, each time stands for an image without a file.
std::vector<NumberedImage> find_images(const Layout& layout) {
  if (!layout.images.empty()) return list_images(layout.images);
  std::vector<NumberedImage> images(read_odometry_times_us(layout.times).size());
  for (std::size_t i = 0; i < images.size(); ++i) images[i].number = static_cast<std::int64_t>(i);
  if (images.empty()) throw InputError(layout.times.string() + " holds no time");
  return images;
}

/// The two coefficients form a pair: when only one of them is given, the other one is 0.
void set_residual(std::optional<double> k1, std::optional<double> k2, CameraModel* camera) {
  const bool stated = k1 || k2;
  camera->residual_k1 = stated ? k1.value_or(0.0) : kKittiResidualK1;
  camera->residual_k2 = stated ? k2.value_or(0.0) : kKittiResidualK2;
}

RectifiedCamera read_odometry_camera(const SequenceOptions& options) {
  const CalibrationFile file(options.folder / "calib.txt");
  RectifiedCamera camera = read_projection(file, format("P%d", options.camera));
  set_residual(file.optional_number("residual_k1"), file.optional_number("residual_k2"),
               &camera.model);
  camera.model.camera_height_m = file.optional_number("camera_height_m").value_or(0.0);
  camera.model.readout_s = file.optional_number("readout_s").value_or(0.0);
  return camera;
}

RectifiedCamera read_raw_camera(const SequenceOptions& options, const RawCalibration& files) {
  if (files.cam_to_cam.empty()) {
    throw InputError("no calib_cam_to_cam.txt in " + options.folder.string() +
                     " or the folder above");
  }
  const CalibrationFile file(files.cam_to_cam);
  const std::string suffix = format("_rect_0%d", options.camera);
  RectifiedCamera camera = read_projection(file, "P" + suffix);
  const std::vector<double> size_px = file.numbers("S" + suffix, 2);
  camera.model.width_px = static_cast<int>(size_px[0]);
  camera.model.height_px = static_cast<int>(size_px[1]);
  set_residual({}, {}, &camera.model);
  return camera;
}

void set_times(const Layout& layout, const std::vector<NumberedImage>& images,
               std::vector<SequenceFrame>* frames) {
  const std::vector<std::int64_t> times_us =
      layout.raw ? read_raw_times_us(layout.times) : read_odometry_times_us(layout.times);
  const RowLookup lookup(layout.times, times_us.size(), images);
  for (std::size_t i = 0; i < images.size(); ++i) {
    SequenceFrame& frame = (*frames)[i];
    frame.capture_us = times_us[lookup.row(i, frame.seq)];
    if (i == 0) continue;
    const std::int64_t step_us = frame.capture_us - (*frames)[i - 1].capture_us;
    if (step_us > 0) continue;
    throw InputError(format("%s: the time of frame %lld %s that of frame %lld",
                            layout.times.string().c_str(), static_cast<long long>(frame.seq),
                            step_us == 0 ? "is the same as" : "lies before",
                            static_cast<long long>((*frames)[i - 1].seq)));
  }
}

PoseMatrix to_matrix(const Se3& T) {
  PoseMatrix matrix = PoseMatrix::Identity();
  matrix.topLeftCorner<3, 3>() = T.R;
  matrix.topRightCorner<3, 1>() = T.t;
  return matrix;
}

void read_pose_file(const fs::path& file, const std::vector<NumberedImage>& images,
                    Sequence* sequence) {
  const std::vector<PoseMatrix> poses = read_poses(file);
  if (poses.empty()) throw InputError(file.string() + " has no pose");
  const RowLookup lookup(file, poses.size(), images);
  for (std::size_t i = 0; i < images.size(); ++i) {
    sequence->frames[i].T_world_cam = poses[lookup.row(i, images[i].number)];
  }
  sequence->notes.push_back("poses from " + file.string());
}

void read_oxts_truth(const fs::path& drive, const RawCalibration& files,
                     const std::vector<NumberedImage>& images, Sequence* sequence) {
  const fs::path data = drive / "oxts" / "data";
  if (!fs::is_directory(data)) return;
  if (files.velo_to_cam.empty() || files.imu_to_velo.empty()) {
    sequence->notes.push_back(
        "no poses: oxts is there, calib_velo_to_cam.txt or calib_imu_to_velo.txt is not");
    return;
  }
  const auto poses = read_oxts_poses(data, images, read_T_cam_imu(files));
  std::size_t num_missing = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (poses[i]) sequence->frames[i].T_world_cam = to_matrix(*poses[i]);
    if (!poses[i]) ++num_missing;
  }
  sequence->notes.push_back("poses from " + data.string());
  if (num_missing > 0) {
    sequence->notes.push_back(
        format("warning: %zu frames have no oxts file, so no pose", num_missing));
  }
}

/// Returns the plane file of the folder, or an empty path when there is none.
fs::path find_planes(const fs::path& folder) {
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.rfind("gt_ground_plane", 0) == 0 && name.ends_with(".txt")) found.push_back(entry);
  }
  if (found.size() > 1) {
    throw InputError(folder.string() +
                     " has more than one gt_ground_plane*.txt; name one with --planes");
  }
  return found.empty() ? fs::path() : found.front();
}

void read_plane_file(const fs::path& file, Sequence* sequence) {
  if (file.empty()) return;
  const auto planes = read_planes(file);
  for (SequenceFrame& frame : sequence->frames) {
    const auto found = planes.find(frame.seq);
    if (found != planes.end()) frame.plane = found->second;
  }
  sequence->notes.push_back("ground planes from " + file.string());
}

/// Moves the truth from KITTI's left grey camera to the camera of the images.
void move_truth(const Eigen::Vector3d& t_left_cam_m, Sequence* sequence) {
  const PoseMatrix T_left_cam = to_matrix({Eigen::Matrix3d::Identity(), t_left_cam_m});
  for (SequenceFrame& frame : sequence->frames) {
    if (frame.T_world_cam) frame.T_world_cam = *frame.T_world_cam * T_left_cam;
    if (frame.plane) frame.plane->height_m -= frame.plane->normal_cam.dot(t_left_cam_m);
  }
}

void select_frames(const SequenceOptions& options, Sequence* sequence) {
  if (!options.start && !options.end) return;
  std::erase_if(sequence->frames, [&](const SequenceFrame& frame) {
    return (options.start && frame.seq < *options.start) ||
           (options.end && frame.seq > *options.end);
  });
  if (sequence->frames.empty()) {
    throw InputError("no frame of " + options.folder.string() + " lies between --start and --end");
  }
}

}  // namespace

Sequence read_sequence(const SequenceOptions& options) {
  const Layout layout = find_layout(options);
  const RawCalibration files = layout.raw ? find_raw_calibration(options.folder) : RawCalibration{};
  const std::vector<NumberedImage> images = find_images(layout);
  const RectifiedCamera camera =
      layout.raw ? read_raw_camera(options, files) : read_odometry_camera(options);

  Sequence sequence;
  sequence.camera = camera.model;
  sequence.colour_allowed = options.camera >= 2;
  if (options.residual_k1 || options.residual_k2) {
    set_residual(options.residual_k1, options.residual_k2, &sequence.camera);
  }
  if (options.readout_s) sequence.camera.readout_s = *options.readout_s;
  if (options.camera_height_m) sequence.camera.camera_height_m = *options.camera_height_m;
  for (const NumberedImage& image : images)
    sequence.frames.push_back({image.number, image.path, 0, {}, {}});
  sequence.notes = describe_gaps(images);
  set_times(layout, images, &sequence.frames);

  const fs::path own_poses = options.folder / "poses.txt";
  if (!options.poses.empty() || fs::exists(own_poses)) {
    read_pose_file(options.poses.empty() ? own_poses : options.poses, images, &sequence);
  } else if (layout.raw) {
    read_oxts_truth(options.folder, files, images, &sequence);
  }
  read_plane_file(options.planes.empty() ? find_planes(options.folder) : options.planes, &sequence);
  move_truth(camera.t_left_cam_m, &sequence);
  select_frames(options, &sequence);
  return sequence;
}

}  // namespace plumb
