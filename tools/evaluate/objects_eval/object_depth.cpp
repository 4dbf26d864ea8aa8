#include "tools/evaluate/objects_eval/object_depth.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>

#include "core/numbers.hpp"
#include "modules/datasets/text.hpp"
#include "modules/ground/cues/objects_pitch.hpp"
#include "modules/objects/objects.hpp"
#include "tools/datasets/kitti_tracking/kitti_tracking.hpp"
#include "tools/evaluate/objects_eval/foot_placement.hpp"
#include "tools/evaluate/objects_eval/label_choice.hpp"

namespace plumb {
namespace {

constexpr double kFramePeriod_s = 0.1;
constexpr double kRollStd = 0.01;
constexpr double kHeightStd = 0.01;

const std::vector<ObjectClass> kClasses{ObjectClass::kCar, ObjectClass::kVan};

using Placements = std::array<Eigen::Vector2d, kNumMethods>;  ///< (Z, X) in cam

const ObjectOutput* track_of(const ObjectsOutput& output, std::int32_t track_id) {
  for (const ObjectOutput& object : output.objects) {
    const bool placed = object.status != ObjectStatus::kNotLocalised;
    if (object.track_id == track_id && placed) return &object;
  }
  return nullptr;
}

/// Running state of one sequence.
class SequenceRun {
 public:
  SequenceRun(const ObjectDepthOptions& options, const std::string& name)
      : options_(options),
        camera_(read_tracking_camera(options.root / "calib" / (name + ".txt"))),
        labels_(read_tracking(options.root / "label_02" / (name + ".txt"))),
        boxes_(read_tracking(options.root / options.boxes / (name + ".txt"))),
        cue_(options.detections, camera_.model),
        calibrated_tracker_(options.detections, options.objects, camera_.model),
        cue_tracker_(options.detections, options.objects, camera_.model) {
    result_.name = name;
  }

  SequenceDepth run() {
    int last = -1;
    for (const TrackingRow& row : labels_) last = std::max(last, row.frame);
    for (int frame = 0; frame <= last; ++frame) step(frame);
    result_.pitch_rms_rad = num_pitches_ > 0 ? std::sqrt(pitch_sum_ / num_pitches_) : kNan;
    return result_;
  }

 private:
  [[nodiscard]] RoadPlane plane(double pitch_rad, double pitch_var) const {
    RoadPlane result;
    result.pitch_rad = pitch_rad;
    result.height_m = options_.camera_height_m;
    result.cov.diagonal() << pitch_var, kRollStd * kRollStd, kHeightStd * kHeightStd;
    return result;
  }

  void step(int frame_number) {
    const DetectionFrame frame = detections_of_frame(boxes_, frame_number);
    ObjectsPitchInput cue_input;
    cue_input.frame = &frame;
    cue_input.height_m = options_.camera_height_m;
    const ObjectsPitchOutput& cue = cue_.update(cue_input);
    const double prior_std = options_.detections.pitch_std_rad;
    const RoadPlane calibrated = plane(options_.detections.mean_pitch_rad, prior_std * prior_std);
    const RoadPlane from_cue = plane(cue.pitch_rad, cue.pitch_var_rad2);
    if (cue.status == ObjectsPitchStatus::kValid) compare_pitch(frame_number, std::asin(cue.n3));

    ObjectsInput input;
    input.frame = &frame;
    input.plane_measured = true;
    input.motion.dt_s = frame_number == 0 ? 0.0 : kFramePeriod_s;
    input.plane = calibrated;
    const ObjectsOutput& on_calibrated = calibrated_tracker_.update(input);
    input.plane = from_cue;
    const ObjectsOutput& on_cue = cue_tracker_.update(input);

    for (const TrackingRow& label : labels_) {
      if (label.frame != frame_number || !is_evaluated(label, kClasses)) continue;
      ++result_.num_labels;
      const Detection* box = box_of(label, frame, options_.boxes == "label_02");
      if (box == nullptr) continue;
      const ObjectOutput* first = track_of(on_calibrated, box->track_id);
      const ObjectOutput* second = track_of(on_cue, box->track_id);
      if (first == nullptr || second == nullptr) continue;
      const Eigen::Vector3d truth_cam = label.foot_cam0 + camera_.t_cam_cam0;
      const Placements placed{foot(*box, calibrated, truth_cam), foot(*box, from_cue, truth_cam),
                              track(*first, calibrated), track(*second, from_cue)};
      score(truth_cam, placed, *second, from_cue);
    }
  }

  [[nodiscard]] Eigen::Vector2d foot(const Detection& box, const RoadPlane& road,
                                     const Eigen::Vector3d& truth_cam) const {
    return place_by_foot(camera_.model, road, box.box, options_.objects.footprint(box.object_class),
                         truth_cam.z());
  }

  [[nodiscard]] static Eigen::Vector2d track(const ObjectOutput& object, const RoadPlane& road) {
    const Eigen::Vector3d p_cam =
        road.cam_from_ground({object.position_m.x(), object.position_m.y(), 0.0});
    return {p_cam.z(), p_cam.x()};
  }

  void score(const Eigen::Vector3d& truth_cam, const Placements& placed, const ObjectOutput& object,
             const RoadPlane& road) {
    const double truth_m = truth_cam.z();
    DepthErrors& errors = truth_m <= kClose_m ? result_.close : result_.distant;
    ++errors.num_samples;
    for (std::size_t m = 0; m < kNumMethods; ++m) {
      const Eigen::Vector2d off = placed[m] - Eigen::Vector2d(truth_m, truth_cam.x());
      errors.sum_ratio[m] += std::abs(off.x()) / truth_m;
      errors.sum_position[m] += off.norm() / truth_m;
    }
    const Eigen::Vector2d off = object.position_m - road.ground_from_cam(truth_cam).head<2>();
    errors.sum_nees += off.dot(object.position_cov_m2.inverse() * off) / 2.0;
  }

  /// Truth: the pitch of the plane under the camera that fits the labelled feet best.
  void compare_pitch(int frame, double pitch_rad) {
    double sum = 0.0, weight = 0.0;
    for (const TrackingRow& row : labels_) {
      if (row.frame != frame || !is_evaluated(row, kClasses)) continue;
      const double z_m = row.foot_cam0.z();
      sum += (options_.camera_height_m - row.foot_cam0.y()) * z_m;
      weight += z_m * z_m;
    }
    if (!(weight > 0.0)) return;
    const double off = pitch_rad - std::atan(sum / weight);
    pitch_sum_ += off * off;
    ++num_pitches_;
  }

  const ObjectDepthOptions& options_;
  TrackingCamera camera_;
  std::vector<TrackingRow> labels_;
  std::vector<TrackingRow> boxes_;
  ObjectsPitch cue_;
  ObjectTracker calibrated_tracker_;
  ObjectTracker cue_tracker_;
  SequenceDepth result_;
  double pitch_sum_ = 0.0;
  int num_pitches_ = 0;
};

double ratio(double sum, std::size_t count) {
  return count > 0 ? sum / static_cast<double>(count) : kNan;
}

std::string row_of(const SequenceDepth& sequence) {
  std::string text = format("%-6s", sequence.name.c_str());
  for (const DepthErrors* errors : {&sequence.close, &sequence.distant}) {
    text += format(" | %6zu", errors->num_samples);
    for (std::size_t m = 0; m < kNumMethods; ++m) {
      text += format(" %6.1f", errors->depth_percent(static_cast<PlacementMethod>(m)));
    }
    text += format(" %5.1f", errors->mean_nees());
  }
  return text + format(" | %6.2f\n", degrees(sequence.pitch_rms_rad));
}

}  // namespace

void DepthErrors::add(const DepthErrors& other) {
  num_samples += other.num_samples;
  sum_nees += other.sum_nees;
  for (std::size_t m = 0; m < kNumMethods; ++m) {
    sum_ratio[m] += other.sum_ratio[m];
    sum_position[m] += other.sum_position[m];
  }
}

double DepthErrors::depth_percent(PlacementMethod method) const {
  return 100.0 * ratio(sum_ratio[method], num_samples);
}
double DepthErrors::position_percent(PlacementMethod method) const {
  return 100.0 * ratio(sum_position[method], num_samples);
}
double DepthErrors::mean_nees() const { return ratio(sum_nees, num_samples); }

std::vector<SequenceDepth> evaluate_object_depth(const ObjectDepthOptions& options) {
  std::vector<SequenceDepth> sequences;
  for (const std::string& name : options.sequences) {
    sequences.push_back(SequenceRun(options, name).run());
  }
  return sequences;
}

SequenceDepth pool(const std::vector<SequenceDepth>& sequences) {
  SequenceDepth all;
  all.name = "all";
  double pitch_sum = 0.0;
  int num_pitches = 0;
  for (const SequenceDepth& sequence : sequences) {
    all.close.add(sequence.close);
    all.distant.add(sequence.distant);
    all.num_labels += sequence.num_labels;
    if (!std::isfinite(sequence.pitch_rms_rad)) continue;
    pitch_sum += sequence.pitch_rms_rad * sequence.pitch_rms_rad;
    ++num_pitches;
  }
  // Sequences weigh alike.
  all.pitch_rms_rad = std::sqrt(ratio(pitch_sum, static_cast<std::size_t>(num_pitches)));
  return all;
}

std::string depth_table(const std::vector<SequenceDepth>& sequences) {
  std::string text = "depth error [%], mean of |Z - Z*| / Z*\n";
  for (std::size_t m = 0; m < kNumMethods; ++m) {
    text += format("  %c  %s\n", static_cast<char>('A' + m), kMethodNames[m]);
  }
  text +=
      "       | close (<= 10 m)                          | distant"
      "                                  | cue\n"
      "seq    |      n      A      B      C      D  NEES |      n      A      B      C      D"
      "  NEES | pitch RMS [deg]\n";
  for (const SequenceDepth& sequence : sequences) text += row_of(sequence);
  return text + row_of(pool(sequences));
}

}  // namespace plumb
