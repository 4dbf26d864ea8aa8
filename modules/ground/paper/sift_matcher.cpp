#include "modules/ground/paper/sift_matcher.hpp"

#include <algorithm>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>
#include <vector>

namespace plumb {
namespace {

// Road is low in contrast: a quarter of Lowe's threshold.
constexpr double kContrast = 0.01;
constexpr int kLayersPerOctave = 3;
constexpr double kEdge = 10.0;
constexpr double kSigma = 1.6;
// Lowe's ratio of the nearest to the second nearest descriptor.
constexpr float kRatio = 0.8F;
// Descriptors reach this far beyond a feature; without it the region would lose its border.
constexpr int kMarginPx = 16;

struct Features {
  std::vector<cv::KeyPoint> points;
  cv::Mat descriptors;
};

struct Nearest {
  int index = -1;
  float distance = std::numeric_limits<float>::infinity();
  float second = std::numeric_limits<float>::infinity();

  void offer(int i, float d) {
    if (d < distance) {
      second = distance;
      distance = d;
      index = i;
    } else if (d < second) {
      second = d;
    }
  }
};

float squared_distance(const cv::Mat& a, int i, const cv::Mat& b, int j) {
  const float* p = a.ptr<float>(i);
  const float* q = b.ptr<float>(j);
  float sum = 0.0F;
  for (int k = 0; k < a.cols; ++k) sum += (p[k] - q[k]) * (p[k] - q[k]);
  return sum;
}

}  // namespace

struct SiftMatcher::Impl {
  explicit Impl(const PixelBox& box_in)
      : box(box_in), sift(cv::SIFT::create(0, kLayersPerOctave, kContrast, kEdge, kSigma)) {
    cv::setNumThreads(1);
  }

  void detect(const ImageView& image, Features* out) const;
  void match();

  PixelBox box;
  cv::Ptr<cv::SIFT> sift;
  Features now, previous;
  bool has_previous = false;
  std::vector<Nearest> forward, backward;
  std::vector<PixelMatch> matches;
};

SiftMatcher::SiftMatcher(const PixelBox& box) : impl_(std::make_unique<Impl>(box)) {}

SiftMatcher::~SiftMatcher() = default;

void SiftMatcher::forget() { impl_->has_previous = false; }

std::span<const PixelMatch> SiftMatcher::match(const ImageView& image) {
  Impl& m = *impl_;
  m.matches.clear();
  std::swap(m.now, m.previous);
  m.detect(image, &m.now);
  if (m.has_previous) m.match();
  m.has_previous = true;
  return m.matches;
}

void SiftMatcher::Impl::detect(const ImageView& image, Features* out) const {
  const int u0 = std::max(0, box.u0 - kMarginPx), v0 = std::max(0, box.v0 - kMarginPx);
  const int u1 = std::min(image.width_px, box.u1 + kMarginPx);
  const int v1 = std::min(image.height_px, box.v1 + kMarginPx);
  // OpenCV has no read-only matrix header; detection only reads.
  auto* data = const_cast<std::uint8_t*>(image.row(v0) + u0);
  const cv::Mat view(v1 - v0, u1 - u0, CV_8UC1, data, static_cast<std::size_t>(image.stride_bytes));
  out->points.clear();
  sift->detect(view, out->points);
  const auto outside = [&](const cv::KeyPoint& p) {
    return !box.contains(static_cast<double>(p.pt.x) + u0, static_cast<double>(p.pt.y) + v0);
  };
  out->points.erase(std::remove_if(out->points.begin(), out->points.end(), outside),
                    out->points.end());
  sift->compute(view, out->points, out->descriptors);
  for (cv::KeyPoint& p : out->points) {
    p.pt.x += static_cast<float>(u0);
    p.pt.y += static_cast<float>(v0);
  }
}

/// Mutual nearest neighbours that pass the ratio test.
void SiftMatcher::Impl::match() {
  const int num_now = now.descriptors.rows, num_previous = previous.descriptors.rows;
  forward.assign(static_cast<std::size_t>(num_now), Nearest{});
  backward.assign(static_cast<std::size_t>(num_previous), Nearest{});
  for (int i = 0; i < num_now; ++i) {
    for (int j = 0; j < num_previous; ++j) {
      const float d = squared_distance(now.descriptors, i, previous.descriptors, j);
      forward[static_cast<std::size_t>(i)].offer(j, d);
      backward[static_cast<std::size_t>(j)].offer(i, d);
    }
  }
  for (int i = 0; i < num_now; ++i) {
    const Nearest& best = forward[static_cast<std::size_t>(i)];
    if (best.index < 0 || !(best.distance < kRatio * kRatio * best.second)) continue;
    if (backward[static_cast<std::size_t>(best.index)].index != i) continue;
    const cv::Point2f a = now.points[static_cast<std::size_t>(i)].pt;
    const cv::Point2f b = previous.points[static_cast<std::size_t>(best.index)].pt;
    matches.push_back({Eigen::Vector2d(a.x, a.y), Eigen::Vector2d(b.x, b.y)});
  }
}

}  // namespace plumb
