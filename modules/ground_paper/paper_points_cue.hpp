/// Triangulated-points cue of the paper: features of the road region are triangulated between this
/// image and an older one, and vote for the height over a road of the calibrated normal.
///
/// Frames:
///   cam of the newest image.
/// Units:
///   The unit of length is that of t.
/// Memory:
///   kMaxVoters heights in place.
#pragma once

#include <Eigen/Core>
#include <span>

#include "core/camera_model.hpp"
#include "core/fixed_vector.hpp"
#include "core/se3.hpp"
#include "modules/ground_paper/height_vote.hpp"
#include "modules/ground_paper/sift_matcher_source.hpp"

namespace plumb {

inline constexpr std::size_t kMaxVoters = 1024;

struct Triangulated {
  bool ok = false;  ///< in front of both cameras
  Eigen::Vector3d p_cam = Eigen::Vector3d::Zero();
  double miss_px = 0.0;  ///< distance to the match in the older image
};

/// Finds the depth along the newest image's ray by least squares in the older image.
[[nodiscard]] Triangulated triangulate(const CameraModel& camera, const Se3& T_old_cam,
                                       const PixelMatch& match);

struct PaperPointsMeasurement {
  bool ok = false;
  double height = 0.0;
  double score = 0.0;  ///< q of equation (8): the confidence
  int num_matches = 0;
  int num_voters = 0;
};

class PaperPointsCue {
 public:
  /// `normal_cam` is the calibrated one: the paper fixes the pitch.
  PaperPointsCue(const CameraModel& camera, const Eigen::Vector3d& normal_cam, double mu);

  [[nodiscard]] PaperPointsMeasurement measure(std::span<const PixelMatch> matches,
                                               const Se3& T_old_cam);
  /// HeightVote when the unit of t says nothing yet, for a camera at `height_m`. 0 with too few
  /// points.
  [[nodiscard]] double search_height(std::span<const PixelMatch> matches, const Se3& T_old_cam,
                                     double height_m);

 private:
  void collect(std::span<const PixelMatch> matches, const Se3& T_old_cam);

  CameraModel camera_;
  Eigen::Vector3d normal_cam_;
  double mu_;
  FixedVector<double, kMaxVoters> heights_;
};

}  // namespace plumb
