#include "modules/ground/cues/dense_alignment.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/numbers.hpp"

namespace plumb {
namespace {

// Baselines in camera heights. The short one has enough parallax for the height, the long one for
// the normal while the road is still in the image.
constexpr double kShortBaseline = 0.45;
constexpr double kLongBaseline = 1.3;
constexpr double kLongestBaseline = 4.0;
// Beyond this turn the road has moved across the image, and calibration errors no longer cancel.
constexpr double kLargestTurnRad = 8.0 * kDegree;

constexpr int kSweepSteps = 13;
constexpr int kSweepLevel = 1;
constexpr int kSweepPixels = 1024;

constexpr int kMinPixels = 200;
constexpr int kMaxIterations = 8;
constexpr double kConvergedStep = 1e-4;  // |dq| / |q|
constexpr double kLargestStep = 0.2;     // |dq| / |q|
constexpr double kStartSigmaGrey = 12.0;
constexpr double kSmallestSigmaGrey = 1.5;
constexpr double kNormalPriorStd = 1.5 * kDegree;
constexpr double kLargestTilt = 6.0 * kDegree;
// Residuals of neighbouring pixels are correlated: against the prior, this many count as one.
constexpr double kPixelsPerIndependent = 20.0;
constexpr double kGainPriorStd = 0.1;
constexpr double kBiasPriorStd = 10.0;

constexpr int kNumParams = 3 + 2 * static_cast<int>(kMaxImagePairs);
using ParamMatrix = Eigen::Matrix<double, kNumParams, kNumParams>;
using ParamVector = Eigen::Matrix<double, kNumParams, 1>;

ImageView level_of(const Pyramid& pyramid, int level) { return pyramid.level(level); }

}  // namespace

/// The unknowns and sums of Gauss-Newton.
struct DenseAlignment::Solution {
  Eigen::Vector3d q = Eigen::Vector3d::Zero();
  std::array<Photometric, kMaxImagePairs> photometric{};
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  double sigma_grey = kStartSigmaGrey;
  int num_pixels = 0;

  /// Sums the normal equations of all pairs and priors at the current values. False when too few
  /// pixels are visible.
  bool linearise(const std::array<PairSums, kMaxImagePairs>& sums, std::size_t num_pairs,
                 ParamMatrix* H, ParamVector* b);
  void add_normal_prior(const Eigen::Vector3d& normal, ParamMatrix* H, ParamVector* b) const;
};

ImagePairs choose_image_pairs(const VoOutput& vo, const ImageRing& ring, const RowClock& clock,
                              double height) {
  ImagePairs pairs;
  for (const WindowPose& pose : vo.window) {
    const Pyramid* image = ring.find(pose.seq);
    if (image == nullptr || pairs.size() == kMaxImagePairs) continue;
    const double baseline = pose.T_window_cam.t.norm() / height;
    const double wanted = pairs.empty() ? kShortBaseline : kLongBaseline;
    if (baseline < wanted || baseline > kLongestBaseline) continue;
    if (!pairs.empty() && log_so3(pose.T_window_cam.R).norm() > kLargestTurnRad) continue;
    (void)pairs.push_back({image, pose.T_window_cam, clock.lag_per_y(vo.seq - pose.seq)});
  }
  return pairs;
}

DenseAlignment::DenseAlignment(const CameraModel& ring_camera, int num_levels)
    : camera_(ring_camera), num_levels_(num_levels) {}

DenseMeasurement DenseAlignment::measure(const Pyramid& now, const ImagePairs& pairs,
                                         const DenseRequest& request) {
  DenseMeasurement out;
  Solution solution;
  const double height = sweep(now, pairs, request);
  if (!(height > 0.0)) return out;
  solution.q = request.normal_cam / height;
  for (int level = num_levels_ - 1; level >= 0; --level) {
    if (!refine(level, now, pairs, request, &solution)) return out;
  }
  out.q = solution.q;
  out.information = solution.information;
  out.sigma_grey = solution.sigma_grey;
  out.num_pixels = solution.num_pixels;
  rate(pairs, &out);
  const double ratio = 1.0 / (solution.q.norm() * request.height);
  const double cosine = solution.q.normalized().dot(request.normal_cam);
  out.ok = ratio > 0.4 && ratio < 2.5 && cosine > std::cos(kLargestTilt) && out.ncc > out.still_ncc;
  return out;
}

/// Returns the height with the smallest mean difference along the expected normal; 0 when too
/// little road is visible.
double DenseAlignment::sweep(const Pyramid& now, const ImagePairs& pairs,
                             const DenseRequest& request) {
  const int level = std::min(kSweepLevel, num_levels_ - 1);
  const LevelCamera camera = camera_of_level(camera_, level);
  const Eigen::Vector3d q = request.normal_cam / request.height;
  select_road_pixels(level_of(now, level), camera, request.road, q, kSweepPixels, &pixels_);
  double best_height = 0.0;
  double best_sad = 0.0;
  for (int i = 0; i < kSweepSteps; ++i) {
    const double ln_ratio = request.sweep_ln_range * (2.0 * i / (kSweepSteps - 1) - 1.0);
    double sad = 0.0;
    int num_pixels = 0;
    for (const ImagePair& pair : pairs) {
      const PlaneWarp warp(level_of(*pair.old_image, level), camera, pair.T_old_cam,
                           pair.lag_per_y);
      const Likeness likeness = warp.compare(pixels_, q * std::exp(-ln_ratio));
      sad += likeness.sad * likeness.num_pixels;
      num_pixels += likeness.num_pixels;
    }
    if (num_pixels < kMinPixels) continue;
    sad /= num_pixels;
    if (best_height > 0.0 && sad >= best_sad) continue;
    best_sad = sad;
    best_height = request.height * std::exp(ln_ratio);
  }
  return best_height;
}

bool DenseAlignment::Solution::linearise(const std::array<PairSums, kMaxImagePairs>& sums,
                                         std::size_t num_pairs, ParamMatrix* H, ParamVector* b) {
  H->setIdentity();
  b->setZero();
  H->topLeftCorner<3, 3>().setZero();
  information.setZero();
  const double variance = sigma_grey * sigma_grey;
  num_pixels = 0;
  double weighted_square = 0.0;
  for (std::size_t k = 0; k < num_pairs; ++k) {
    const PairSums& sum = sums[k];
    num_pixels += sum.num_pixels;
    weighted_square += sum.weighted_square;
    const int o = 3 + 2 * static_cast<int>(k);
    Eigen::Matrix2d photo = sum.H.bottomRightCorner<2, 2>();
    photo(0, 0) += variance / (kGainPriorStd * kGainPriorStd);
    photo(1, 1) += variance / (kBiasPriorStd * kBiasPriorStd);
    H->topLeftCorner<3, 3>() += sum.H.topLeftCorner<3, 3>();
    H->block<3, 2>(0, o) = sum.H.topRightCorner<3, 2>();
    H->block<2, 3>(o, 0) = sum.H.bottomLeftCorner<2, 3>();
    H->block<2, 2>(o, o) = photo;
    b->head<3>() += sum.b.head<3>();
    (*b)(o) = sum.b(3) - variance / (kGainPriorStd * kGainPriorStd) * photometric[k].gain;
    (*b)(o + 1) = sum.b(4) - variance / (kBiasPriorStd * kBiasPriorStd) * photometric[k].bias;
    // Schur complement: the information about q when gain and bias are unknown.
    information += (sum.H.topLeftCorner<3, 3>() - sum.H.topRightCorner<3, 2>() * photo.inverse() *
                                                      sum.H.bottomLeftCorner<2, 3>()) /
                   variance;
  }
  if (num_pixels < kMinPixels) return false;
  sigma_grey = std::max(kSmallestSigmaGrey, std::sqrt(weighted_square / num_pixels));
  return true;
}

void DenseAlignment::Solution::add_normal_prior(const Eigen::Vector3d& normal, ParamMatrix* H,
                                                ParamVector* b) const {
  const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - normal * normal.transpose();
  const double weight = sigma_grey * sigma_grey * kPixelsPerIndependent /
                        (kNormalPriorStd * kNormalPriorStd * q.squaredNorm());
  H->topLeftCorner<3, 3>() += weight * across;
  b->head<3>() -= weight * across * q;
}

bool DenseAlignment::refine(int level, const Pyramid& now, const ImagePairs& pairs,
                            const DenseRequest& request, Solution* solution) {
  const LevelCamera camera = camera_of_level(camera_, level);
  select_road_pixels(level_of(now, level), camera, request.road, solution->q, kMaxRoadPixels,
                     &pixels_);
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    std::array<PairSums, kMaxImagePairs> sums;
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const PlaneWarp warp(level_of(*pairs[k].old_image, level), camera, pairs[k].T_old_cam,
                           pairs[k].lag_per_y);
      warp.accumulate(pixels_, solution->q, solution->photometric[k], solution->sigma_grey,
                      &sums[k]);
    }
    ParamMatrix H;
    ParamVector b;
    if (!solution->linearise(sums, pairs.size(), &H, &b)) return false;
    solution->add_normal_prior(request.normal_cam, &H, &b);
    const ParamVector step = H.ldlt().solve(b);
    if (!step.allFinite()) return false;
    Eigen::Vector3d dq = step.head<3>();
    const double length = dq.norm() / solution->q.norm();
    if (length > kLargestStep) dq *= kLargestStep / length;
    solution->q += dq;
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      solution->photometric[k].gain += step(3 + 2 * static_cast<int>(k));
      solution->photometric[k].bias += step(4 + 2 * static_cast<int>(k));
    }
    if (length < kConvergedStep && iteration > 0) break;
  }
  return true;
}

/// Compares the images at the solution, with the pixels of the finest level.
void DenseAlignment::rate(const ImagePairs& pairs, DenseMeasurement* out) {
  const LevelCamera camera = camera_of_level(camera_, 0);
  double weight = 0.0;
  for (const ImagePair& pair : pairs) {
    const PlaneWarp warp(level_of(*pair.old_image, 0), camera, pair.T_old_cam, pair.lag_per_y);
    const Likeness likeness = warp.compare(pixels_, out->q);
    out->sad += likeness.sad * likeness.num_pixels;
    out->ncc += likeness.ncc * likeness.num_pixels;
    weight += likeness.num_pixels;
  }
  if (weight > 0.0) {
    out->sad /= weight;
    out->ncc /= weight;
  }
  const PlaneWarp still(level_of(*pairs[pairs.size() - 1].old_image, 0), camera, Se3{}, 0.0);
  out->still_ncc = still.compare(pixels_, out->q).ncc;
}

}  // namespace plumb
