/// The speed of the vehicle over the last seconds, and the way that follows from it.
///
/// Units:
///   Metres and microseconds, on the clock of the images.
/// Memory:
///   kMostSamples in place.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace plumb {

/// One speed of the vehicle's own.
struct VehicleSpeed {
  std::int64_t time_us = 0;
  double speed_m_s = 0.0;  ///< forward positive
  double scale_std = 0.0;  ///< relative standard deviation that all speeds share
};

class SpeedTrack {
 public:
  static constexpr std::size_t kMostSamples = 512;
  /// Between speeds farther apart, the speed is not known.
  static constexpr std::int64_t kMostGap_us = 250'000;

  /// Takes the next speed. Returns null, or why it is refused: its time is not after the last
  /// one's. A time that lies more than a second back begins the track anew.
  [[nodiscard]] const char* take(const VehicleSpeed& speed);

  /// True when the track has reached `time_us`.
  [[nodiscard]] bool reaches(std::int64_t time_us) const {
    return size_ > 0 && newest().time_us >= time_us;
  }
  /// [m] The way between two times, by straight lines between the speeds. Nothing when a part of it
  /// is not known.
  [[nodiscard]] std::optional<double> way_m(std::int64_t begin_us, std::int64_t end_us) const;
  /// @pre take() has taken a speed
  [[nodiscard]] const VehicleSpeed& newest() const { return at(size_ - 1); }

 private:
  [[nodiscard]] const VehicleSpeed& at(std::size_t index) const {
    return samples_[(first_ + index) % kMostSamples];
  }

  std::array<VehicleSpeed, kMostSamples> samples_{};
  std::size_t first_ = 0;
  std::size_t size_ = 0;
};

}  // namespace plumb
