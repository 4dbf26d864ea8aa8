/// Shows a log. Results that the log holds are shown as they were recorded; a log that holds only
/// inputs runs through the chain (modules/chain), as fast as it goes, and every frame can be looked
/// at as soon as it has been computed.
///
/// Threads:
///   Everything but the functions of MonitorSource belongs to the thread that calls run().
/// Errors:
///   The constructor and run() throw LogError, and what Chain and FrameStore throw.
#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <string>

#include "core/channels.hpp"
#include "modules/chain/chain.hpp"
#include "platform/log_file.hpp"
#include "tools/monitor/can_view.hpp"
#include "tools/monitor/chain_view.hpp"
#include "tools/monitor/event_log.hpp"
#include "tools/monitor/frame_store.hpp"
#include "tools/monitor/monitor_source.hpp"
#include "tools/monitor/picture.hpp"

namespace plumb {

class LogMonitor final : public MonitorSource, public CanSink {
 public:
  /// `recompute`: results in the log are ignored, and the chain runs.
  LogMonitor(const std::string& path, const PlumbConfig& config, bool recompute);
  ~LogMonitor() override;
  LogMonitor(const LogMonitor&) = delete;
  LogMonitor& operator=(const LogMonitor&) = delete;

  /// Reads the log to its end, or until `stopped` says so. `notify` is called as frames come.
  void run(const std::function<bool()>& stopped, const std::function<void()>& notify);

  std::string hello() override { return hello_; }
  std::shared_ptr<const Packet> news(NewsCursor* cursor) override;
  std::shared_ptr<const Packet> frame(std::int64_t index) override;
  void acknowledge(std::int64_t /*id*/) override {}

  /// A frame that the chain puts on CAN.
  void send(std::int64_t time_us, const CanFrame& frame) override;

  [[nodiscard]] bool is_recorded() const { return is_recorded_; }
  [[nodiscard]] std::int64_t num_frames() const { return store_.size(); }
  /// What was wrong with the log: damaged places and refused messages; empty when nothing was.
  [[nodiscard]] std::string trouble() const;

  static constexpr std::size_t kRowsPerPacket = 400;

 private:
  struct Pending {
    bool active = false;
    std::int64_t seq = -1;
    double time_s = 0.0;
    const char* refused = nullptr;
    ImagePlace image;
  };
  struct SeenImage {
    std::int64_t seq;
    ImagePlace place;
  };
  static constexpr std::int64_t kEventsToJudgeBy = 2000;
  static constexpr std::size_t kImagesToPairWith = 64;

  [[nodiscard]] bool holds_results(const std::string& path) const;
  void take(const LogEvent& event);
  void take_input(const LogEvent& event);
  void take_recorded(const LogEvent& event);
  void take_record(const FrameRecord& record);
  void take_stages(const char* process, const StageTimer& timer);
  void take_image(const LogEvent& event);
  void begin_frame(std::int64_t seq);
  void finish_frame();
  template <typename Message>
  bool decode_as(const LogEvent& event, const Channel& channel, Message* message) const;

  std::string path_;
  LogReader reader_;
  bool is_recorded_;
  ChainView view_;
  CanView can_;
  EventLog events_;
  EventWatch watch_;
  FrameStore store_;
  std::unique_ptr<Chain> chain_;
  PictureEncoder encoder_;  ///< used by the server's thread
  std::string hello_;
  int images_fd_ = -1;
  Pending pending_;
  std::deque<SeenImage> images_;
  std::int64_t first_us_ = -1;
  std::int64_t now_us_ = 0;  ///< of the log
  std::int64_t can_us_ = 0;
  std::int64_t next_id_ = 0;
  std::atomic<std::int64_t> read_bytes_ = 0;
  std::atomic<bool> done_ = false;
};

}  // namespace plumb
