/// SIFT features of the road region in the last images, and matches between two of them.
///
/// This is the only file of the ground algorithms that uses OpenCV, and the only one that uses the
/// heap after construction: OpenCV's detector sizes its scale space and its lists for every image.
/// It sets OpenCV to one thread, so that results repeat.
///
/// Frames:
///   img: full image, (0,0) is the centre of the upper left pixel.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>

#include "core/image_view.hpp"
#include "modules/ground_paper/road_region.hpp"

namespace plumb {

struct PixelMatch {
  Eigen::Vector2d now;
  Eigen::Vector2d old;
};

class SiftMatcher {
 public:
  /// Stores the features of up to `num_places` images.
  SiftMatcher(const PixelBox& box, std::size_t num_places);
  ~SiftMatcher();
  SiftMatcher(const SiftMatcher&) = delete;
  SiftMatcher& operator=(const SiftMatcher&) = delete;

  /// Finds the features of `image` and stores them at `place`. @pre the box lies in the image
  void detect(std::size_t place, const ImageView& image);

  /// Mutual nearest neighbours that pass Lowe's ratio test; valid until the next call.
  std::span<const PixelMatch> match(std::size_t now, std::size_t old);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace plumb
