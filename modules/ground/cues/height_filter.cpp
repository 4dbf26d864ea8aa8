#include "modules/ground/cues/height_filter.hpp"

#include <cmath>

namespace plumb {
namespace {

constexpr double kUnknownPitchVar = 0.04;  ///< [rad^2] 1-sigma of 11 degrees: unknown

}  // namespace

HeightFilter::HeightFilter(const Prior& prior) : prior_(prior) {
  decorrelate(kPitch, prior.mean_pitch_rad, kUnknownPitchVar);
  decorrelate(kSlow, prior.mean_pitch_rad, prior.pitch_std_rad * prior.pitch_std_rad);
}

void HeightFilter::decorrelate(int i, double mean, double var) {
  P_.row(i).setZero();
  P_.col(i).setZero();
  P_(i, i) = var;
  x_(i) = mean;
}

void HeightFilter::predict(double dt_s) {
  // First-order Gauss-Markov about the calibrated pitch.
  const double keep = std::exp(-dt_s / prior_.pitch_time_s);
  x_(kSlow) = prior_.mean_pitch_rad + keep * (x_(kSlow) - prior_.mean_pitch_rad);
  P_.row(kSlow) *= keep;
  P_.col(kSlow) *= keep;
  P_(kSlow, kSlow) += (1.0 - keep * keep) * prior_.pitch_std_rad * prior_.pitch_std_rad;
  const double drift = prior_.log_height_rate_std * prior_.log_height_rate_std * dt_s;
  for (std::size_t slot = 0; slot < kMaxHeights; ++slot) {
    if (slots_[slot].in_use) P_(row(slot), row(slot)) += drift;
  }
  decorrelate(kPitch, x_(kSlow), kUnknownPitchVar);
}

HeightFilter::Place HeightFilter::place_of(std::int32_t track_id, std::int8_t object_class,
                                           double log_height, double log_height_var,
                                           std::int64_t capture_us) {
  std::size_t chosen = kNone;
  for (std::size_t slot = 0; slot < kMaxHeights; ++slot) {
    Slot& candidate = slots_[slot];
    if (candidate.in_use && candidate.track_id == track_id) {
      candidate.seen_us = capture_us;
      if (candidate.object_class == object_class) return {slot, false};
      chosen = slot;  // the detector has changed the class: reset the height
      break;
    }
    const bool replaceable = !candidate.in_use || candidate.seen_us < capture_us;
    if (!replaceable) continue;
    const bool better = chosen == kNone || (slots_[chosen].in_use && !candidate.in_use) ||
                        (slots_[chosen].in_use && candidate.seen_us < slots_[chosen].seen_us);
    if (better) chosen = slot;
  }
  if (chosen == kNone) return {};
  slots_[chosen] = {true, track_id, object_class, capture_us};
  reset_height(chosen, log_height, log_height_var);
  return {chosen, true};
}

void HeightFilter::reset_height(std::size_t slot, double log_height, double log_height_var) {
  decorrelate(row(slot), log_height, log_height_var);
}

void HeightFilter::drop(std::size_t slot) {
  slots_[slot].in_use = false;
  decorrelate(row(slot), 0.0, 0.0);
}

void HeightFilter::drop_before(std::int64_t oldest_us) {
  for (std::size_t slot = 0; slot < kMaxHeights; ++slot) {
    if (slots_[slot].in_use && slots_[slot].seen_us < oldest_us) drop(slot);
  }
}

void HeightFilter::update(int i, double h_i, int j, double h_j, double innovation, double var) {
  const State PH = h_i * P_.col(i) + h_j * P_.col(j);
  const double S = h_i * PH(i) + h_j * PH(j) + var;
  x_ += PH * (innovation / S);
  P_.noalias() -= (PH / S) * PH.transpose();
}

void HeightFilter::update_box(std::size_t slot, double log_height, double pitch_rad,
                              double J_height, double var_rad2) {
  // pitch = pitch_rad + J (true ln height - log_height).
  const double predicted = x_(kPitch) - J_height * (x_(row(slot)) - log_height);
  update(kPitch, 1.0, row(slot), -J_height, pitch_rad - predicted, var_rad2);
}

void HeightFilter::update_pitch(double pitch_rad, double var_rad2) {
  update(kPitch, 1.0, kSlow, 0.0, pitch_rad - x_(kPitch), var_rad2);
}

void HeightFilter::tie_to_slow_pitch(double jitter_var_rad2) {
  update(kPitch, 1.0, kSlow, -1.0, x_(kSlow) - x_(kPitch), jitter_var_rad2);
}

}  // namespace plumb
