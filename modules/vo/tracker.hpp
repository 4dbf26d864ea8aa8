/// Positions of the tracks in the newest image: a search from image to image, then an alignment
/// with the host keyframe.
///
/// The search (klt.hpp) starts at a predicted position. It compares with the previous image, so
/// that its errors accumulate. The alignment compares with the patch in the host keyframe, warped
/// by the motion in between, and removes this drift.
///
/// Frames:
///   img: level 0 of the pyramids.
/// Units:
///   Pixels, seconds; lengths in [vo].
/// Memory:
///   One entry per track of the pool, allocated by the constructor.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/camera_model.hpp"
#include "core/pyramid.hpp"
#include "modules/vo/klt.hpp"
#include "modules/vo/track.hpp"
#include "modules/vo/window.hpp"

namespace plumb::vo {

class Tracker {
 public:
  Tracker(const CameraModel& camera, int track_capacity);

  /// Begins an image, `dt_s` after the previous one. The newest positions become the previous ones.
  void begin(TrackTable& tracks, double dt_s);

  /// Predicts positions from the poses of both images and the inverse depths.
  void predict_by_pose(const TrackTable& tracks, const Window& window, const Se3& T_prev_world,
                       const Se3& T_cam_world);
  /// Predicts positions by repeating the last image motion of each track.
  void predict_by_flow(const TrackTable& tracks);

  /// Searches the tracks that were not found yet. Tracks with uncertain depth must also be found on
  /// the way back. With `wide`, the search starts on the coarsest level, otherwise on the level
  /// that the standard deviation of the prediction asks for. Returns how many are found in total.
  int search(const Pyramid& from, const Pyramid& to, TrackTable& tracks, bool wide);
  /// Retires the tracks that the search did not find.
  void drop_missing(TrackTable& tracks);

  /// Aligns every active track with its patch in the host keyframe. Tracks that do not match are
  /// retired.
  /// @param T_cam_world  pose of `image`
  void align_to_hosts(const ImageView& image, TrackTable& tracks, const Window& window,
                      const Se3& T_cam_world);

 private:
  struct Prediction {
    Eigen::Vector2f px;
    float scale = 1.0F;   // apparent size in the newest image / in the previous one
    float std_px = 0.0F;  // standard deviation of px
  };
  [[nodiscard]] KltMatch find(const Pyramid& from, const Pyramid& to, const Track& track,
                              const Prediction& prediction, bool wide) const;
  [[nodiscard]] bool align(const ImageView& image, Track& track, const ImageView& host_image,
                           const Se3& T_cam_host) const;
  [[nodiscard]] bool inside(const Eigen::Vector2d& px) const;
  void set_position(const Eigen::Vector2d& px, Track& track) const;

  CameraModel camera_;
  std::vector<Prediction> predictions_;  // by index of the track
  std::vector<unsigned char> found_;     // by index of the track
  std::vector<Eigen::Vector2d> flow_;    // by index of the track, up to the previous image
  std::vector<double> scratch_;
  double dt_s_ = 0.0;
  // Median error of the last predictions of tracks with known depth.
  double prediction_error_px_ = 0.0;
};

}  // namespace plumb::vo
