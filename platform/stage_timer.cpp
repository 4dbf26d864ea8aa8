#include "platform/stage_timer.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "platform/clock.hpp"

namespace plumb {

void DurationHistogram::add(double duration_us) {
  const double octave = std::log2(std::max(duration_us, kLowest_us) / kLowest_us);
  const auto last = static_cast<double>(bins_.size() - 1);
  ++bins_[static_cast<std::size_t>(std::min(octave * kBinsPerOctave, last))];
  ++num_samples_;
  max_us_ = std::max(max_us_, duration_us);
}

double DurationHistogram::quantile_us(double q) const {
  if (num_samples_ == 0) return 0.0;
  const auto rank = static_cast<std::int64_t>(std::ceil(q * static_cast<double>(num_samples_)));
  std::int64_t seen = 0;
  for (std::size_t i = 0; i < bins_.size(); ++i) {
    seen += bins_[i];
    if (seen >= std::max<std::int64_t>(rank, 1)) {
      const double centre = (static_cast<double>(i) + 0.5) / kBinsPerOctave;
      return std::min(kLowest_us * std::exp2(centre), max_us_);
    }
  }
  return max_us_;
}

void StageTimer::begin() {
  stage_start_ns_ = monotonic_ns();
  in_frame_ = true;
}

void StageTimer::mark(const char* name) {
  if (!in_frame_) return;
  const std::int64_t now_ns = monotonic_ns();
  const double spent_us = static_cast<double>(now_ns - stage_start_ns_) * 1e-3;
  stage_start_ns_ = now_ns;
  const auto end_of_used = stages_.begin() + static_cast<std::ptrdiff_t>(num_stages_);
  auto stage = std::find_if(stages_.begin(), end_of_used, [name](const Stage& s) {
    return s.name == name || std::strcmp(s.name, name) == 0;
  });
  if (stage == stages_.end()) {
    ++num_refused_;
    return;
  }
  if (stage == end_of_used) {
    stage->name = name;
    ++num_stages_;
  }
  stage->pending_us += spent_us;
  stage->ran = true;
}

void StageTimer::end() {
  if (!in_frame_) return;
  in_frame_ = false;
  total_.last_us = 0.0;
  for (std::size_t i = 0; i < num_stages_; ++i) {
    Stage& stage = stages_[i];
    if (stage.ran) stage.histogram.add(stage.pending_us);
    stage.last_us = stage.pending_us;
    total_.last_us += stage.pending_us;
    stage.pending_us = 0.0;
    stage.ran = false;
  }
  total_.histogram.add(total_.last_us);
  ++num_frames_;
}

StageStats StageTimer::stats(std::size_t stage) const {
  return to_stats(stage < num_stages_ ? stages_[stage] : total_);
}

StageStats StageTimer::total() const { return to_stats(total_); }

StageStats StageTimer::to_stats(const Stage& stage) {
  const DurationHistogram& h = stage.histogram;
  return {stage.name,          h.num_samples(), h.quantile_us(0.5),
          h.quantile_us(0.99), h.max_us(),      stage.last_us};
}

}  // namespace plumb
