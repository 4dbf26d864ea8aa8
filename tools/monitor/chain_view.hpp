/// The newest message of every channel, and what the page shows of them.
///
/// Memory:
///   One message of each kind.
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "plumb/camera_calibration_t.hpp"
#include "plumb/detections_t.hpp"
#include "plumb/ego_motion_t.hpp"
#include "plumb/ground_plane_t.hpp"
#include "plumb/mount_t.hpp"
#include "plumb/objects_t.hpp"
#include "plumb/process_health_t.hpp"
#include "plumb/vo_motion_t.hpp"
#include "tools/monitor/event_watch.hpp"

namespace plumb {

/// The curves; `run` counts the starts of plumb-ground, each of which begins a new world.
inline constexpr std::array kRowNames =
    std::to_array<const char*>({"time_s", "seq", "speed", "speed_std", "pitch", "pitch_std", "roll",
                                "roll_std", "height", "height_std", "scale", "scale_std", "x", "z",
                                "reset", "run", "vo_status", "plane_status", "ego_status"});
/// One point of every curve. NaN: not valid.
using Row = std::array<double, kRowNames.size()>;

/// Names of all status and reason numbers, for the page.
[[nodiscard]] nlohmann::json status_words();

class ChainView {
 public:
  void take(const camera_calibration_t& m) { camera_ = m; }
  void take(const vo_motion_t& m) { vo_ = m; }
  void take(const ground_plane_t& m) { plane_ = m; }
  void take(const ego_motion_t& m);
  void take(const objects_t& m) { objects_ = m; }
  void take(const detections_t& m) { detections_ = m; }
  void take(const mount_t& m) { mount_ = m; }
  void take(const process_health_t& m, std::int64_t now_us);

  [[nodiscard]] const std::optional<camera_calibration_t>& camera() const { return camera_; }
  [[nodiscard]] const std::optional<ego_motion_t>& ego() const { return ego_; }

  /// The results for the image `seq`; a message for another image is left out, and objects may be
  /// up to kMaxObjectAgeUs older.
  [[nodiscard]] nlohmann::json results(std::int64_t seq) const;
  /// What belongs to no image: camera, mount, and the health reports with their age at `now_us`.
  [[nodiscard]] nlohmann::json state(std::int64_t now_us) const;
  /// The curves' point of the image `seq`.
  [[nodiscard]] Row row(double time_s, std::int64_t seq) const;

  static constexpr std::int64_t kMaxObjectAgeUs = 350'000;

 private:
  [[nodiscard]] bool is_of(const std::optional<ego_motion_t>& ego, std::int64_t seq) const {
    return ego && ego->seq == seq;
  }

  struct Health {
    process_health_t message;
    std::int64_t time_us = 0;
  };
  std::optional<camera_calibration_t> camera_;
  std::optional<vo_motion_t> vo_;
  std::optional<ground_plane_t> plane_;
  std::optional<ego_motion_t> ego_;
  std::optional<objects_t> objects_;
  std::optional<detections_t> detections_;
  std::optional<mount_t> mount_;
  std::array<Health, kChainProcesses.size()> health_;
  int num_runs_ = 0;  ///< sessions of plumb-ground that were seen
};

}  // namespace plumb
