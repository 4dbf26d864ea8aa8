/// Measures how long each stage of a frame takes: median, 99th percentile and maximum per stage.
///
/// Units:
///   Durations are in microseconds of CLOCK_MONOTONIC.
/// Memory:
///   Each stage has a histogram in place, about 50 kB in all. Nothing is allocated.
/// Accuracy:
///   Quantiles are within 2 % (32 bins per octave from 0.5 us to 8 s). The maximum is exact.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/stage_probe.hpp"

namespace plumb {

/// A histogram of durations with fixed, logarithmically spaced bins.
class DurationHistogram {
 public:
  void add(double duration_us);
  [[nodiscard]] std::int64_t num_samples() const { return num_samples_; }
  [[nodiscard]] double max_us() const { return max_us_; }
  /// The value that a share `q` in [0, 1] of the samples does not exceed; 0 without samples.
  [[nodiscard]] double quantile_us(double q) const;

 private:
  static constexpr int kBinsPerOctave = 32;
  static constexpr int kOctaves = 24;
  static constexpr double kLowest_us = 0.5;
  std::array<std::uint32_t, static_cast<std::size_t>(kBinsPerOctave* kOctaves)> bins_{};
  std::int64_t num_samples_ = 0;
  double max_us_ = 0.0;
};

struct StageStats {
  const char* name = "";
  std::int64_t num_samples = 0;
  double median_us = 0.0;
  double p99_us = 0.0;
  double max_us = 0.0;
  double last_us = 0.0;  ///< in the newest frame; 0 when the stage did not run in it
};

/// Times one frame by begin(), one mark() per stage, and end(). A stage that is marked twice in a
/// frame counts with its sum. A begin() inside a frame restarts only the running stage, so that a
/// caller may time its own work around a library that calls begin() itself. An abandoned frame
/// needs no end().
class StageTimer final : public StageProbe {
 public:
  static constexpr std::size_t kMaxStages = 16;

  void begin() override;
  void mark(const char* name) override;
  /// Ends the frame. Its stages and their total since the first begin() enter the statistics.
  void end();

  /// Number of stages so far, in the order of their first appearance; the last one is "total".
  [[nodiscard]] std::size_t num_stages() const { return num_frames_ == 0 ? 0 : num_stages_ + 1; }
  [[nodiscard]] StageStats stats(std::size_t stage) const;
  [[nodiscard]] StageStats total() const;
  /// Number of marks that were ignored because kMaxStages - 1 names were in use.
  [[nodiscard]] std::int64_t num_refused() const { return num_refused_; }

 private:
  struct Stage {
    const char* name = "";
    double pending_us = 0.0;
    double last_us = 0.0;
    bool ran = false;
    DurationHistogram histogram;
  };
  static StageStats to_stats(const Stage& stage);

  std::array<Stage, kMaxStages - 1> stages_{};
  Stage total_{"total", 0.0, 0.0, false, {}};
  std::size_t num_stages_ = 0;
  std::int64_t num_frames_ = 0;
  std::int64_t num_refused_ = 0;
  std::int64_t stage_start_ns_ = 0;
  bool in_frame_ = false;
};

}  // namespace plumb
