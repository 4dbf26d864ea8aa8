/// Decides whether VO's translation or that of the road is the car's.
///
/// Features:
///   VO's unit of length drifts slowly, so that the ratio of VO's step to the road's way is steady.
///   When the ratio jumps from image to image or runs away, or VO sees no translation while the
///   road passes, VO follows something else than the world.
/// Road:
///   The road's speed is the motion, until the ratio has been steady for a while, or the road was
///   not seen for long.
/// Units:
///   [vo], heights of the camera, seconds.
#pragma once

#include "modules/vo/road/road_speed.hpp"
#include "modules/vo/vo.hpp"

namespace plumb::vo {

enum class MotionSource : std::int8_t { kFeatures, kRoad };

class RoadWatch {
 public:
  /// Forgets everything and trusts the features.
  void reset() { *this = RoadWatch(); }
  /// Takes VO's result of an image, with the road's speed in it; returns whose translation counts.
  MotionSource judge(const VoOutput& vo, const RoadSpeedEstimate& road, double dt_s);

  [[nodiscard]] MotionSource source() const { return source_; }
  /// Enough steps were compared with the road for unit().
  [[nodiscard]] bool knows_unit() const { return num_ratios_ >= kLeastRatios; }
  /// VO's unit in this image [vo per height]; 1 when it was never seen.
  [[nodiscard]] double unit() const;

 private:
  static constexpr int kLeastRatios = 3;

  void follow_ratio(double ln_ratio, double dt_s);
  void doubt_features(const VoOutput& vo, const RoadSpeedEstimate& road, bool compared,
                      double dt_s);
  void doubt_road(bool sure, bool compared, double dt_s);

  MotionSource source_ = MotionSource::kFeatures;
  int num_ratios_ = 0;
  double ln_ratio_ = 0.0;     // of VO's step to the road's way, mean of the last images
  double usual_ratio_ = 0.0;  // mean over a longer time
  double last_ratio_ = 0.0;   // of the last image
  double jump_ = 0.0;         // mean change from image to image
  double doubt_s_ = 0.0;      // time for which the features contradicted the road
  double steady_s_ = 0.0;     // time for which the ratio was steady
  double unseen_s_ = 0.0;     // time without a road
};

}  // namespace plumb::vo
