/// What the chain said about every image of a log: as the log itself holds it, or by replaying the
/// images of the log.
///
/// Errors:
///   Functions throw LogError, ConfigError, or InputError.
/// Memory:
///   About 10 kB per image.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/camera_model.hpp"
#include "core/numbers.hpp"
#include "modules/vo/vo.hpp"
#include "plumb/ego_motion_t.hpp"
#include "plumb/ground_plane_t.hpp"
#include "plumb/objects_t.hpp"
#include "plumb/process_health_t.hpp"

namespace plumb {

struct FrameResult {
  std::int64_t seq = 0;
  std::int64_t capture_us = 0;
  std::optional<ego_motion_t> ego;      ///< absent when the image gave no motion
  std::optional<ground_plane_t> plane;  ///< likewise
  std::optional<objects_t> objects;
  double interval_s = kNan;       ///< from the previous image, by VO_MOTION; NaN when unknown
  std::vector<Feature> features;  ///< of the image
  std::string csv_row;            ///< as of plumb-replay --csv --no-times
  std::vector<process_health_t> health;  ///< that came after this image and before the next
};

/// True while the pose that ends with this motion is measured or predicted.
[[nodiscard]] bool has_pose(const FrameResult& frame);
/// True while the plane is valid.
[[nodiscard]] bool has_plane(const FrameResult& frame);

struct DriveResults {
  std::vector<FrameResult> frames;      ///< one per image, in the order of the log
  std::optional<CameraModel> camera;    ///< the first valid calibration
  std::optional<double> mount_yaw_rad;  ///< of the camera to the left of the direction of travel
  bool replayed = false;                ///< else from the log
  std::vector<std::string> problems;    ///< what was wrong with the log, a sentence each

  /// The frame of an image; null when there is none.
  [[nodiscard]] FrameResult* find(std::int64_t capture_us, std::int64_t seq);
  /// Adds a frame and returns it.
  FrameResult* add(std::int64_t capture_us, std::int64_t seq);

 private:
  std::map<std::pair<std::int64_t, std::int64_t>, std::size_t> places_;
};

struct DriveOptions {
  std::string log;
  std::string config;      ///< for the replay; empty: default settings
  bool replay = false;     ///< replays even when the log holds results
  std::uint64_t seed = 1;  ///< of the replay
};

/// Takes the results in the log when it holds EGO_MOTION, and else replays it. Shows its progress
/// on stderr.
[[nodiscard]] DriveResults read_drive(const DriveOptions& options);

}  // namespace plumb
