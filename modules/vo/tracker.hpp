/// Where the tracks are in the newest image: search from the previous image, then re-anchoring to the host.
///
/// The search chains positions from frame to frame, which drifts; the anchor compares with the patch in the host
/// keyframe, warped by the predicted motion, which does not.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/camera_model.hpp"
#include "core/pyramid.hpp"
#include "modules/vo/track.hpp"
#include "modules/vo/window.hpp"

namespace plumb::vo {

class Tracker {
 public:
  Tracker(const CameraModel& camera, int track_capacity);

  /// Starts a frame, `dt_s` after the image before: the newest positions become the previous ones.
  void begin(TrackTable& tracks, double dt_s);

  /// Where to search: by pose and inverse depth, or by repeating the last image motion.
  void predict_by_pose(const TrackTable& tracks, const Window& window, const Se3& T_prev_world,
                       const Se3& T_cam_world);
  void predict_by_flow(const TrackTable& tracks);

  /// Searches the tracks not found yet, with a backward check. `wide` starts on the coarsest level, otherwise the
  /// level follows from how good the guess is. Returns how many are found in all.
  int search(const Pyramid& from, const Pyramid& to, TrackTable& tracks, bool wide);
  /// Retires the tracks that the search did not find.
  void drop_missing(TrackTable& tracks);

  /// Aligns every track with its host patch; those that do not match are retired. Returns how many are left.
  int anchor(const ImageView& image, TrackTable& tracks, const Window& window,
             const Se3& T_cam_world);

 private:
  struct Guess {
    Eigen::Vector2f px;
    float scale = 1.0F;   // apparent size now / before
    float std_px = 0.0F;  // how far off the guess may be
  };
  [[nodiscard]] bool anchor_one(const ImageView& image, Track& track, const ImageView& host_image,
                                const Se3& T_cam_host) const;
  [[nodiscard]] bool inside(const Eigen::Vector2d& px) const;
  void place(const Eigen::Vector2d& px, Track& track) const;

  CameraModel camera_;
  std::vector<Guess> guesses_;         // by track index
  std::vector<unsigned char> found_;   // by track index
  std::vector<Eigen::Vector2d> flow_;  // by track index, of the frame before
  std::vector<double> scratch_;
  double dt_s_ = 0.0;
  double surprise_px_ =
      0.0;  // median distance between guess and result where depth was known, last search
};

}  // namespace plumb::vo
