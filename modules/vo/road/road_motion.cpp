#include "modules/vo/road/road_motion.hpp"

#include <algorithm>
#include <cmath>

#include "core/numbers.hpp"
#include "modules/vo/road/running_mean.hpp"

namespace plumb::vo {
namespace {

// Ages of the images that the newest one is compared with. Long ones measure finely, short ones
// tell repeating marks apart.
constexpr std::array<double, 3> kAges_s{0.1, 0.15, 0.25};
constexpr double kMostAge_s = 0.4;
// Images closer than this to the last one that was kept are not kept.
constexpr double kLeastApart_s = 0.03;

// The camera looks forward: other directions of VO are none of travel.
constexpr double kMostSlope = 0.3;
constexpr double kHeadingTime_s = 5.0;
constexpr double kPitchMeanTime_s = 1.0;
// While VO's translation is not believed, its direction counts less, and not at all far off.
constexpr double kDoubtedPitchTime_s = 2.0;
constexpr double kMostDoubtedTurn = 0.1;
constexpr double kSteadyTime_s = 1.2;

/// A feature of 0 means that the road is not seen there, and stays 0.
float without_steady(float feature, float steady) {
  return feature == 0.0F ? 0.0F : feature - steady;
}

/// The feature at `part` of the way from column `left` to the next one; 0 beyond the row.
float between_columns(const float* row, std::ptrdiff_t left, float part) {
  constexpr auto kLast = static_cast<std::ptrdiff_t>(kNumRoadColumns) - 1;
  if (left < 0 || left > kLast || (left == kLast && part > 0.0F)) return 0.0F;
  const float next = left < kLast ? row[left + 1] : 0.0F;
  return row[left] + part * (next - row[left]);
}

}  // namespace

void RoadMotion::reset() {
  speed_.reset();
  direction_.setZero();
  num_directions_ = 0;
  num_images_ = 0;
  num_past_ = 0;
  next_past_ = 0;
}

void RoadMotion::miss(double dt_s) {
  num_past_ = 0;
  next_past_ = 0;
  speed_.update({}, dt_s);
}

void RoadMotion::take(const ImageView& image, const VoOutput& vo, bool trusts_direction,
                      double dt_s) {
  time_s_ += dt_s;
  R_first_cam_ = R_first_cam_ * vo.T_prev_cam.R;
  follow_direction(vo, trusts_direction, dt_s);
  finder_.find(image, direction_, &features_);
  const auto share = static_cast<float>(weight_of_new(dt_s, kSteadyTime_s, num_images_++));
  for (std::size_t i = 0; i < features_.size(); ++i)
    steady_[i] += share * (features_[i] - steady_[i]);
  compare(dt_s);
  remember();
}

/// The pitch turns against VO's rotation. The heading stays: a car that turns drives where it
/// looks.
void RoadMotion::follow_direction(const VoOutput& vo, bool trusts_direction, double dt_s) {
  if (num_directions_ > 0) {
    const Eigen::Vector3d turned = vo.T_prev_cam.R.transpose() * direction_.homogeneous();
    direction_.y() = turned.y() / turned.z();
  }
  const Eigen::Vector3d& t = vo.T_prev_cam.t;
  if (vo.status != VoStatus::kOk || !(t.z() > 0.0)) return;
  const Eigen::Vector2d slope = t.head<2>() / t.z();
  if (slope.norm() > kMostSlope) return;
  const Eigen::Vector2d change = slope - direction_;
  if (!trusts_direction && change.norm() > kMostDoubtedTurn) return;
  const double pitch_time_s = trusts_direction ? kPitchMeanTime_s : kDoubtedPitchTime_s;
  direction_.x() += weight_of_new(dt_s, kHeadingTime_s, num_directions_) * change.x();
  direction_.y() += weight_of_new(dt_s, pitch_time_s, num_directions_) * change.y();
  ++num_directions_;
}

void RoadMotion::compare(double dt_s) {
  for (std::size_t i = 0; i < features_.size(); ++i)
    now_[i] = without_steady(features_[i], steady_[i]);
  const double last_speed = speed_.estimate().speed;
  FixedVector<RoadPair, kAges_s.size()> pairs;
  const Past* newer = nullptr;
  for (const double age_s : kAges_s) {
    const Past* past = nearest(age_s, newer);
    if (past == nullptr) continue;
    newer = past;
    turn(*past, last_speed);
    RoadShifts& shifts = shifts_[pairs.size()];
    shifts.compare(now_, before_);
    (void)pairs.push_back({&shifts, time_s_ - past->time_s});
  }
  speed_.update({pairs.begin(), pairs.size()}, dt_s);
}

/// The image whose age is nearest to `age_s` and that is older than `newer`; null for none.
const RoadMotion::Past* RoadMotion::nearest(double age_s, const Past* newer) const {
  const Past* best = nullptr;
  for (std::size_t i = 0; i < num_past_; ++i) {
    const Past& past = past_[i];
    const double age = time_s_ - past.time_s;
    if (age > kMostAge_s || (newer != nullptr && past.time_s >= newer->time_s)) continue;
    if (best == nullptr || std::abs(age - age_s) < std::abs(time_s_ - best->time_s - age_s))
      best = &past;
  }
  return best;
}

/// Fills before_ with the features of an older image as a car would have seen them that looked
/// where it looks now: while it turned, the road moved aside in proportion to the distance.
void RoadMotion::turn(const Past& past, double speed) {
  const Eigen::Vector3d ahead =
      past.R_first_cam.transpose() * R_first_cam_ * direction_.homogeneous();
  const double heading = ahead.x() / ahead.z() - direction_.x();
  const double half_way = 0.5 * speed * (time_s_ - past.time_s);
  for (std::size_t row = 0; row < kNumRoadRows; ++row) {
    const double aside =
        heading * (row_distance(static_cast<double>(row)) - half_way) / kRoadColumnStep;
    const double whole = std::floor(aside);
    const auto part = static_cast<float>(aside - whole);
    const auto offset = static_cast<std::ptrdiff_t>(std::clamp(whole, -1e6, 1e6));
    for (std::size_t column = 0; column < kNumRoadColumns; ++column) {
      const std::size_t here = row * kNumRoadColumns + column;
      const float* cells = &past.features[row * kNumRoadColumns];
      const std::ptrdiff_t left = static_cast<std::ptrdiff_t>(column) + offset;
      before_[here] = without_steady(between_columns(cells, left, part), steady_[here]);
    }
  }
}

void RoadMotion::remember() {
  const std::size_t newest = (next_past_ + kMostImages - 1) % kMostImages;
  if (num_past_ > 0 && time_s_ - past_[newest].time_s < kLeastApart_s) return;
  Past& past = past_[next_past_];
  past.features = features_;
  past.time_s = time_s_;
  past.R_first_cam = R_first_cam_;
  next_past_ = (next_past_ + 1) % kMostImages;
  num_past_ = std::min(num_past_ + 1, kMostImages);
}

Eigen::Vector2d RoadMotion::direction() const {
  return {direction_.x(), direction_.y() - speed_.estimate().pitch_error};
}

}  // namespace plumb::vo
