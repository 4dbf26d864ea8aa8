/// The visual odometry, step by step; VisualOdometry hides it from its users.
///
/// Three modes: waiting for the first image, starting (a reference image and tracks without depth) and tracking.
/// Images that cannot be used, or in which tracking fails, are coasted over.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "core/pyramid.hpp"
#include "modules/vo/keyframes.hpp"
#include "modules/vo/motion_model.hpp"
#include "modules/vo/pose.hpp"
#include "modules/vo/random.hpp"
#include "modules/vo/refine.hpp"
#include "modules/vo/tracker.hpp"
#include "modules/vo/two_view.hpp"
#include "modules/vo/vo.hpp"

namespace plumb::vo {

class Pipeline {
 public:
  Pipeline(const VoConfig& config, const CameraModel& camera, std::uint64_t seed);
  const VoOutput& update(const VoInput& input, StageProbe& probe);

 private:
  enum class Mode { kEmpty, kStarting, kTracking };
  enum class Hold { kNone, kTranslation, kAll };

  // pipeline.cpp: the frame
  [[nodiscard]] bool accept(const VoInput& input);
  void track(const VoInput& input, StageProbe& probe);
  [[nodiscard]] PoseFit locate(StageProbe& probe);
  void search_wider(const Se3& T_predicted);
  [[nodiscard]] PoseFit fit(const Se3& start, int max_iterations) const;
  void insert(const VoInput& input, const Se3& T_cam_world, bool refine, StageProbe& probe);
  [[nodiscard]] int add_frame(std::int64_t seq, const Se3& T_cam_world);
  void drop_gross(int slot);
  void drop_outliers();
  void report_fit(const PoseFit& fit);
  /// Of the motion since the image at T_prev_world.
  void report_covariance(const PoseFit& pose, const Se3& T_prev_world);
  void finish(const VoInput& input);

  // holding.cpp: standing still and turning on the spot
  [[nodiscard]] Hold judge_motion(const Se3& T_cam_world);
  void hold(const VoInput& input, const PoseFit& fit, Hold kind, StageProbe& probe);
  [[nodiscard]] double flow_percentile(const Se3& T_from_world, const Se3& T_to_world,
                                       bool compensate_rotation);

  // coasting.cpp: nothing to see
  void coast(const VoInput& input, VoReason reason);
  void report_prediction(const Se3& T_prev_cam);

  // starting.cpp: two views
  void begin_reference(std::int64_t seq, const Se3& T_cam_world, const Pyramid& image);
  void start(const VoInput& input, StageProbe& probe);
  [[nodiscard]] bool stands_before_start(const VoInput& input);
  [[nodiscard]] bool try_start(const VoInput& input, double least_flow_px);
  [[nodiscard]] double collect_pairs();
  void adopt_two_views(const TwoView& views, double distance);
  void restart(const VoInput& input, StageProbe& probe);
  void wait_for_start(const VoInput& input, VoReason reason);

  [[nodiscard]] const Pyramid& image() const {
    return pyramids_[static_cast<std::size_t>(newest_)];
  }
  [[nodiscard]] Pyramid& image() { return pyramids_[static_cast<std::size_t>(newest_)]; }
  void keep_image(const Se3& T_cam_world);  // the newest image becomes the last one
  [[nodiscard]] const Pyramid& last_image() const {
    return pyramids_[static_cast<std::size_t>(1 - newest_)];
  }
  [[nodiscard]] Se3 last_pose() const;        // of the last frame handed out
  [[nodiscard]] Se3 last_image_pose() const;  // of the frame of last_image()

  VoConfig config_;
  CameraModel camera_;
  Eigen::Vector2d focal_px_;
  Random random_;
  std::array<Pyramid, 2> pyramids_;
  int newest_ = 0;  // pyramid being filled; the other one holds the last image that was used
  TrackTable tracks_;
  Window window_;
  Tracker tracker_;
  Keyframes keyframes_;
  WindowRefiner refiner_;
  MotionModel motion_;

  Mode mode_ = Mode::kEmpty;
  bool have_image_ = false;
  std::int64_t last_us_ = 0;
  std::int64_t last_seq_ = -1;  // -1 before the first frame
  Se3 T_last_world_;            // of the last frame handed out, as it was then
  double dt_s_ = 0.0;
  double unseen_s_ = 0.0;            // since a motion was measured
  double predicted_distance_ = 0.0;  // since the reference image, [vo]
  Se3 T_last_image_newest_;  // pose of last_image() relative to the newest frame of the window
  bool held_ = false;
  Se3 T_held_world_;  // where holding began
  int num_at_reference_ = 0;
  bool restarting_ = false;   // a unit of length has been lost
  bool speed_known_ = false;  // at that time
  std::vector<RayPair> pairs_;
  std::vector<double> scratch_;
  VoOutput out_;
};

}  // namespace plumb::vo
