/// SIFT features of the road region, matched to those of the previous image.
///
/// The only OpenCV of the ground module, and the only part of it that uses the heap after
/// construction: OpenCV's detector sizes its scale space and its lists by itself, for every image.
/// Sets OpenCV to one thread, so that results repeat.
///
/// Frames  img: full image, (0,0) is the centre of the upper left pixel.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>

#include "modules/ground/paper/road_region.hpp"
#include "modules/imaging/image_view.hpp"

namespace plumb {

struct PixelMatch {
  Eigen::Vector2d now;
  Eigen::Vector2d previous;
};

class SiftMatcher {
 public:
  explicit SiftMatcher(const PixelBox& box);
  ~SiftMatcher();
  SiftMatcher(const SiftMatcher&) = delete;
  SiftMatcher& operator=(const SiftMatcher&) = delete;

  /// Finds the features of `image` and keeps them for the next call; their matches to the image
  /// before it are valid until then. @pre the box lies in the image
  std::span<const PixelMatch> match(const ImageView& image);

  /// What comes next has no previous image.
  void forget();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace plumb
