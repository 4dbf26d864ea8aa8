/// Plays a recording at a multiple of its original speed and then ends the process.
#pragma once

#include <cstdint>

#include "core/counters.hpp"
#include "modules/camera/pacing.hpp"
#include "modules/camera/publish_node.hpp"
#include "modules/camera/recorded_source.hpp"
#include "platform/process.hpp"

namespace plumb {

class PlayerNode {
 public:
  /// With a `speed` of 0 the recording is played as fast as possible. `process`, `source` and
  /// `output` outlive the player.
  PlayerNode(Process& process, RecordedSource& source, PublishNode& output, double speed);

 private:
  /// A frame that is published later than this after its scheduled time counts as late.
  static constexpr std::int64_t kLate_us = 100'000;

  void load_next();
  void on_due();

  Process& process_;
  RecordedSource& source_;
  PublishNode& output_;
  Pacer pacer_;
  LossCounter losses_;
  EventLoop::TimerId due_timer_;
  GreyFrame frame_;
  std::int64_t due_us_ = 0;
};

}  // namespace plumb
