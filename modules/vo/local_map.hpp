/// The state that tracking, initialisation and zero-motion detection share: the last two images,
/// the tracks, and the window of frames that refinement may move.
///
/// Frames:
///   world: cam of the first image.  T_a_b maps coordinates in b to coordinates in a.
/// Units:
///   Lengths in [vo], image positions in pixels.
/// Memory:
///   Sized by the configuration and the camera, and allocated by the constructor.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "core/camera_model.hpp"
#include "core/pyramid.hpp"
#include "core/stage_probe.hpp"
#include "modules/vo/attached_regions.hpp"
#include "modules/vo/frame_time.hpp"
#include "modules/vo/keyframes.hpp"
#include "modules/vo/pose.hpp"
#include "modules/vo/refine.hpp"
#include "modules/vo/track.hpp"
#include "modules/vo/tracker.hpp"
#include "modules/vo/vo_config.hpp"
#include "modules/vo/window.hpp"

namespace plumb::vo {

/// Size of the pool of tracks: the active ones, and passive ones that still connect frames.
[[nodiscard]] constexpr int track_capacity(const VoConfig& config) { return 3 * config.max_tracks; }

/// What insert() did.
struct Insertion {
  bool is_keyframe = false;         ///< the frame became a keyframe
  int num_new = 0;                  ///< number of tracks started in the frame
  double median_parallax_px = 0.0;  ///< rotation-compensated, from the previous keyframe
};

class LocalMap {
 public:
  LocalMap(const VoConfig& config, const CameraModel& camera);

  /// The image being processed.
  [[nodiscard]] Pyramid& newest_image() { return pyramids_[newest_]; }
  [[nodiscard]] const Pyramid& newest_image() const { return pyramids_[newest_]; }
  /// The last image before it that was used. @pre has_image()
  [[nodiscard]] const Pyramid& last_image() const { return pyramids_[1 - newest_]; }
  [[nodiscard]] bool has_image() const { return has_image_; }
  /// Makes the newest image, taken at T_cam_world, the last one.
  void keep_image(const Se3& T_cam_world);

  /// Returns the pose of the newest frame of the history, as it is refined now.
  /// @pre the window is not empty
  [[nodiscard]] Se3 last_pose() const { return window.past_pose(window.history()[0]); }
  /// Returns the pose of last_image(), as it is refined now. @pre has_image()
  [[nodiscard]] Se3 last_image_pose() const;

  /// Clears tracks and window, and starts tracks in `image`, which was taken at T_cam_world.
  /// Returns their number.
  int start_reference(std::int64_t seq, const Se3& T_cam_world, const Pyramid& image);
  /// Adds a frame that observes every active track at its newest position. Returns the slot.
  int add_frame(std::int64_t seq, const Se3& T_cam_world);
  /// Adds the newest image as a frame. With `refine`, the frame becomes a keyframe if one is
  /// needed, and the window is refined if there is enough parallax. Without it, the frame becomes a
  /// keyframe with the given pose.
  Insertion insert(std::int64_t seq, const Se3& T_cam_world, bool refine, StageProbe& probe);

  /// Puts the previous image, whose pose nothing predicted, on the way from T_cam_world of the last
  /// image with a pose to the newest frame, in proportion to the times. Returns the covariance of
  /// its place.
  /// @pre the window is not empty, time.unplaced_s > 0
  Matrix6d place_previous(const Se3& T_placed_world, const FrameTime& time);

  /// Fits the pose of the newest image to the active tracks.
  [[nodiscard]] PoseFit fit(const Se3& start, int max_iterations) const;
  /// Refines the poses and inverse depths of the window.
  void refine(int max_iterations);
  /// Retires tracks whose observation in `slot` disagrees grossly with the poses. The observation
  /// is removed.
  void retire_gross_outliers(int slot);
  /// Frees tracks that disagree with the refined window.
  void free_outliers();

  TrackTable tracks;
  Window window;
  Tracker tracker;
  Keyframes keyframes;
  AttachedRegions attached;

 private:
  VoConfig config_;
  Eigen::Vector2d focal_px_;
  WindowRefiner refiner_;
  std::array<Pyramid, 2> pyramids_;
  std::size_t newest_ = 0;  // pyramid of the newest image; the other one holds the last image
  bool has_image_ = false;
  Se3 T_last_image_newest_;  // pose of last_image() relative to the newest frame of the window
};

}  // namespace plumb::vo
