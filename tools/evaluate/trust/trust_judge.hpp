/// Judges each image's speed and scale against the truth, in stated standard deviations.
///
/// The true scale is the true path over nine images divided by VO's path over the same images, in
/// one scale epoch.
///
/// Units:
///   m/s; the scale in metres per [vo].
#pragma once

#include <string>
#include <vector>

#include "tools/evaluate/faults/fault_judge.hpp"
#include "tools/evaluate/trust/trust_rows.hpp"

namespace plumb {

struct FrameTrust {
  std::int64_t seq = 0;
  int status = 0;
  bool valid = false;  ///< gives a speed
  double speed_m_s = 0.0;
  double speed_std_m_s = 0.0;
  double true_speed_m_s = 0.0;
  double log_scale = 0.0;
  double log_scale_std = 0.0;
  double true_log_scale = 0.0;  ///< NaN where VO's path does not give it

  [[nodiscard]] bool wrong() const;
  [[nodiscard]] double speed_nees() const;
  [[nodiscard]] double scale_nees() const;
};

/// One run through the chain; one entry per image. `speed_up` is how many images of the drive lie
/// between two of the run: the truth is averaged over the same stretch of the drive.
[[nodiscard]] std::vector<FrameTrust> judge_trust(const FaultRun& run, std::size_t speed_up,
                                                  const PlumbConfig& config);

struct TrustResult {
  std::int64_t num_images = 0;
  std::int64_t num_valid = 0;
  std::int64_t num_wrong = 0;
  double worst_error_m_s = 0.0;
  double speed_nees = 0.0;  ///< mean over all valid images
  double scale_nees = 0.0;

  [[nodiscard]] double wrong_ratio() const;
};
[[nodiscard]] TrustResult summarise_trust(const std::vector<FrameTrust>& frames);

}  // namespace plumb
