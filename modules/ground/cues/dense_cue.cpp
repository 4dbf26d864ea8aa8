#include "modules/ground/cues/dense_cue.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/fixed_vector.hpp"
#include "modules/ground/types/plane_state.hpp"

namespace plumb {
namespace {

// Steps per camera height that the search tries, each with the wide sweep around it: at 1.65 m and
// 10 images/s from 1.3 to 60 m/s.
constexpr std::array<double, 6> kSearchSteps{0.12, 0.26, 0.5, 0.95, 1.7, 3.0};

// Points with a known depth count as below a plane when they lie this many heights under the
// camera.
constexpr float kKnownDepthStd = 0.1F;
constexpr double kFarBelow = 1.4;
constexpr int kLeastBelow = 8;
constexpr double kMostBelow = 0.3;

constexpr std::size_t kMostResults = kSearchSteps.size() + 1;
using Results = FixedVector<DenseMeasurement, kMostResults>;

/// Share of what moved in the images that the plane leaves unexplained: 0 for a perfect one, 1 for
/// one that explains no more than standing still does.
double misfit(const DenseMeasurement& dense) {
  return (1.0 - dense.ncc) / std::max(1e-6, 1.0 - dense.still_ncc);
}

/// Nothing lies under the road: whether a good share of VO's points says that this plane is none.
bool is_above_points(const DenseMeasurement& dense, const VoOutput& vo) {
  int num_points = 0;
  int num_below = 0;
  for (const RoadPoint& point : vo.road_points) {
    if (point.rel_std > kKnownDepthStd) continue;
    ++num_points;
    if (dense.q.dot(point.p_cam.cast<double>()) > kFarBelow) ++num_below;
  }
  return num_below >= kLeastBelow && num_below > kMostBelow * num_points;
}

double ln_height_between(const DenseMeasurement& a, const DenseMeasurement& b) {
  return std::abs(std::log(a.q.norm() / b.q.norm()));
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
  if (!prior.converged) return start(frame, prior);
  const Attempt attempt = prior.measurable ? align(frame, prior) : Attempt{};
  last_ = attempt.dense;
  const bool good = last_.ok && covariance_.dense_quality(last_) >= config_.least_dense_quality;
  const CueStatus failed = attempt.looked ? CueStatus::kFailed : CueStatus::kAbsent;
  return observed(prior, prior, good ? CueStatus::kUsed : failed);
}

/// Before the filter has converged, the road is looked for at all heights. When several explain the
/// images about as well, no cue may start the filter: the road's texture repeats itself, or runs
/// along the motion.
Observation DenseCue::start(const CueFrame& frame, const FramePrior& prior) {
  FramePrior next = prior;
  const Attempt attempt = prior.measurable ? align(frame, prior) : Attempt{};
  const Found found = search(frame, prior, attempt.dense);
  last_ = found.best.ok ? found.best : attempt.dense;
  if (!found.sure) {
    if (found.contradicted) next.measurable = false;
    return observed(prior, next, attempt.looked ? CueStatus::kFailed : CueStatus::kAbsent);
  }
  next.height = 1.0 / last_.q.norm();
  if (prior.measurable && last_.q == attempt.dense.q)
    return observed(prior, next, CueStatus::kUsed);
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

/// Aligns at several heights. The best result is the one that leaves the least misfit, or
/// `expected`, the result at the prior's height, when it agrees with that one.
DenseCue::Found DenseCue::search(const CueFrame& frame, const FramePrior& prior,
                                 const DenseMeasurement& expected) {
  if (frame.vo->status != VoStatus::kOk || !frame.chord.valid || frame.image == nullptr) return {};
  Results results;
  const auto add = [&](const DenseMeasurement& dense) {
    if (covariance_.dense_quality(dense) < config_.least_dense_quality) return;
    if (!is_above_points(dense, *frame.vo)) (void)results.push_back(dense);
  };
  add(expected);
  const bool has_expected = !results.empty();
  for (const double step_ratio : kSearchSteps) {
    FramePrior at = prior;
    at.height = frame.chord.step / step_ratio;
    if (frame.chord.length <= config_.shortest_chord_ratio * at.height) continue;
    add(align(frame, at).dense);
  }
  if (results.empty()) return {};
  const auto* best =
      std::min_element(results.begin(), results.end(),
                       [](const auto& a, const auto& b) { return misfit(a) < misfit(b); });
  const bool expects = has_expected && ln_height_between(expected, *best) < config_.agree_ln_height;
  if (expects) best = results.begin();
  int num_agreeing = 0;
  bool alone = true;
  for (const DenseMeasurement& other : results) {
    const double apart = ln_height_between(other, *best);
    if (apart < config_.agree_ln_height) ++num_agreeing;
    if (apart < config_.distinct_ln_height) continue;
    alone = alone && misfit(*best) <= config_.start_misfit_ratio * misfit(other);
  }
  // A height that nothing else suggests has to be found from two sides.
  const bool good = num_agreeing > 1 ||
                    (expects && covariance_.dense_quality(*best) >= config_.start_dense_quality);
  return {*best, good && alone && misfit(*best) <= config_.start_misfit, !alone};
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
