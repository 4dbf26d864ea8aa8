#include "modules/mount/speed_track.hpp"

#include <algorithm>

namespace plumb {
namespace {

constexpr std::int64_t kNewTrack_us = 1'000'000;

double seconds(std::int64_t time_us) { return 1e-6 * static_cast<double>(time_us); }

/// The speed at a time between two samples.
double speed_at(const VehicleSpeed& a, const VehicleSpeed& b, std::int64_t time_us) {
  const double share = seconds(time_us - a.time_us) / seconds(b.time_us - a.time_us);
  return a.speed_m_s + share * (b.speed_m_s - a.speed_m_s);
}

}  // namespace

const char* SpeedTrack::take(const VehicleSpeed& speed) {
  if (size_ > 0 && speed.time_us <= newest().time_us) {
    if (newest().time_us - speed.time_us <= kNewTrack_us)
      return "vehicle speed came twice or out of order";
    size_ = 0;
  }
  if (size_ == kMostSamples) {
    first_ = (first_ + 1) % kMostSamples;
    --size_;
  }
  samples_[(first_ + size_) % kMostSamples] = speed;
  ++size_;
  return nullptr;
}

std::optional<double> SpeedTrack::way_m(std::int64_t begin_us, std::int64_t end_us) const {
  if (size_ < 2 || begin_us < at(0).time_us || !reaches(end_us)) return std::nullopt;
  std::size_t i = size_ - 1;
  while (i > 0 && at(i).time_us > begin_us) --i;
  double way_m = 0.0;
  for (; i + 1 < size_ && at(i).time_us < end_us; ++i) {
    const VehicleSpeed& a = at(i);
    const VehicleSpeed& b = at(i + 1);
    if (b.time_us - a.time_us > kMostGap_us) return std::nullopt;
    const std::int64_t from_us = std::max(begin_us, a.time_us);
    const std::int64_t to_us = std::min(end_us, b.time_us);
    way_m += 0.5 * (speed_at(a, b, from_us) + speed_at(a, b, to_us)) * seconds(to_us - from_us);
  }
  return way_m;
}

}  // namespace plumb
