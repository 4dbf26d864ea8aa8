/// Publishes the frames of a V4L2 camera and reacts to its loss.
///
/// Timeouts:
///   A time without frames longer than camera.timeout_s is reported.
///   Three times that counts as a loss.
/// Loss:
///   With camera.on_loss = "retry" the device is opened again after pauses that double. With "exit"
///   the reason is published in one more health message, and the process ends with exit code 1.
#pragma once

#include <cstdint>
#include <string>

#include "modules/camera/device_source.hpp"
#include "modules/camera/pacing.hpp"
#include "modules/camera/publish_node.hpp"
#include "platform/process.hpp"

namespace plumb {

class LiveNode {
 public:
  /// `process`, `source` and `output` outlive the node.
  /// @pre `source` is open
  LiveNode(Process& process, DeviceSource& source, PublishNode& output, const CameraConfig& config);

 private:
  static constexpr std::int64_t kTick_us = 100'000;
  /// The health message shows a loss for this time, even when the camera returns at once.
  static constexpr std::int64_t kLossShown_us = 2 * Process::kHealthPeriod_us;

  void on_ready();
  void on_tick();
  void on_loss();
  void on_exit() const;
  void try_again();
  void check_silence(std::int64_t now_us);

  Process& process_;
  DeviceSource& source_;
  PublishNode& output_;
  bool exits_on_loss_;
  std::int64_t timeout_us_;
  BackOff back_off_;
  EventLoop::TimerId exit_timer_;
  std::int64_t alive_us_;            ///< time of the newest frame or of opening
  std::int64_t retry_us_ = 0;        ///< time to open again; valid while the device is closed
  std::int64_t shown_until_us_ = 0;  ///< end of the time for which a loss is shown
  std::string text_;                 ///< storage for sentences
};

}  // namespace plumb
