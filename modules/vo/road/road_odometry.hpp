/// Replaces VO's translation by the road's when VO follows something else than the world.
///
/// Then the motion has VO's rotation and the road's way along the direction of travel, the window
/// holds the poses that these add up to, and there are no road points. A new scale epoch begins
/// when the source of the motion changes, and the height of the camera over the road is known in
/// its unit.
///
/// Frames:
///   cam: x right, y down, z forward.  T_a_b maps coordinates in b to coordinates in a.
/// Units:
///   [vo], seconds.
/// Memory:
///   In place.
#pragma once

#include "core/camera_model.hpp"
#include "core/fixed_vector.hpp"
#include "core/image_view.hpp"
#include "modules/vo/road/road_motion.hpp"
#include "modules/vo/road/road_watch.hpp"
#include "modules/vo/vo.hpp"

namespace plumb::vo {

class RoadOdometry {
 public:
  explicit RoadOdometry(const CameraModel& camera) : motion_(camera) {}

  /// Nothing connects the next image with the last one.
  void reset();
  /// Takes VO's result of an image and replaces it when it is not the car's motion.
  /// @param usable  the image may be used; else only time passes
  void update(const ImageView& image, bool usable, double dt_s, VoOutput* vo);

  /// The road is seen, below the camera.
  [[nodiscard]] bool sees_road() const { return sees_road_; }
  /// y/z of the direction in which the road vanishes.
  [[nodiscard]] double horizon_y() const { return motion_.direction().y(); }

 private:
  struct Pose {
    std::int64_t seq = 0;
    Se3 T_start_cam;
  };

  [[nodiscard]] double speed_std_ratio(const RoadSpeedEstimate& road) const;
  void state_height(double unit, const RoadSpeedEstimate& road, VoOutput* vo) const;
  void number_epoch(MotionSource before, VoOutput* vo);
  void replace(const RoadSpeedEstimate& road, bool usable, double dt_s, VoOutput* vo);
  void replace_window(VoOutput* vo);

  RoadMotion motion_;
  RoadWatch watch_;
  bool sees_road_ = false;
  double sure_s_ = 0.0;                       // for so long the road has been seen
  double unit_ = 1.0;                         // [vo per height] while the road is the source
  std::int32_t features_epoch_ = 0;           // of VO's own unit
  std::int32_t epoch_ = 0;                    // as it is published
  FixedVector<Pose, kMaxWindowPoses> poses_;  // newest first
};

}  // namespace plumb::vo
