/// What tracking and initialisation share: the last two images, the tracks and the window of frames.
///
/// Frames   world: cam of the first frame.  T_a_b maps b to a.
/// Units    lengths in [vo], image positions in pixels.
/// Memory   sized by the configuration and the camera at construction.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "core/camera_model.hpp"
#include "core/pyramid.hpp"
#include "core/stage_probe.hpp"
#include "modules/vo/keyframes.hpp"
#include "modules/vo/pose.hpp"
#include "modules/vo/refine.hpp"
#include "modules/vo/track.hpp"
#include "modules/vo/tracker.hpp"
#include "modules/vo/vo_config.hpp"
#include "modules/vo/window.hpp"

namespace plumb::vo {

/// The track pool holds the active tracks and the passive ones that still tie frames together.
[[nodiscard]] constexpr int track_capacity(const VoConfig& config) { return 3 * config.max_tracks; }

/// What the insertion of a frame did.
struct Insertion {
  bool is_keyframe = false;
  int num_new = 0;                  ///< tracks started in this frame
  double median_parallax_px = 0.0;  ///< rotation-compensated, against the newest keyframe
};

class LocalMap {
 public:
  LocalMap(const VoConfig& config, const CameraModel& camera);

  [[nodiscard]] Pyramid& newest_image() { return pyramids_[newest_]; }
  [[nodiscard]] const Pyramid& newest_image() const { return pyramids_[newest_]; }
  /// The last image that was used. It is valid once has_image() is true.
  [[nodiscard]] const Pyramid& last_image() const { return pyramids_[1 - newest_]; }
  [[nodiscard]] bool has_image() const { return has_image_; }
  /// The newest image, taken at T_cam_world, becomes the last one.
  void keep_image(const Se3& T_cam_world);

  /// Pose of the frame that was handed out last, as refined since. @pre the window is not empty
  [[nodiscard]] Se3 last_pose() const { return window.past_pose(window.history()[0]); }
  /// Pose of the frame of last_image(), as refined since.
  [[nodiscard]] Se3 last_image_pose() const;

  /// Clears tracks and window and starts tracks in `image`, taken at T_cam_world. Returns their number.
  int start_reference(std::int64_t seq, const Se3& T_cam_world, const Pyramid& image);
  /// Adds a frame that observes every active track where it is now. Returns its slot.
  int add_frame(std::int64_t seq, const Se3& T_cam_world);
  /// Adds the newest image as a frame and makes it a keyframe when one is wanted. With `refine` the window is refined
  /// as far as the parallax allows; without, the frame becomes a keyframe at the given pose.
  Insertion insert(std::int64_t seq, const Se3& T_cam_world, bool refine, StageProbe& probe);

  /// Pose of the newest image by the active tracks.
  [[nodiscard]] PoseFit fit(const Se3& start, int max_iterations) const;
  void refine(int max_iterations);
  /// Retires tracks that are pixels away from where the pose of `slot` puts them.
  void drop_gross(int slot);
  /// Frees tracks that the refined window contradicts.
  void drop_outliers();

  TrackTable tracks;
  Window window;
  Tracker tracker;
  Keyframes keyframes;

 private:
  VoConfig config_;
  Eigen::Vector2d focal_px_;
  WindowRefiner refiner_;
  std::array<Pyramid, 2> pyramids_;
  std::size_t newest_ = 0;  // the pyramid that is filled next; the other one holds the last image
  bool has_image_ = false;
  Se3 T_last_image_newest_;  // pose of last_image() relative to the newest frame of the window
};

}  // namespace plumb::vo
