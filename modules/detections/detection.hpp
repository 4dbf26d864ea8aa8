/// The detections of one image: boxes, classes, scores and the raw boxes behind them.
///
/// Frames:
///   img: u right, v down; (0,0) is the centre of the upper left pixel.
/// Memory:
///   kMaxDetections detections in place.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "core/fixed_vector.hpp"

namespace plumb {

inline constexpr std::size_t kMaxDetections = 64;
inline constexpr std::size_t kMaxCandidates = 16;

/// The numbers are those of detection_t.CLASS_*.
enum class ObjectClass : std::int8_t {
  kUnknown = 0,
  kCar = 1,
  kVan = 2,
  kTruck = 3,
  kBus = 4,
  kPedestrian = 5,
  kCyclist = 6,
};
inline constexpr std::size_t kNumObjectClasses = 7;

/// The numbers are those of detection_t.occluded.
enum class Occlusion : std::int8_t { kVisible = 0, kPartly = 1, kLargely = 2, kUnknown = 3 };

struct Box {
  double left_px = 0.0;
  double top_px = 0.0;
  double right_px = 0.0;
  double bottom_px = 0.0;

  [[nodiscard]] double width_px() const { return right_px - left_px; }
  [[nodiscard]] double height_px() const { return bottom_px - top_px; }
  [[nodiscard]] double centre_u_px() const { return 0.5 * (left_px + right_px); }
};

/// Area of the intersection over area of the union, in [0, 1].
[[nodiscard]] inline double intersection_over_union(const Box& a, const Box& b) {
  const double width = std::min(a.right_px, b.right_px) - std::max(a.left_px, b.left_px);
  const double height = std::min(a.bottom_px, b.bottom_px) - std::max(a.top_px, b.top_px);
  if (width <= 0.0 || height <= 0.0) return 0.0;
  const double both = width * height;
  return both / (a.width_px() * a.height_px() + b.width_px() * b.height_px() - both);
}

/// One raw box of the detector, before non-maximum suppression.
struct Candidate {
  Box box;
  double score = 0.0;
};

struct Detection {
  std::int32_t track_id = -1;  ///< -1 when the detector does not track
  ObjectClass object_class = ObjectClass::kUnknown;
  double score = 0.0;            ///< [0, 1]
  Box box;                       ///< not empty
  double truncated_ratio = 0.0;  ///< share outside the image, 0 to 1; NaN when not known
  Occlusion occluded = Occlusion::kUnknown;
  FixedVector<Candidate, kMaxCandidates> candidates;
};

struct DetectionFrame {
  std::int64_t capture_us = 0;
  std::int64_t seq = 0;
  FixedVector<Detection, kMaxDetections> detections;
};

}  // namespace plumb
