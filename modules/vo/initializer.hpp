/// Initialisation from two views, at the start and after tracking has failed.
///
/// A reference image starts tracks without depth. Once the image has moved far enough, the relative pose of reference
/// and newest image is solved (five-point RANSAC, Nister 2004) and the tracks get their inverse depths. The length of
/// the first translation is free: it follows from a typical depth, or, after a loss, from the speed before it.
///
/// Frames   world: cam of the first frame, kept over a loss as far as the prediction goes.
/// Units    [vo], pixels, seconds.
/// Memory   sized at construction.
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

  /// The first image becomes the reference. `out` gets its status and the number of new tracks.
  void begin(const FrameTime& time, LocalMap& map, VoOutput* out);
  /// Tracks the reference into the newest image of `map` and tries to solve the two views. `out` gets status, reason
  /// and what the tracker saw. @pre has_reference(), not done()
  void update(const FrameTime& time, LocalMap& map, MotionPredictor& motion, VoOutput* out,
              StageProbe& probe);
  /// Tracking failed: starts again from the last image and the newest one.
  void restart(const FrameTime& time, LocalMap& map, MotionPredictor& motion, VoOutput* out,
               StageProbe& probe);
  /// An image was coasted over: the reference is that much farther away.
  void add_predicted_distance(double distance) { predicted_distance_ += distance; }

  [[nodiscard]] bool has_reference() const { return phase_ != Phase::kEmpty; }
  /// The window is triangulated, so tracking can go on with it.
  [[nodiscard]] bool done() const { return phase_ == Phase::kDone; }

 private:
  enum class Phase { kEmpty, kWaiting, kDone };

  void set_reference(std::int64_t seq, const Se3& T_cam_world, const Pyramid& image, LocalMap& map,
                     VoOutput* out);
  void track_reference(const FrameTime& time, const Se3& T_predicted, LocalMap& map,
                       const MotionPredictor& motion, VoOutput* out);
  [[nodiscard]] bool stands(const FrameTime& time, LocalMap& map);
  [[nodiscard]] bool try_two_views(const FrameTime& time, double least_flow_px, LocalMap& map,
                                   MotionPredictor& motion, VoOutput* out);
  [[nodiscard]] double collect_pairs(const LocalMap& map);
  [[nodiscard]] double typical_distance(const TwoView& views);
  void adopt(const TwoView& views, double distance, LocalMap& map, VoOutput* out);
  void wait(const FrameTime& time, VoReason reason, MotionPredictor& motion, VoOutput* out) const;

  VoConfig config_;
  CameraModel camera_;
  Eigen::Vector2d focal_px_;
  Random random_;
  Phase phase_ = Phase::kEmpty;
  int num_at_reference_ = 0;         // tracks that the reference started with
  double predicted_distance_ = 0.0;  // since the reference image, [vo]
  bool restarting_ = false;          // a unit of length has been lost
  bool speed_known_ = false;         // at that time
  std::vector<RayPair> pairs_;
  std::vector<double> scratch_;
};

}  // namespace plumb::vo
