/// Runs a V4L2 camera: frames as they come, and what to do when they do not.
///
/// Silence  longer than camera.timeout_s is reported; longer than three times that counts as a loss.
/// Loss     camera.on_loss = "retry": opens again after pauses that double; "exit": says why in one
///          more health message and ends the process with exit code 1.
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
  /// `source` is open. All three outlive the node.
  LiveNode(Process& process, DeviceSource& source, PublishNode& output, const CameraConfig& config);

 private:
  static constexpr std::int64_t kTick_us = 100'000;
  /// A loss stays in health this long, even when the camera is back at once.
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
  std::int64_t alive_us_;      ///< when the device last gave a frame, or was opened
  std::int64_t retry_us_ = 0;  ///< when to open again; holds while the device is closed
  std::int64_t shown_until_us_ = 0;
  std::string text_;  ///< room for sentences
};

}  // namespace plumb
