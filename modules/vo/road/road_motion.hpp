/// The speed of the road under the car, from the images and VO's rotation alone.
///
/// Features of other vehicles, of the dashboard and of the far field may agree on a translation
/// that is not the car's. The road cannot: it is seen from above (road_features.hpp), compared over
/// several intervals (road_shifts.hpp), and its speed is followed over time (road_speed.hpp). What
/// the camera sees in the same place all the time, such as reflections, is subtracted.
///
/// Direction of travel:
///   The mean of VO's directions gives heading and pitch of the camera on the car. VO's rotation
///   carries the pitch from image to image.
/// Frames:
///   cam: x right, y down, z forward.
/// Units:
///   Heights of the camera, seconds.
/// Memory:
///   kMostImages grids of features, in place.
#pragma once

#include <Eigen/Core>
#include <array>

#include "core/camera_model.hpp"
#include "core/fixed_vector.hpp"
#include "core/image_view.hpp"
#include "modules/vo/road/road_features.hpp"
#include "modules/vo/road/road_shifts.hpp"
#include "modules/vo/road/road_speed.hpp"
#include "modules/vo/vo.hpp"

namespace plumb::vo {

class RoadMotion {
 public:
  explicit RoadMotion(const CameraModel& camera) : finder_(camera) {}

  /// Forgets the images, the speed and the direction.
  void reset();
  /// Takes an image, `dt_s` after the previous one, with VO's rotation and translation to it.
  /// Without `trusts_direction`, the direction of the translation counts less.
  void take(const ImageView& image, const VoOutput& vo, bool trusts_direction, double dt_s);
  /// Time passes without an image that can be compared.
  void miss(double dt_s);

  [[nodiscard]] const RoadSpeedEstimate& estimate() const { return speed_.estimate(); }
  /// Direction of travel in cam as (x/z, y/z), with the pitch that the road shows.
  [[nodiscard]] Eigen::Vector2d direction() const;

 private:
  static constexpr std::size_t kMostImages = 12;
  struct Past {
    RoadGrid features;
    double time_s = 0.0;
    Eigen::Matrix3d R_first_cam;  // from cam of the image to cam of the first one
  };

  void follow_direction(const VoOutput& vo, bool trusts_direction, double dt_s);
  void compare(double dt_s);
  [[nodiscard]] const Past* nearest(double age_s, const Past* newer) const;
  void turn(const Past& past, double speed);
  void remember();

  RoadFeatures finder_;
  RoadSpeed speed_;
  Eigen::Vector2d direction_ = Eigen::Vector2d::Zero();
  int num_directions_ = 0;
  double time_s_ = 0.0;
  Eigen::Matrix3d R_first_cam_ = Eigen::Matrix3d::Identity();
  RoadGrid features_{};
  RoadGrid steady_{};  // running mean of the features
  int num_images_ = 0;
  RoadGrid now_{};
  RoadGrid before_{};
  std::array<RoadShifts, 3> shifts_;
  std::array<Past, kMostImages> past_;  // a ring
  std::size_t num_past_ = 0;
  std::size_t next_past_ = 0;
};

}  // namespace plumb::vo
