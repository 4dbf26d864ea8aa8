/// The visual odometry, step by step. VisualOdometry hides it from its users.
///
/// Every image is accepted or refused by its number and time, judged by its content, and then one of three things
/// happens: initialisation goes on (Initializer), tracking goes on (track), or the image is coasted over.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "modules/vo/frame_time.hpp"
#include "modules/vo/initializer.hpp"
#include "modules/vo/local_map.hpp"
#include "modules/vo/motion_predictor.hpp"
#include "modules/vo/vo.hpp"
#include "modules/vo/zero_motion_detector.hpp"

namespace plumb::vo {

class Pipeline {
 public:
  Pipeline(const VoConfig& config, const CameraModel& camera, std::uint64_t seed);
  const VoOutput& update(const VoInput& input, StageProbe& probe);

 private:
  [[nodiscard]] bool accept(const VoInput& input);
  void coast(VoReason reason);
  void track(StageProbe& probe);
  [[nodiscard]] PoseFit locate(StageProbe& probe);
  void search_wider(const Se3& T_predicted);
  [[nodiscard]] PoseFit fit_from(const Se3& T_predicted) const;
  void advance(const PoseFit& pose, StageProbe& probe);
  void hold(const PoseFit& pose, ZeroMotion kind, StageProbe& probe);
  void insert(const Se3& T_cam_world, bool refine, StageProbe& probe);
  void report_fit(const PoseFit& pose);
  void finish(const VoInput& input);
  void report_motion(const Se3& T_cam_world);

  VoConfig config_;
  CameraModel camera_;
  LocalMap map_;
  MotionPredictor motion_;
  ZeroMotionDetector zero_motion_;
  Initializer initializer_;

  FrameTime time_;
  std::int64_t last_us_ = 0;
  std::int64_t last_seq_ = -1;  // -1 before the first frame
  Se3 T_last_world_;            // pose of the last frame handed out, as it was then
  std::vector<double> scratch_;
  VoOutput out_;
};

}  // namespace plumb::vo
