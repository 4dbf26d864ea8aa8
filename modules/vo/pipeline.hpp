/// Visual odometry, step by step. VisualOdometry hides this class from its users.
///
/// update() takes one image:
///   1. accept() compares size and number of the image with what is expected. judge_image() refuses
///      images that show nothing; the caller may have refused it already (VoInput::unusable).
///   2. For a refused image, coast() predicts the motion. Before there is a map, Initializer solves
///      two views.
///   3. Otherwise track() searches the tracks in the image and fits its pose to them (localize).
///      The pose is one of a moving camera (handle_motion) or of one that does not translate
///      (handle_zero_motion). Without enough inliers, Initializer starts again.
///   4. report() derives the output from the refined poses.
///   5. RoadOdometry replaces the translation when the road shows another one.
///   6. judge_orientation() withholds motions of a camera that is upside down, and marks them while
///      that is not known.
///   7. report_features() names the features of the image by their kind.
///
/// Frames:
///   world: cam of the first image.  cam: cam of the newest image.
/// Units:
///   [vo], pixels, radians, seconds.
/// Memory:
///   Sized by the configuration and the camera, and allocated by the constructor.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "modules/vo/frame_time.hpp"
#include "modules/vo/initializer.hpp"
#include "modules/vo/local_map.hpp"
#include "modules/vo/motion_predictor.hpp"
#include "modules/vo/orientation_check.hpp"
#include "modules/vo/road/road_odometry.hpp"
#include "modules/vo/vo.hpp"
#include "modules/vo/zero_motion_detector.hpp"

namespace plumb::vo {

class Pipeline {
 public:
  Pipeline(const VoConfig& config, const CameraModel& camera, std::uint64_t seed);
  /// Processes one image. The result is valid until the next call.
  const VoOutput& update(const VoInput& input, StageProbe& probe);
  /// What is known of the regions that are attached to the camera.
  [[nodiscard]] AttachedRegions& attached() { return map_.attached; }

 private:
  [[nodiscard]] bool accept(const VoInput& input);
  void break_off();
  void coast(VoReason reason);
  void track(StageProbe& probe);
  [[nodiscard]] PoseFit localize(StageProbe& probe);
  void search_wider(const Se3& T_predicted);
  [[nodiscard]] PoseFit fit_from(const Se3& T_predicted) const;
  void handle_motion(const PoseFit& pose, StageProbe& probe);
  void handle_zero_motion(const PoseFit& pose, ZeroMotion kind, StageProbe& probe);
  void insert(const Se3& T_cam_world, bool refine, StageProbe& probe);
  void report_fit(const PoseFit& pose);
  void report(const VoInput& input);
  void report_motion(const Se3& T_cam_world);
  void judge_orientation();
  void report_features();
  void observe_orientation();
  void observe_attached(const Se3& T_cam_world);

  VoConfig config_;
  CameraModel camera_;
  LocalMap map_;
  MotionPredictor motion_;
  ZeroMotionDetector zero_motion_;
  Initializer initializer_;
  OrientationCheck orientation_;
  RoadOdometry road_;

  FrameTime time_;
  std::int64_t last_seq_ = -1;       // number of the previous image; -1 before the first image
  std::int32_t map_epoch_ = 0;       // number of the map's unit of length
  std::int32_t oriented_epoch_ = 0;  // scale epoch of the last verdict on the orientation
  bool is_broken_off_ = false;       // the next usable image begins a new map
  bool is_map_doubted_ = false;      // the same, and the motion so far carries on
  Se3 T_last_world_;                 // its pose as it was published
  double unplaced_s_ = 0.0;          // since the last image with a pose, measured or predicted
  Matrix6d coasted_cov_ = Matrix6d::Zero();  // of that pose, if it was predicted
  std::vector<double> scratch_;
  VoOutput out_;
};

}  // namespace plumb::vo
