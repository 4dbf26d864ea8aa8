/// True poses and planes of a log's images.
///
/// Frames:
///   cam: x right, y down, z forward.
/// Units:
///   metres.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "core/se3.hpp"
#include "modules/datasets/kitti/plane_file.hpp"

namespace plumb {

class TruthTrack {
 public:
  /// Reads GROUND_TRUTH of `log`; planes of `plane_file` (may be empty) replace those in it.
  /// Throws InputError, LogError; also when the log has no true pose at all.
  TruthTrack(const std::string& log, const std::string& plane_file);

  /// T_from_to: cam of image `to` seen from `from`; nothing when one has no pose.
  [[nodiscard]] std::optional<Se3> motion(std::int64_t from, std::int64_t to) const;
  /// Null when image `seq` has no true plane.
  [[nodiscard]] const TruePlane* plane(std::int64_t seq) const;

 private:
  std::map<std::int64_t, Se3> T_world_cam_;
  std::map<std::int64_t, TruePlane> planes_;
};

}  // namespace plumb
