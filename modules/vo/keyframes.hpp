/// Decides when a frame becomes a keyframe, and moves frames and tracks into and out of the window.
///
/// Frames:
///   img for px; world: cam of the first image.
/// Units:
///   [vo] and 1/[vo], pixels.
/// Memory:
///   Sized by the image and the number of tracks, and allocated by the constructor.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/camera_model.hpp"
#include "core/pyramid.hpp"
#include "modules/vo/attached_regions.hpp"
#include "modules/vo/corners.hpp"
#include "modules/vo/track.hpp"
#include "modules/vo/vo_config.hpp"
#include "modules/vo/window.hpp"

namespace plumb::vo {

/// Inverse depth of a point whose depth is unknown [1/vo]. It is also the median inverse depth to
/// which the first two views are scaled.
inline constexpr double kTypicalRho = 1.0 / 15.0;

class Keyframes {
 public:
  Keyframes(const VoConfig& config, const CameraModel& camera, int track_capacity);

  /// The newest image compared with the newest keyframe.
  struct Overlap {
    double median_parallax_px = 0.0;  ///< rotation-compensated
    int num_shared = 0;               ///< number of active tracks that the keyframe saw, too
    int num_tracks = 0;               ///< number of active tracks
  };
  [[nodiscard]] Overlap compare(const TrackTable& tracks, const Window& window,
                                const Se3& T_cam_world);
  /// Returns whether a frame with this overlap is to become a keyframe.
  [[nodiscard]] bool is_needed(const Overlap& overlap) const;

  /// Removes the frames that are neither keyframes nor recent.
  void trim_recent(TrackTable& tracks, Window& window);
  /// Makes the frame in `slot` a keyframe. When there are too many, the oldest one is removed.
  void promote(int slot, const ImageView& image, TrackTable& tracks, Window& window);
  /// Starts tracks at corners of the keyframe in `slot` where there are none yet and nothing is
  /// attached to the camera. Returns their number.
  int start_tracks(int slot, const Pyramid& image, const AttachedRegions& attached,
                   TrackTable& tracks, const Window& window);
  /// Returns the number of active tracks when the newest keyframe was made.
  [[nodiscard]] int num_at_keyframe() const { return num_at_keyframe_; }

  /// Removes the frame in `slot` from the window and from every track. Tracks that it hosts move to
  /// the next keyframe that saw them; they are freed if there is none.
  void remove_frame(int slot, TrackTable& tracks, Window& window);

 private:
  struct Neighbour {
    Eigen::Vector2d px;
    double rho;
  };
  void collect_neighbours(int slot, const TrackTable& tracks, const Window& window);
  void predict_depth(Track& track) const;

  VoConfig config_;
  CameraModel camera_;
  CornerDetector detector_;
  std::vector<Neighbour> neighbours_;
  std::vector<double> scratch_;
  int num_at_keyframe_ = 0;
};

}  // namespace plumb::vo
