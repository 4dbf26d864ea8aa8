#include "modules/vo/orientation_check.hpp"

#include <algorithm>
#include <cmath>

#include "core/percentile.hpp"

namespace plumb::vo {
namespace {

// A track counts when its depth is known to this share, and when it is farther than this from the
// horizon, in normalised coordinates, so that its distance to the line of travel is known, too.
constexpr double kMaxRhoStdRatio = 0.5;
constexpr double kHorizonBand = 0.02;
// Some tracks lie deeper than the road: on reflections, on vehicles that move, beside a bridge.
constexpr double kReach = 0.8;
constexpr std::size_t kMinSideTracks = 8;
// The upper side can be the road only if so many tracks there have nearly the same distance: on
// seven drives, the spread of the road's distances between these percentiles has a median of 0.06
// to 0.19, that of the upper side 0.33 to 0.74. And what stands beside a road is not as high above
// the camera as this: farther away is only what moves along or is attached to the camera.
constexpr std::size_t kMinRoadTracks = 15;
constexpr double kRoadFrom = 0.5;
constexpr double kMaxRoadSpread = 0.3;  // of ln distance
constexpr double kMostAbove = 2.0;      // of ln distance over that of the road
// A side that is seen alone is the road if so many tracks have nearly the same distance.
constexpr std::size_t kMinFloorTracks = 30;
constexpr double kFloorFrom = 0.3;
constexpr double kMaxFloorSpread = 0.35;  // of ln distance
constexpr double kFloorEvidence = 0.5;

// KITTI's drives and rendered ones show at least 0.5 in each image. One image alone proves nothing.
constexpr double kLeastEvidence = 0.2;
constexpr double kMostEvidence = 0.7;
constexpr double kProvenSum = 1.0;
// A camera is seldom mounted upside down, and until that is proven, nothing is valid anyway.
constexpr double kUpsideDownSum = -4.0;
constexpr double kLoosenedSum = 2.0 * kMostEvidence;
// Limits of the sum: at 10 images per second, an upright camera is disproved after 4 s or more of
// steady evidence, and a camera that was upside down is believed again within a second.
constexpr double kMostSum = 30.0;
constexpr double kLeastSum = -6.0;

/// How much the larger distances differ, in ln distance.
double spread_of(std::vector<double>& distances, double from) {
  return std::log(percentile(distances, kReach) / percentile(distances, from));
}

/// Whether the distances are those of a plane that is parallel to the line of travel.
bool is_floor(std::vector<double>& distances) {
  return distances.size() >= kMinFloorTracks && spread_of(distances, kFloorFrom) < kMaxFloorSpread;
}

/// Whether most of the distances may be those of the road.
bool may_be_road(std::vector<double>& distances) {
  return distances.size() >= kMinRoadTracks && spread_of(distances, kRoadFrom) < kMaxRoadSpread;
}

}  // namespace

OrientationCheck::OrientationCheck(std::size_t max_tracks) {
  above_.reserve(max_tracks);
  below_.reserve(max_tracks);
}

void OrientationCheck::begin(const Eigen::Vector3d& travel_cam) {
  above_.clear();
  below_.clear();
  has_horizon_ = std::abs(travel_cam.z()) > travel_cam.head<2>().norm();
  if (has_horizon_) horizon_y_ = travel_cam.y() / travel_cam.z();
}

void OrientationCheck::add(const Eigen::Vector2d& xy, double rho, double rho_std) {
  if (!has_horizon_ || !(rho > 0.0) || rho_std > kMaxRhoStdRatio * rho) return;
  const double down = xy.y() - horizon_y_;
  if (std::abs(down) < kHorizonBand) return;
  (down > 0.0 ? below_ : above_).push_back(std::abs(down) / rho);
}

void OrientationCheck::end() { judge(evidence()); }

void OrientationCheck::see_road() { judge(kMostEvidence); }

/// Returns how much this image speaks for an upright camera; negative when it speaks against it.
double OrientationCheck::evidence() {
  if (above_.size() >= kMinSideTracks && below_.size() >= kMinSideTracks) {
    const double ratio = std::log(percentile(above_, kReach) / percentile(below_, kReach));
    if (ratio < 0.0 && (ratio < -kMostAbove || !may_be_road(above_))) return 0.0;
    return std::abs(ratio) < kLeastEvidence ? 0.0 : ratio;
  }
  if (above_.size() < kMinSideTracks && is_floor(below_)) return kFloorEvidence;
  if (below_.size() < kMinSideTracks && is_floor(above_)) return -kFloorEvidence;
  return 0.0;
}

void OrientationCheck::judge(double evidence) {
  sum_ =
      std::clamp(sum_ + std::clamp(evidence, -kMostEvidence, kMostEvidence), kLeastSum, kMostSum);
  const bool disproved = (verdict_ == Orientation::kUpright && sum_ < 0.0) ||
                         (verdict_ == Orientation::kUpsideDown && sum_ > 0.0);
  if (verdict_ == Orientation::kUnseen || disproved) verdict_ = Orientation::kUnproven;
  if (sum_ >= kProvenSum) verdict_ = Orientation::kUpright;
  if (sum_ <= kUpsideDownSum) verdict_ = Orientation::kUpsideDown;
}

void OrientationCheck::loosen() { sum_ = std::clamp(sum_, -kLoosenedSum, kLoosenedSum); }

void OrientationCheck::reset() {
  sum_ = 0.0;
  if (verdict_ != Orientation::kUnseen) verdict_ = Orientation::kUnproven;
}

}  // namespace plumb::vo
