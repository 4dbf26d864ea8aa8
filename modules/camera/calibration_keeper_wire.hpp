/// Decides which calibration of the camera holds.
///
/// Configured:
///   A calibration that the configuration states holds for good. Messages confirm it, and one that
///   contradicts it is refused.
/// Otherwise:
///   The first valid message holds. A message that contradicts it casts doubt on both, so that
///   nothing is valid until a message confirms the one that holds, or until `kNumToAdopt` equal
///   ones in a row contradict it: then that one holds, and whoever was built for the earlier one is
///   built anew.
/// Memory:
///   In place. Sizes are bounded before anybody takes memory for them (from_wire).
#pragma once

#include "core/camera_model.hpp"
#include "plumb/camera_calibration_t.hpp"

namespace plumb {

class CalibrationKeeper {
 public:
  static constexpr int kNumToAdopt = 3;

  /// States the calibration before any message does.
  void configure(const CameraModel& camera);

  /// Returns null when the message agrees with the calibration that holds now, else why it is
  /// refused.
  [[nodiscard]] const char* take(const camera_calibration_t& message);

  /// Whether another camera holds than at the previous call.
  [[nodiscard]] bool take_change();

  [[nodiscard]] bool is_known() const { return is_known_; }
  [[nodiscard]] const CameraModel& camera() const { return camera_; }
  /// Whether the newest message contradicts a calibration that only messages have stated.
  [[nodiscard]] bool is_doubted() const { return num_against_ > 0 && !is_configured_; }

 private:
  void adopt(const CameraModel& camera);

  bool is_known_ = false;
  bool is_configured_ = false;
  bool has_changed_ = false;
  CameraModel camera_;
  CameraModel other_;    ///< what the newest contradicting message says
  int num_against_ = 0;  ///< equal messages in a row that say `other_`
};

}  // namespace plumb
