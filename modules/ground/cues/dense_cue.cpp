#include "modules/ground/cues/dense_cue.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "modules/ground/types/plane_state.hpp"

namespace plumb {
namespace {

// Steps per camera height that the search tries, each with the wide sweep around it: at 1.65 m and
// 10 images/s from 1.3 to 60 m/s.
constexpr std::array<double, 6> kSearchSteps{0.12, 0.26, 0.5, 0.95, 1.7, 3.0};

/// The result on which most others agree; null when no two agree.
const DenseMeasurement* most_agreed(const std::array<DenseMeasurement, kSearchSteps.size()>& found,
                                    double agree_ln_height) {
  const DenseMeasurement* best = nullptr;
  int most = 1;
  for (const DenseMeasurement& one : found) {
    if (!one.ok) continue;
    const auto agrees = [&](const DenseMeasurement& other) {
      return other.ok && std::abs(std::log(other.q.norm() / one.q.norm())) < agree_ln_height;
    };
    const auto num = static_cast<int>(std::count_if(found.begin(), found.end(), agrees));
    if (num <= most) continue;
    most = num;
    best = &one;
  }
  return best;
}

}  // namespace

DenseCue::DenseCue(const FilterConfig& config, const CueCovariance& covariance,
                   const ImageRing& images, const RowClock& clock)
    : config_(config),
      covariance_(covariance),
      images_(images),
      clock_(clock),
      alignment_(images.camera(), images.num_levels()) {}

Observation DenseCue::measure(const CueFrame& frame, const FramePrior& prior) {
  FramePrior next = prior;
  const Attempt attempt = prior.measurable ? align(frame, prior) : Attempt{};
  last_ = attempt.dense;
  const double least = prior.converged ? config_.least_dense_quality : config_.start_dense_quality;
  const bool good = last_.ok && covariance_.dense_quality(last_) >= least;
  if (prior.converged || good) {
    if (good && !prior.converged) next.height = 1.0 / last_.q.norm();
    const CueStatus failed = attempt.looked ? CueStatus::kFailed : CueStatus::kAbsent;
    return observed(prior, next, good ? CueStatus::kUsed : failed);
  }
  const DenseMeasurement found = search(frame, prior);
  if (!found.ok)
    return observed(prior, next, attempt.looked ? CueStatus::kFailed : CueStatus::kAbsent);
  last_ = found;
  next.height = 1.0 / found.q.norm();
  next.context = {std::abs(frame.chord.curvature) * next.height, frame.chord.step / next.height};
  next.measurable = true;
  return observed(next, next, CueStatus::kUsed);
}

DenseCue::Attempt DenseCue::align(const CueFrame& frame, const FramePrior& prior) {
  if (frame.image == nullptr) return {};
  const ImagePairs pairs = choose_image_pairs(*frame.vo, images_, clock_, prior.height);
  if (pairs.empty()) return {};
  const bool settled = prior.ln_height_std < config_.settled_ln_std;
  const DenseRequest request{prior.normal_cam, prior.height,
                             settled ? config_.settled_sweep_ln : config_.wide_sweep_ln,
                             prior.road};
  return {true, alignment_.measure(*frame.image, pairs, request)};
}

/// Aligns at several heights and takes the result on which at least two agree.
DenseMeasurement DenseCue::search(const CueFrame& frame, const FramePrior& prior) {
  if (frame.vo->status != VoStatus::kOk || !frame.chord.valid || frame.image == nullptr) return {};
  std::array<DenseMeasurement, kSearchSteps.size()> found;
  for (std::size_t i = 0; i < kSearchSteps.size(); ++i) {
    FramePrior at = prior;
    at.height = frame.chord.step / kSearchSteps[i];
    if (frame.chord.length <= config_.shortest_chord_ratio * at.height) continue;
    const DenseMeasurement dense = align(frame, at).dense;
    if (covariance_.dense_quality(dense) >= config_.least_dense_quality) found[i] = dense;
  }
  const DenseMeasurement* best = most_agreed(found, config_.agree_ln_height);
  return best != nullptr ? *best : DenseMeasurement{};
}

/// The observation of `last_`, whose covariance is that of a frame with `prior`.
Observation DenseCue::observed(const FramePrior& prior, const FramePrior& next, CueStatus status) {
  last_context_ = prior.context;
  Observation out = nothing_observed(next);
  out.report.status = status;
  if (!last_.ok) return out;
  const Eigen::Vector3d state = state_of_plane(last_.q);
  const Eigen::Matrix3d cov = covariance_.dense(last_, prior.context);
  out.report.height = std::exp(state(2));
  out.report.n1 = state(0);
  out.report.n3 = state(1);
  out.report.height_var = out.report.height * out.report.height * cov(2, 2);
  out.report.n1_var = cov(0, 0);
  out.report.n3_var = cov(1, 1);
  out.report.quality = covariance_.dense_quality(last_);
  if (status != CueStatus::kUsed) return out;
  out.plane.function = observe_plane;
  out.plane.value = state;
  out.plane.cov = with_correlated_height(cov, covariance_.dense_correlated_images(prior.context));
  out.start_ln_height = std::log(height_given_normal(last_, prior.normal_cam));
  return out;
}

HeightMeasurement DenseCue::height_over(const Eigen::Vector3d& plane) const {
  const Eigen::Matrix3d cov = covariance_.dense(last_, last_context_);
  return {std::log(height_given_normal(last_, normal_of_state(plane))), 1.0 / cov.inverse()(2, 2),
          given_slope(state_information(last_))};
}

}  // namespace plumb
