/// Watches a running chain: takes the newest messages from the bus and frames from CAN, and gives
/// the web server a frame at the monitor's own rate.
///
/// Safety:
///   It publishes nothing. While no page is open, images are counted and not looked at.
/// Memory:
///   Two images per subscriber, kNumImages copies, and one message of each kind.
/// Threads:
///   Everything but the functions of MonitorSource belongs to the thread of `loop`.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "modules/chain/plumb_config.hpp"
#include "platform/bus.hpp"
#include "platform/event_loop.hpp"
#include "tools/monitor/can_feed.hpp"
#include "tools/monitor/can_view.hpp"
#include "tools/monitor/chain_view.hpp"
#include "tools/monitor/event_log.hpp"
#include "tools/monitor/monitor_source.hpp"
#include "tools/monitor/page_latency.hpp"
#include "tools/monitor/picture.hpp"
#include "tools/monitor/web_server.hpp"

namespace plumb {

struct LiveOptions {
  std::string lcm_url;
  std::string interface;  ///< of CAN; empty: none
  std::string trace;      ///< that plumb-can writes; empty: none
  double rate_hz = 10.0;  ///< frames for the page
};

class LiveMonitor final : public MonitorSource {
 public:
  /// Throws BusError, and InputError for CAN addresses that do not fit together.
  LiveMonitor(const LiveOptions& options, const PlumbConfig& config);

  /// Serves `server` from the loop until it stops.
  void run(EventLoop* loop, WebServer* server);

  std::string hello() override { return hello_; }
  std::shared_ptr<const Packet> news(NewsCursor* cursor) override;
  std::shared_ptr<const Packet> frame(std::int64_t /*index*/) override { return nullptr; }
  void acknowledge(std::int64_t id) override;

 private:
  struct Image {
    std::int64_t seq = -1;
    std::int64_t arrival_us = 0;
    std::vector<std::uint8_t> bytes;
    std::size_t size = 0;
  };
  /// What waits to be sent: the results of one image, until its objects and its burst on CAN have
  /// come, too.
  struct Waiting {
    bool active = false;
    std::int64_t seq = -1;
    std::int64_t arrival_us = 0;  ///< of the results
    std::int64_t send_us = 0;     ///< at the latest
    const Image* image = nullptr;
    bool for_objects = false;
    bool for_can = false;
  };
  static constexpr std::size_t kNumImages = 3;
  static constexpr std::int64_t kLongestWaitUs = 30'000;
  static constexpr std::int64_t kTickUs = 10'000;
  static constexpr std::int64_t kSilenceUs = 400'000;  ///< after which images go without results

  template <typename Message>
  std::unique_ptr<Subscriber<Message>> watch(const Channel& channel,
                                             std::function<void(const Message&)> take);
  void subscribe();
  void on_image(RawSubscriber::Bytes bytes);
  void on_ego(const ego_motion_t& message);
  void on_objects(const objects_t& message);
  void tick();
  void send_when_complete(std::int64_t now_us);
  void send_waiting(std::int64_t now_us);
  void send_state(std::int64_t now_us);
  void send(nlohmann::json message, const Image* image, std::int64_t arrival_us);
  [[nodiscard]] const Image* image_of(std::int64_t seq) const;
  [[nodiscard]] const Image* newest_image() const;
  [[nodiscard]] nlohmann::json monitor_state(std::int64_t now_us);
  void heard(const Channel& channel);
  [[nodiscard]] double time_s(std::int64_t now_us) const {
    return static_cast<double>(now_us - start_us_) * 1e-6;
  }

  LiveOptions options_;
  std::int64_t start_us_;
  std::int64_t period_us_;
  Counters counters_;
  Bus bus_;
  ChainView view_;
  CanView can_;
  EventLog events_;
  EventWatch watch_;
  CanFeed can_feed_;
  PictureEncoder encoder_;
  PageLatency latency_;
  WebServer* server_ = nullptr;
  std::string hello_;
  std::string can_state_;
  std::array<Image, kNumImages> images_;
  Waiting waiting_;
  std::int64_t next_id_ = 0;
  std::int64_t num_frames_ = 0;
  std::int64_t last_frame_us_ = 0;
  std::int64_t next_state_us_ = 0;
  std::int64_t last_objects_us_ = INT64_MIN / 2;
  std::int64_t last_cpu_us_ = 0;
  std::int64_t last_cpu_at_us_ = 0;
  double cpu_share_ = 0.0;
  struct Heard {
    const Channel* channel;
    std::int64_t time_us = 0;
    std::int64_t num = 0;
  };
  std::vector<Heard> heard_;
  std::vector<std::unique_ptr<RawSubscriber>> raw_;
  std::vector<std::shared_ptr<void>> typed_;
};

}  // namespace plumb
