#include "tools/evaluate/objects_eval/placement.hpp"

#include <Eigen/LU>
#include <cmath>
#include <map>
#include <optional>

#include "core/numbers.hpp"
#include "modules/datasets/kitti/sequence.hpp"
#include "tools/evaluate/eval/estimate_csv.hpp"
#include "tools/evaluate/objects_eval/foot_placement.hpp"
#include "tools/evaluate/objects_eval/label_choice.hpp"
#include "tools/evaluate/objects_eval/placed_object.hpp"

namespace plumb {
namespace {

constexpr int kSpeedFrames = 5;  ///< before and after the label: one step of truth is too noisy

/// Truth of one drive.
class LabelledDrive {
 public:
  explicit LabelledDrive(const std::filesystem::path& folder)
      : labels(read_tracking(folder / "label_02.txt")),
        t_cam_cam0(read_tracking_camera(folder / "calib.txt").t_cam_cam0) {
    SequenceOptions options;
    options.folder = folder;
    options.need_images = false;
    const Sequence sequence = read_sequence(options);
    camera = sequence.camera;
    for (const SequenceFrame& frame : sequence.frames) frames_[frame.seq] = frame;
    for (const TrackingRow& label : labels) add_path(label);
  }

  /// NaN for an object that is labelled once, and without poses.
  [[nodiscard]] double speed_m_s(const TrackingRow& label) const {
    const auto path = paths_.find(label.detection.track_id);
    if (path == paths_.end()) return kNan;
    const auto first = path->second.lower_bound(label.frame - kSpeedFrames);
    auto last = path->second.upper_bound(label.frame + kSpeedFrames);
    if (first == last) return kNan;
    --last;
    const double time_s = last->second.time_s - first->second.time_s;
    if (!(time_s > 0.0)) return kNan;
    return (last->second.p_world - first->second.p_world).norm() / time_s;
  }

  std::vector<TrackingRow> labels;
  Eigen::Vector3d t_cam_cam0;
  CameraModel camera;

 private:
  struct Stop {
    double time_s = 0.0;
    Eigen::Vector3d p_world = Eigen::Vector3d::Zero();
  };

  void add_path(const TrackingRow& label) {
    const auto frame = frames_.find(label.frame);
    if (frame == frames_.end() || !frame->second.T_world_cam || !label.has_box3d) return;
    const PoseMatrix& T_world_cam0 = *frame->second.T_world_cam;
    const Eigen::Vector4d p_world = T_world_cam0 * label.foot_cam0.homogeneous();
    paths_[label.detection.track_id][label.frame] = {
        1e-6 * static_cast<double>(frame->second.capture_us), p_world.head<3>()};
  }

  std::map<std::int64_t, SequenceFrame> frames_;
  std::map<std::int32_t, std::map<int, Stop>> paths_;  ///< by track, by frame
};

/// The planes that objects were placed on.
class RoadPlanes {
 public:
  RoadPlanes(const std::filesystem::path& frames_csv, const CameraModel& camera,
             const PlacementOptions& options) {
    calibrated_.pitch_rad = options.calibrated_pitch_rad;
    calibrated_.height_m =
        camera.camera_height_m > 0.0 ? camera.camera_height_m : options.camera_height_m;
    const bool measured = options.objects.plane == "measured";
    for (const EstimatedPlane& row : read_estimate_csv(frames_csv)) {
      if (!measured || !row.pitch_rad || !row.roll_rad || !row.height_m) continue;
      RoadPlane& plane = planes_[row.seq];
      plane.pitch_rad = *row.pitch_rad;
      plane.roll_rad = *row.roll_rad;
      plane.height_m = *row.height_m;
    }
  }

  [[nodiscard]] const RoadPlane& calibrated() const { return calibrated_; }
  [[nodiscard]] const RoadPlane& of(std::int64_t seq) const {
    const auto found = planes_.find(seq);
    return found == planes_.end() ? calibrated_ : found->second;
  }

 private:
  RoadPlane calibrated_;
  std::map<std::int64_t, RoadPlane> planes_;
};

PlacementSample compare(const TrackingRow& label, const Eigen::Vector3d& truth_cam,
                        const PlacedObject& placed, const RoadPlane& road) {
  PlacementSample sample;
  sample.frame = label.frame;
  sample.track_id = label.detection.track_id;
  sample.truth_m = truth_cam.z();
  const Eigen::Vector3d p_cam =
      road.cam_from_ground({placed.position_m.x(), placed.position_m.y(), 0.0});
  sample.depth_m = p_cam.z();
  sample.depth_std_m = std::sqrt(placed.cov_m2(0, 0));
  sample.position_error_m = (p_cam - truth_cam).norm();
  const Eigen::Vector2d off = placed.position_m - road.ground_from_cam(truth_cam).head<2>();
  sample.depth_nees = off.x() * off.x() / placed.cov_m2(0, 0);
  sample.position_nees = off.dot(placed.cov_m2.inverse() * off) / 2.0;
  return sample;
}

}  // namespace

DrivePlacement evaluate_placement(const std::filesystem::path& drive,
                                  const std::filesystem::path& frames_csv,
                                  const std::filesystem::path& objects_csv,
                                  const PlacementOptions& options) {
  const LabelledDrive truth(drive);
  const RoadPlanes planes(frames_csv, truth.camera, options);
  const PlacedObjects placed = read_placed_objects(objects_csv);
  const std::vector<TrackingRow> boxes = read_tracking(drive / options.boxes);
  const bool labels_are_boxes = options.boxes == "label_02.txt";

  DrivePlacement result;
  result.name = drive.has_filename() ? drive.filename() : drive.parent_path().filename();
  std::map<int, DetectionFrame> frames;
  for (const TrackingRow& label : truth.labels) {
    if (!is_evaluated(label, options.classes)) continue;
    ++result.num_labels;
    auto [frame, is_new] = frames.try_emplace(label.frame);
    if (is_new) frame->second = detections_of_frame(boxes, label.frame);
    const Detection* box = box_of(label, frame->second, labels_are_boxes);
    if (box == nullptr) continue;
    const auto object = placed.find({label.frame, box->track_id});
    if (object == placed.end()) continue;
    const Eigen::Vector3d truth_cam = label.foot_cam0 + truth.t_cam_cam0;
    const RoadPlane& road = planes.of(label.frame);
    PlacementSample sample = compare(label, truth_cam, object->second, road);
    const FootprintPrior& size = options.objects.footprint(box->object_class);
    const auto foot_m = [&](const RoadPlane& plane) {
      return place_by_foot(truth.camera, plane, box->box, size, truth_cam.z()).x();
    };
    sample.foot_m = foot_m(road);
    sample.foot_calibrated_m = foot_m(planes.calibrated());
    sample.speed_m_s = truth.speed_m_s(label);
    result.samples.push_back(sample);
  }
  return result;
}

}  // namespace plumb
