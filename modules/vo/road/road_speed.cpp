#include "modules/vo/road/road_speed.hpp"

#include <algorithm>
#include <cmath>

#include "core/numbers.hpp"

namespace plumb::vo {
namespace {

constexpr double kSpeedStep = 0.4;
constexpr double kSlowest = 3.0;
constexpr double kPitchStep = 0.002;

// Spread per second: change of speed in heights per second, random walk of the pitch.
constexpr double kAcceleration = 3.0;
constexpr double kPitchWalk = 0.006;
// Deviation of the pitch from the assumed one, which is drawn back to it within kPitchDrawTime_s.
constexpr double kPitchStd = 0.01;
constexpr double kPitchDrawTime_s = 1.0;
// Share of the probability that is spread over everything, so that no peak is final.
constexpr double kUniform = 1e-5;

// Weight of the correlations per second of images, and the most of one image. Images that follow
// each other quickly share most of their errors.
constexpr double kGain_per_s = 40.0;
constexpr double kMostGain = 4.0;
// Squares below which a correlation counts less.
constexpr double kLeastSquares = 4.0;

// The peak must hold this share, and be clearly faster than the slowest speed of the grid.
constexpr double kSureShare = 0.9;
// Mean correlation of the road. Of eleven drives, played backwards or forwards, peaks that were no
// road had at most 0.28 in 95 % of the images, and the road at least 0.33 but on one clip.
// A road that was seen may have a bare stretch.
constexpr double kLeastNewSupport = 0.3;
constexpr double kLeastHeldSupport = 0.15;
constexpr double kSupportTime_s = 0.5;
constexpr double kSlowestSure = 6.0;
constexpr double kPeakRatio = 0.15;
constexpr double kPeakWidth = 0.5;

constexpr std::size_t kMostTaps = 16;

/// Weights of a normalised Gaussian at -n..n steps.
struct Kernel {
  std::array<double, kMostTaps + 1> weights{};  // of 0..n
  std::size_t reach = 0;
};

Kernel gaussian(double std_steps) {
  const double std = std::max(std_steps, 0.2);
  Kernel kernel;
  kernel.reach = std::min(kMostTaps, static_cast<std::size_t>(4.0 * std + 1.0));
  double sum = 0.0;
  for (std::size_t i = 0; i <= kernel.reach; ++i) {
    kernel.weights[i] = std::exp(-0.5 * square(static_cast<double>(i) / std));
    sum += (i == 0 ? 1.0 : 2.0) * kernel.weights[i];
  }
  for (double& weight : kernel.weights) weight /= sum;
  return kernel;
}

}  // namespace

double RoadSpeed::speed_of(std::size_t index) { return kSpeedStep * static_cast<double>(index); }

double RoadSpeed::pitch_of(std::size_t index) {
  return kPitchStep * (static_cast<double>(index) - 0.5 * static_cast<double>(kNumPitches - 1));
}

void RoadSpeed::reset() {
  for (std::size_t p = 0; p < kNumPitches; ++p)
    probability_[p].fill(std::exp(-0.5 * square(pitch_of(p) / kPitchStd)));
  normalize();
  estimate_ = {};
  support_ = 0.0;
  is_supported_ = false;
}

void RoadSpeed::update(std::span<const RoadPair> pairs, double dt_s) {
  spread_speed(dt_s);
  spread_pitch(dt_s);
  normalize();
  const double gain = std::min(kMostGain, kGain_per_s * dt_s);
  double most = -kInf;
  for (std::size_t p = 0; p < kNumPitches; ++p) {
    for (std::size_t v = 0; v < kNumSpeeds; ++v) {
      scratch_[p][v] = gain * agreement(pairs, p, v);
      most = std::max(most, scratch_[p][v]);
    }
  }
  for (std::size_t p = 0; p < kNumPitches; ++p) {
    for (std::size_t v = 0; v < kNumSpeeds; ++v)
      probability_[p][v] *= std::exp(scratch_[p][v] - most);
  }
  normalize();
  locate_peak();
  follow_support(pairs, dt_s);
}

/// The probability always has a peak; only the correlation there says whether the road is seen.
void RoadSpeed::follow_support(std::span<const RoadPair> pairs, double dt_s) {
  double now = 0.0;
  if (!pairs.empty()) {
    const auto speed = static_cast<std::size_t>(std::lround(estimate_.speed / kSpeedStep));
    const auto pitch = static_cast<std::size_t>(std::lround(
        estimate_.pitch_error / kPitchStep + 0.5 * static_cast<double>(kNumPitches - 1)));
    now = agreement(pairs, pitch, std::min(speed, kNumSpeeds - 1)) /
          static_cast<double>(pairs.size());
  }
  support_ += std::min(1.0, dt_s / kSupportTime_s) * (now - support_);
  is_supported_ = support_ > (is_supported_ ? kLeastHeldSupport : kLeastNewSupport);
  estimate_.support = std::min(support_, now);
  estimate_.sure = peak_share_ > kSureShare && estimate_.speed > kSlowestSure && is_supported_;
}

void RoadSpeed::spread_speed(double dt_s) {
  const Kernel kernel = gaussian(kAcceleration * dt_s / kSpeedStep);
  for (std::size_t p = 0; p < kNumPitches; ++p) {
    for (std::size_t v = 0; v < kNumSpeeds; ++v) {
      double sum = kernel.weights[0] * probability_[p][v];
      for (std::size_t i = 1; i <= kernel.reach; ++i) {
        if (v >= i) sum += kernel.weights[i] * probability_[p][v - i];
        if (v + i < kNumSpeeds) sum += kernel.weights[i] * probability_[p][v + i];
      }
      scratch_[p][v] = sum;
    }
  }
  probability_ = scratch_;
}

void RoadSpeed::spread_pitch(double dt_s) {
  const Kernel kernel = gaussian(kPitchWalk * std::sqrt(dt_s) / kPitchStep);
  for (std::size_t p = 0; p < kNumPitches; ++p) {
    const double drawn =
        std::exp(-0.5 * square(pitch_of(p) / kPitchStd) * std::min(1.0, dt_s / kPitchDrawTime_s));
    for (std::size_t v = 0; v < kNumSpeeds; ++v) {
      double sum = kernel.weights[0] * probability_[p][v];
      for (std::size_t i = 1; i <= kernel.reach; ++i) {
        if (p >= i) sum += kernel.weights[i] * probability_[p - i][v];
        if (p + i < kNumPitches) sum += kernel.weights[i] * probability_[p + i][v];
      }
      scratch_[p][v] = drawn * sum;
    }
  }
  probability_ = scratch_;
}

/// Makes the sum one, with a share for every speed and pitch.
void RoadSpeed::normalize() {
  double sum = 0.0;
  for (Row& row : probability_) {
    for (std::size_t v = 0; v < kNumSpeeds; ++v) {
      if (speed_of(v) < kSlowest) row[v] = 0.0;
      sum += row[v];
    }
  }
  constexpr double kShare = kUniform / static_cast<double>(kNumPitches * kNumSpeeds);
  for (Row& row : probability_) {
    for (std::size_t v = 0; v < kNumSpeeds; ++v)
      row[v] = speed_of(v) < kSlowest ? 0.0 : row[v] / sum + kShare;
  }
}

double RoadSpeed::agreement(std::span<const RoadPair> pairs, std::size_t pitch,
                            std::size_t speed) const {
  double sum = 0.0;
  for (const RoadPair& pair : pairs) {
    Agreement all;
    for (std::size_t zone = 0; zone < kNumZones; ++zone) {
      const double seen = speed_of(speed) * (1.0 + 2.0 * pitch_of(pitch) * zone_distance(zone));
      const Agreement part = pair.shifts->at(zone, seen * pair.interval_s / kRoadRowStep);
      all.product += part.product;
      all.now += part.now;
      all.before += part.before;
    }
    sum += all.product / std::sqrt(all.now * all.before + kLeastSquares);
  }
  return sum;
}

/// Takes the mean and the deviation of the speed around the highest peak.
void RoadSpeed::locate_peak() {
  Row of_speed{};
  double pitch_error = 0.0;
  for (std::size_t p = 0; p < kNumPitches; ++p) {
    for (std::size_t v = 0; v < kNumSpeeds; ++v) {
      of_speed[v] += probability_[p][v];
      pitch_error += pitch_of(p) * probability_[p][v];
    }
  }
  const double peak = speed_of(static_cast<std::size_t>(
      std::max_element(of_speed.begin(), of_speed.end()) - of_speed.begin()));
  double share = 0.0, mean = 0.0, mean_square = 0.0;
  for (std::size_t v = 0; v < kNumSpeeds; ++v) {
    if (std::abs(speed_of(v) - peak) > kPeakRatio * peak + kPeakWidth) continue;
    share += of_speed[v];
    mean += of_speed[v] * speed_of(v);
    mean_square += of_speed[v] * square(speed_of(v));
  }
  estimate_.speed = mean / share;
  estimate_.speed_std = std::sqrt(std::max(0.0, mean_square / share - square(estimate_.speed)));
  estimate_.pitch_error = pitch_error;
  peak_share_ = share;
}

}  // namespace plumb::vo
