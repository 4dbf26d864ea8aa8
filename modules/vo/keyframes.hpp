/// When a frame becomes a keyframe, and what enters and leaves the window with it.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/camera_model.hpp"
#include "core/pyramid.hpp"
#include "modules/vo/corners.hpp"
#include "modules/vo/track.hpp"
#include "modules/vo/vo_config.hpp"
#include "modules/vo/window.hpp"

namespace plumb::vo {

/// Inverse depth of a point of which nothing is known, 1/[vo]; the first two views are scaled to have this median.
inline constexpr double kTypicalRho = 1.0 / 15.0;

class Keyframes {
 public:
  Keyframes(const VoConfig& config, const CameraModel& camera, int track_capacity);

  /// Looks at the active tracks in the newest frame of the window.
  struct View {
    double median_parallax_px = 0.0;  ///< rotation-compensated, from the newest keyframe
    int num_shared = 0;               ///< tracks seen in that keyframe
    int num_tracks = 0;
  };
  [[nodiscard]] View look(const TrackTable& tracks, const Window& window, const Se3& T_cam_world);
  [[nodiscard]] bool wanted(const View& view) const;

  /// Drops frames that are neither keyframes nor recent.
  void trim_recent(TrackTable& tracks, Window& window);
  /// Makes `slot` a keyframe; the oldest one leaves when there are too many, and its tracks change host.
  void promote(int slot, const ImageView& image, TrackTable& tracks, Window& window);
  /// Starts tracks at new corners of keyframe `slot`. Returns how many.
  int spawn(int slot, const Pyramid& image, TrackTable& tracks, const Window& window);
  /// Active tracks when the newest keyframe was made.
  [[nodiscard]] int num_at_keyframe() const { return num_at_keyframe_; }

  /// Takes `slot` out of the window and of every track.
  void remove_frame(int slot, TrackTable& tracks, Window& window);

 private:
  struct Neighbour {
    Eigen::Vector2d px;
    double rho;
  };
  void collect_neighbours(int slot, const TrackTable& tracks, const Window& window);
  void guess_depth(Track& track) const;

  VoConfig config_;
  CameraModel camera_;
  CornerDetector detector_;
  std::vector<Neighbour> neighbours_;
  std::vector<double> scratch_;
  int num_at_keyframe_ = 0;
};

}  // namespace plumb::vo
