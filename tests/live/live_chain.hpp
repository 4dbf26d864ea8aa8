/// Runs the live chain as real processes, which the stock lcm-logplayer feeds.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "platform/bus.hpp"
#include "platform/clock.hpp"
#include "tests/support/child_process.hpp"

namespace plumb::test {

/// Blanks the fields that tell one run of the chain from another: the session of the process, and
/// the capture on the machine's monotonic clock. They follow fingerprint, utime and seq.
inline std::vector<std::uint8_t> without_run(std::vector<std::uint8_t> bytes, bool has_session) {
  constexpr std::size_t kBegin = 24;
  const std::size_t end = std::min(bytes.size(), kBegin + (has_session ? 16U : 8U));
  for (std::size_t i = kBegin; i < end; ++i) bytes[i] = 0;
  return bytes;
}

/// The results of a run.
struct LiveResult {
  using Messages = std::vector<std::vector<std::uint8_t>>;
  bool ready = false;   ///< every process reported its health before the log began
  bool played = false;  ///< lcm-logplayer ended well
  Messages planes;      ///< bytes on GROUND_PLANE, in order, without_run() as all that follow
  Messages egos;
  Messages mounts;
  Messages objects;
  process_health_t vo;  ///< the newest report
  process_health_t ground;
  process_health_t tracker;  ///< of plumb-objects
  process_health_t can;
  std::vector<int> exit_codes;
  std::string output;  ///< what the processes printed
};

class LiveChain {
 public:
  /// `url` of a network that carries nothing else.
  LiveChain(const std::string& url, const std::string& trace_path)
      : url_(url), bus_(url, &counters_) {
    start({"plumb-can", "--lcm-url", url, "--trace", trace_path});
    start({"plumb-objects", "--lcm-url", url});
    start({"plumb-ground", "--lcm-url", url});
    start({"plumb-vo", "--lcm-url", url});
  }

  LiveResult play(const std::string& log, const std::string& speed) {
    LiveResult result;
    result.ready = handle_until(20.0, [this] {
      return vo_.num_seen > 0 && ground_.num_seen > 0 && tracker_.num_seen > 0 && can_.num_seen > 0;
    });
    ChildProcess player({"lcm-logplayer", "-l", url_, "-s", speed, log});
    int code = -1;
    handle_until(120.0, [&] { return (code = player.wait(0.0)) >= 0; });
    result.played = code == 0;
    handle_until(30.0, [this] { return monotonic_us() - last_message_us_ > 1'500'000; });
    for (const auto& child : children_) child->signal(SIGTERM);
    for (const auto& child : children_) {
      result.exit_codes.push_back(child->wait(10.0));
      result.output += child->output();
    }
    while (bus_.handle(50)) {
    }
    result.planes = std::move(planes_);
    result.egos = std::move(egos_);
    result.mounts = std::move(mounts_);
    result.objects = std::move(objects_);
    result.vo = vo_.newest;
    result.ground = ground_.newest;
    result.tracker = tracker_.newest;
    result.can = can_.newest;
    return result;
  }

 private:
  struct HealthOf {
    HealthOf(Bus& bus, const Channel& channel)
        : in(bus, channel, Input::kOccasional, [this](const process_health_t& m) {
            newest = m;
            ++num_seen;
            return nullptr;
          }) {}
    int num_seen = 0;
    process_health_t newest;
    Subscriber<process_health_t> in;
  };

  void start(std::vector<std::string> arguments) {
    children_.push_back(std::make_unique<ChildProcess>(std::move(arguments)));
  }
  const char* keep(LiveResult::Messages* list, RawSubscriber::Bytes bytes,
                   bool has_session = true) {
    list->push_back(without_run({bytes.begin(), bytes.end()}, has_session));
    last_message_us_ = monotonic_us();
    return nullptr;
  }
  template <typename Done>
  bool handle_until(double timeout_s, Done done) {
    const std::int64_t end_us = monotonic_us() + static_cast<std::int64_t>(timeout_s * 1e6);
    while (monotonic_us() < end_us) {
      bus_.handle(20);
      if (done()) return true;
    }
    return false;
  }

  std::string url_;
  Counters counters_;
  Bus bus_;
  std::int64_t last_message_us_ = 0;
  LiveResult::Messages planes_;
  LiveResult::Messages egos_;
  LiveResult::Messages mounts_;
  LiveResult::Messages objects_;
  RawSubscriber plane_in_{bus_, kGroundPlane, Input::kOccasional,
                          [this](RawSubscriber::Bytes b) { return keep(&planes_, b); }};
  RawSubscriber ego_in_{bus_, kEgoMotion, Input::kOccasional,
                        [this](RawSubscriber::Bytes b) { return keep(&egos_, b); }};
  RawSubscriber mount_in_{bus_, kMount, Input::kOccasional,
                          [this](RawSubscriber::Bytes b) { return keep(&mounts_, b, false); }};
  RawSubscriber objects_in_{bus_, kObjects, Input::kOccasional,
                            [this](RawSubscriber::Bytes b) { return keep(&objects_, b, false); }};
  HealthOf vo_{bus_, kHealthVo};
  HealthOf ground_{bus_, kHealthGround};
  HealthOf tracker_{bus_, kHealthObjects};
  HealthOf can_{bus_, kHealthCan};
  std::vector<std::unique_ptr<ChildProcess>> children_;
};

}  // namespace plumb::test
