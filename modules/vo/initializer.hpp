/// Initialisation of the map from two views, at the start and after tracking has failed.
///
/// A reference image starts tracks without depth. Each later image is tracked until the median flow
/// is large enough (vo.start_flow_px) and a rotation alone does not explain it. Then the relative
/// pose of reference and newest image is solved (two_view.hpp), the tracks are triangulated, and
/// the window is refined.
///
/// The length of the first translation is not observable. At the start it puts the median track at
/// a typical depth. After a failure it is the distance that the last measured speed predicts, so
/// that the unit of length changes little; `scale_epoch` and `scale_carry_std` report the change.
///
/// Frames:
///   world: cam of the first image. After a failure, the reference gets its predicted pose.
/// Units:
///   [vo], pixels, seconds.
/// Memory:
///   One pair of rays per track, allocated by the constructor.
#pragma once

#include <cstdint>
#include <vector>

#include "core/camera_model.hpp"
#include "core/stage_probe.hpp"
#include "modules/vo/frame_time.hpp"
#include "modules/vo/local_map.hpp"
#include "modules/vo/motion_predictor.hpp"
#include "modules/vo/random.hpp"
#include "modules/vo/two_view.hpp"
#include "modules/vo/vo.hpp"
#include "modules/vo/vo_config.hpp"

namespace plumb::vo {

class Initializer {
 public:
  Initializer(const VoConfig& config, const CameraModel& camera, std::uint64_t seed);

  /// Makes the newest image of `map`, which is the first one, the reference. `out` gets status,
  /// reason and the number of new tracks.
  void begin(const FrameTime& time, LocalMap& map, VoOutput* out);
  /// As begin(), for an image that nothing connects with the earlier ones: the unit of length is
  /// lost.
  void begin_anew(const FrameTime& time, LocalMap& map, VoOutput* out);
  /// Tracks the reference into the newest image of `map` and tries to solve the two views. `out`
  /// gets status, reason, covariance and the counts of tracks. @pre has_reference(), not done()
  void update(const FrameTime& time, LocalMap& map, MotionPredictor& motion, VoOutput* out,
              StageProbe& probe);
  /// Starts again after tracking has failed. The last image becomes the reference if it was
  /// localised, and the two views are solved at once if they can be. Else the newest image becomes
  /// the reference.
  /// @pre has_reference()
  void restart(const FrameTime& time, LocalMap& map, MotionPredictor& motion, VoOutput* out,
               StageProbe& probe);
  /// Adds to the predicted distance from the reference, for an image that showed nothing.
  void add_predicted_distance(double distance) { predicted_distance_ += distance; }

  /// Returns whether there was a first image.
  [[nodiscard]] bool has_reference() const { return phase_ != Phase::kNoReference; }
  /// Returns whether the map has depths, so that images can be localised in it.
  [[nodiscard]] bool done() const { return phase_ == Phase::kDone; }

 private:
  enum class Phase { kNoReference, kTracking, kDone };

  void set_reference(std::int64_t seq, const Se3& T_cam_world, const Pyramid& image, LocalMap& map,
                     VoOutput* out);
  void track_reference(const FrameTime& time, const Se3& T_predicted, LocalMap& map,
                       const MotionPredictor& motion, VoOutput* out);
  void track_motion(const FrameTime& time, const Se3& T_predicted, LocalMap& map,
                    MotionPredictor& motion, VoOutput* out, StageProbe& probe);
  [[nodiscard]] bool is_still_proven() const;
  [[nodiscard]] bool detect_standstill(const FrameTime& time, LocalMap& map);
  [[nodiscard]] bool try_two_views(const FrameTime& time, double min_flow_px, LocalMap& map,
                                   MotionPredictor& motion, VoOutput* out);
  [[nodiscard]] double collect_pairs(const LocalMap& map);
  [[nodiscard]] double typical_distance(const TwoView& views);
  void build_window(const TwoView& views, double distance, LocalMap& map, VoOutput* out);
  void report_unsolved(const FrameTime& time, VoReason reason, MotionPredictor& motion,
                       VoOutput* out) const;

  VoConfig config_;
  CameraModel camera_;
  Eigen::Vector2d focal_px_;
  Random random_;
  Phase phase_ = Phase::kNoReference;
  int num_at_reference_ = 0;         // number of tracks to compare later numbers with
  double predicted_distance_ = 0.0;  // from the reference to the newest image, [vo]
  bool restarting_ = false;          // tracking has failed, and the unit of length is lost
  bool speed_known_ = false;         // the speed was known when tracking failed
  int num_still_ = 0;                // still images in a row before the newest one
  double still_s_ = 0.0;             // time that they took
  std::vector<RayPair> pairs_;
  std::vector<double> scratch_;
};

}  // namespace plumb::vo
