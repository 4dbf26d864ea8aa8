#include "modules/ground_paper/sift_matcher_source.hpp"

#include <algorithm>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>
#include <vector>

#include "core/simd.hpp"

namespace plumb {
namespace {

// Roads have low contrast: a quarter of Lowe's threshold.
constexpr double kContrast = 0.01;
constexpr int kLayersPerOctave = 3;
constexpr double kEdge = 10.0;
constexpr double kSigma = 1.6;
// Lowe's ratio of the nearest to the second nearest descriptor.
constexpr float kRatio = 0.8F;
// Descriptors extend this far beyond a feature; without the margin the region would lose its
// border.
constexpr int kMarginPx = 16;
constexpr int kDescriptorSize = 128;
static_assert(kDescriptorSize % kNumLanes == 0);

struct Features {
  std::vector<cv::KeyPoint> points;
  cv::Mat descriptors;
};

constexpr std::size_t kNoMatch = static_cast<std::size_t>(-1);

struct Nearest {
  std::size_t index = kNoMatch;
  float distance = std::numeric_limits<float>::infinity();
  float second = std::numeric_limits<float>::infinity();

  void offer(std::size_t i, float d) {
    if (d < distance) {
      second = distance;
      distance = d;
      index = i;
    } else if (d < second) {
      second = d;
    }
  }
};

// Elements are integers below 256, so that the sum is exact in any order.
float squared_distance(const cv::Mat& a, std::size_t i, const cv::Mat& b, std::size_t j) {
  const float* p = a.ptr<float>(static_cast<int>(i));
  const float* q = b.ptr<float>(static_cast<int>(j));
  Float8 sum{};
  for (int k = 0; k < kDescriptorSize; k += kNumLanes) {
    Float8 x, y;
    x = load_floats(p + k);
    y = load_floats(q + k);
    sum += (x - y) * (x - y);
  }
  return static_cast<float>(sum_double(sum));
}

}  // namespace

struct SiftMatcher::Impl {
  Impl(const PixelBox& box_in, std::size_t num_places)
      : box(box_in),
        sift(cv::SIFT::create(0, kLayersPerOctave, kContrast, kEdge, kSigma)),
        places(num_places) {
    cv::setNumThreads(1);
  }

  PixelBox box;
  cv::Ptr<cv::SIFT> sift;
  std::vector<Features> places;
  std::vector<Nearest> forward, backward;
  std::vector<PixelMatch> matches;
};

SiftMatcher::SiftMatcher(const PixelBox& box, std::size_t num_places)
    : impl_(std::make_unique<Impl>(box, num_places)) {}

SiftMatcher::~SiftMatcher() = default;

void SiftMatcher::detect(std::size_t place, const ImageView& image) {
  const PixelBox& box = impl_->box;
  Features* out = &impl_->places[place];
  const int u0 = std::max(0, box.u0 - kMarginPx), v0 = std::max(0, box.v0 - kMarginPx);
  const int u1 = std::min(image.width_px, box.u1 + kMarginPx);
  const int v1 = std::min(image.height_px, box.v1 + kMarginPx);
  // OpenCV has no read-only matrix header; detection only reads.
  auto* data = const_cast<std::uint8_t*>(image.row(v0) + u0);
  const cv::Mat view(v1 - v0, u1 - u0, CV_8UC1, data, static_cast<std::size_t>(image.stride_bytes));
  out->points.clear();
  impl_->sift->detect(view, out->points);
  const auto outside = [&](const cv::KeyPoint& p) {
    return !box.contains(static_cast<double>(p.pt.x) + u0, static_cast<double>(p.pt.y) + v0);
  };
  out->points.erase(std::remove_if(out->points.begin(), out->points.end(), outside),
                    out->points.end());
  impl_->sift->compute(view, out->points, out->descriptors);
  for (cv::KeyPoint& p : out->points) {
    p.pt.x += static_cast<float>(u0);
    p.pt.y += static_cast<float>(v0);
  }
}

std::span<const PixelMatch> SiftMatcher::match(std::size_t now, std::size_t old) {
  Impl& m = *impl_;
  const Features& a = m.places[now];
  const Features& b = m.places[old];
  m.matches.clear();
  m.forward.assign(a.points.size(), Nearest{});
  m.backward.assign(b.points.size(), Nearest{});
  for (std::size_t i = 0; i < a.points.size(); ++i) {
    for (std::size_t j = 0; j < b.points.size(); ++j) {
      const float d = squared_distance(a.descriptors, i, b.descriptors, j);
      m.forward[i].offer(j, d);
      m.backward[j].offer(i, d);
    }
  }
  for (std::size_t i = 0; i < a.points.size(); ++i) {
    const Nearest& best = m.forward[i];
    if (best.index == kNoMatch || !(best.distance < kRatio * kRatio * best.second)) continue;
    if (m.backward[best.index].index != i) continue;
    const cv::Point2f p = a.points[i].pt;
    const cv::Point2f q = b.points[best.index].pt;
    m.matches.push_back({Eigen::Vector2d(p.x, p.y), Eigen::Vector2d(q.x, q.y)});
  }
  return m.matches;
}

}  // namespace plumb
