/// Tells whether the camera sees the road below it or above it, that is, whether it is upside down.
///
/// The road is the deepest thing that a camera on a vehicle sees: what is seen below the direction
/// of travel lies one camera height below it, while houses, trees, trucks and ceilings reach
/// several camera heights above it. So among the tracks whose depth is known, the distances to the
/// line of travel are longer on the upper side. Upside down, it is the other way round, and the
/// tracks of the upper side have nearly the same distance, as a road's have: on a bare motorway,
/// what moves along seems to be far below the car. Where one side shows nothing, the other one is
/// the road if its tracks lie in one plane.
///
/// Each image adds the logarithm of the ratio of both sides to a sum, within limits. The sum proves
/// the orientation and has to change its sign to disprove it. A camera seldom turns over while it
/// is watched, so a proven upright camera needs much more to be disproved.
///
/// A picture that is mirrored left to right shows a road, too, and passes.
///
/// Frames:
///   cam: x right, y down, z forward.
/// Units:
///   Normalised image coordinates; inverse depths in 1/[vo]. Only ratios count.
/// Memory:
///   One distance per track, allocated by the constructor.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace plumb::vo {

enum class Orientation : std::int8_t {
  kUnseen,      ///< no moving image was seen yet
  kUnproven,    ///< too little was seen
  kUpright,     ///< the road is below
  kUpsideDown,  ///< the road is above
};

class OrientationCheck {
 public:
  explicit OrientationCheck(std::size_t max_tracks);

  /// Begins an image. `travel_cam` points along the direction of travel, or against it.
  void begin(const Eigen::Vector3d& travel_cam);
  /// Adds a track, at the normalised coordinates `xy` and the inverse depth `rho`.
  /// @pre at most `max_tracks` per image
  void add(const Eigen::Vector2d& xy, double rho, double rho_std);
  /// Ends the image and judges it.
  void end();
  /// The road was seen to pass below the camera (RoadMotion).
  void see_road();

  /// Tracking was lost, and the camera was not watched for a while: the verdict stays, and can be
  /// disproved soon.
  void loosen();
  /// Nothing connects the next image with the last one.
  void reset();

  [[nodiscard]] Orientation verdict() const { return verdict_; }

 private:
  [[nodiscard]] double evidence();
  void judge(double evidence);

  bool has_horizon_ = false;
  double horizon_y_ = 0.0;     // of the direction of travel, in normalised coordinates
  std::vector<double> above_;  // distances of this image's tracks to the line of travel
  std::vector<double> below_;
  double sum_ = 0.0;
  Orientation verdict_ = Orientation::kUnseen;
};

}  // namespace plumb::vo
