#include "modules/ground_paper/paper_dense_cue.hpp"

#include <cmath>
#include <limits>

#include "modules/ground_paper/nelder_mead.hpp"

namespace plumb {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// First simplex: a tenth of the height, and about a degree.
constexpr double kFirstHeightRatio = 0.1;
constexpr double kFirstTilt = 0.02;
// A search that ends further from the expected plane found something else than the road. The paper
// looks at tilts of +-0.1.
constexpr double kHeightRange = 2.0;  // factor, either way
constexpr double kTiltRange = 0.1;
// Slices: h over [0.5, 1.5] of the minimum (paper, section 5.1.1), tilts over +-0.1.
constexpr double kSliceHeightRatio = 0.5;
constexpr double kSliceTilt = 0.1;
// Costs lie in [0, 1]; a search whose corners differ by less than this has converged.
constexpr NelderMeadLimits kLimits{200, 1e-5, 0.02};

// Heights that the start tries, as steps per height: 1.65 m at 10 images/s are 1 to 65 m/s.
constexpr double kSlowestStep = 0.06;
constexpr double kFastestStep = 4.0;
constexpr int kNumSteps = 90;
// If a road is visible, the cost of the best height is less than this share of the mean.
constexpr double kLeastDip = 0.85;

}  // namespace

PaperDenseCue::PaperDenseCue(const CameraModel& camera, const PixelBox& box, double rho)
    : region_(camera, box), ln_rho_(std::log(rho)) {}

double PaperDenseCue::cost(const ImageView& old_image, const Se3& T_old_cam,
                           const Eigen::Vector3d& z) const {
  if (!(z(kH) > 0.0) || z.head<2>().squaredNorm() > 0.5) return kInfinity;
  const double sad = region_.sad(old_image, T_old_cam, q_of(z));
  return std::isnan(sad) ? kInfinity : 1.0 - std::exp(-ln_rho_ * sad);  // (7)
}

PaperDenseMeasurement PaperDenseCue::measure(const ImageView& old_image, const Se3& T_old_cam,
                                             const Eigen::Vector3d& expected) const {
  const auto f = [&](const Eigen::Vector3d& z) { return cost(old_image, T_old_cam, z); };
  const Eigen::Vector3d step(kFirstTilt, kFirstTilt, kFirstHeightRatio * expected(kH));
  NelderMead<3, decltype(f)> search(f, kLimits);
  const NelderMeadResult<3> found = search.run(expected, step);

  PaperDenseMeasurement out;
  out.num_evaluations = found.num_evaluations;
  out.z = found.x;
  const double height_ratio = found.x(kH) / expected(kH);
  const bool near = height_ratio < kHeightRange && height_ratio > 1.0 / kHeightRange &&
                    (found.x - expected).head<2>().cwiseAbs().maxCoeff() < kTiltRange;
  if (!std::isfinite(found.value) || !near) return out;
  out.sad = region_.sad(old_image, T_old_cam, q_of(out.z));
  out.width.setConstant(kInfinity);
  for (const PlaneComponent along : {kN1, kN3, kH}) {
    const GaussianDip dip = fit_gaussian(slice(old_image, T_old_cam, out.z, along));
    if (dip.ok) out.width(along) = dip.width;
  }
  out.ok = true;
  return out;
}

Slice PaperDenseCue::slice(const ImageView& old_image, const Se3& T_old_cam,
                           const Eigen::Vector3d& z, PlaneComponent along) const {
  const double half = along == kH ? kSliceHeightRatio * z(kH) : kSliceTilt;
  Slice out;
  for (std::size_t i = 0; i < kSliceSamples; ++i) {
    const double t = 2.0 * static_cast<double>(i) / static_cast<double>(kSliceSamples - 1) - 1.0;
    Eigen::Vector3d at = z;
    at(along) += half * t;
    out.x[i] = at(along);
    const double f = cost(old_image, T_old_cam, at);
    out.f[i] = std::isinf(f) ? 1.0 : f;  // 1 is the cost of images that share nothing
  }
  return out;
}

double PaperDenseCue::search_height(const ImageView& old_image, const Se3& T_old_cam,
                                    const Eigen::Vector3d& normal_cam) const {
  const double step = T_old_cam.t.norm();
  const double ln_range = std::log(kFastestStep / kSlowestStep);
  double best_height = 0.0;
  double best = kInfinity;
  double sum = 0.0;
  int num = 0;
  int best_index = 0;
  for (int i = 0; i < kNumSteps; ++i) {
    const double ratio = kSlowestStep * std::exp(ln_range * i / (kNumSteps - 1));
    const double height = step / ratio;
    const double sad = region_.sad(old_image, T_old_cam, normal_cam / height);
    if (std::isnan(sad)) continue;
    sum += sad;
    ++num;
    if (sad < best) {
      best = sad;
      best_height = height;
      best_index = i;
    }
  }
  // If the slowest step fits best, the image does not move or shows no road.
  return best_index > 0 && best < kLeastDip * sum / num ? best_height : 0.0;
}

}  // namespace plumb
