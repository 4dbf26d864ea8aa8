#include "modules/ground/cues/objects_pitch.hpp"

#include <algorithm>
#include <cmath>

#include "core/numbers.hpp"
#include "modules/detections/foot_point.hpp"

namespace plumb {
namespace {

constexpr std::int64_t kLongestGap_us = 2'000'000;
constexpr double kLogHeightRateStd = 0.01;  ///< [1/sqrt(s)]
constexpr double kMostHeightSigmas = 3.0;   ///< from the class's mean, for a track
constexpr double kMostDisagreement = 2.5;   ///< smoothed over frames, in sigmas
constexpr double kMostSigmas = 6.0;         ///< of one frame's part in it
constexpr double kDisagreementKeep = 0.7;   ///< per frame
constexpr double kHiddenFootStd = 0.5;      ///< shares of the height per share hidden
constexpr double kLeastWeight = 0.05;
constexpr std::size_t kLeastCandidates = 6;
constexpr double kLeastOverlap = 0.2;
constexpr int kMixtureIterations = 8;
constexpr double kMostMixtureResidual = 0.25;  ///< share of the amplitude

HeightFilter::Prior filter_prior(const DetectionsConfig& config) {
  return {config.mean_pitch_rad, config.pitch_std_rad, config.pitch_time_s, kLogHeightRateStd};
}

/// Boxes of a detector that does not track get numbers below -1, which no track has.
std::int32_t track_or_own_id(const Detection& detection, std::size_t index) {
  return detection.track_id >= 0 ? detection.track_id : -2 - static_cast<std::int32_t>(index);
}

}  // namespace

ObjectsPitch::ObjectsPitch(const DetectionsConfig& config, const CameraModel& camera)
    : config_(config), camera_(camera), filter_(filter_prior(config)) {}

const ObjectsPitchOutput& ObjectsPitch::update(const ObjectsPitchInput& input) {
  begin(input.frame->capture_us);
  screen_boxes(config_, camera_, expected_plane(input), *input.frame, &output_.verdicts);
  read_boxes(input);
  judge(input);
  combine(input);
  finish(input);
  return output_;
}

void ObjectsPitch::begin(std::int64_t capture_us) {
  const std::int64_t gap_us = capture_us - last_us_;
  if (!started_ || gap_us < 0 || gap_us > kLongestGap_us) {
    filter_ = HeightFilter(filter_prior(config_));
    disagreement_.fill(0.0);
  }
  filter_.predict(
      started_ ? 1e-6 * static_cast<double>(std::clamp<std::int64_t>(gap_us, 0, kLongestGap_us))
               : 0.0);
  filter_.drop_before(capture_us - kLongestGap_us);
  started_ = true;
  last_us_ = capture_us;
  output_ = {};
  readings_.clear();
}

RoadPlane ObjectsPitch::expected_plane(const ObjectsPitchInput& input) const {
  RoadPlane plane;
  plane.pitch_rad = filter_.slow_pitch_rad();
  plane.roll_rad = input.roll_rad;
  plane.height_m = input.height_m;
  plane.cov.diagonal() << filter_.slow_pitch_var_rad2() + square(config_.pitch_jitter_std_rad),
      square(input.roll_std_rad), square(input.height_std_ratio);
  return plane;
}

void ObjectsPitch::read_boxes(const ObjectsPitchInput& input) {
  const DetectionFrame& frame = *input.frame;
  for (std::size_t i = 0; i < frame.detections.size(); ++i) {
    if (output_.verdicts[i] != BoxVerdict::kUsed) continue;
    const Detection& detection = frame.detections[i];
    const HeightPrior prior = config_.height_prior(detection.object_class);
    const HeightFilter::Place place = filter_.place_of(
        track_or_own_id(detection, i), static_cast<std::int8_t>(detection.object_class),
        std::log(prior.mean_m), square(prior.std_m / prior.mean_m), frame.capture_us);
    if (place.slot == HeightFilter::kNone) {
      output_.verdicts[i] = BoxVerdict::kNoRoom;
      continue;
    }
    if (place.is_new) disagreement_[place.slot] = 0.0;
    const double sigmas =
        (filter_.log_height(place.slot) - std::log(prior.mean_m)) * prior.mean_m / prior.std_m;
    if (std::abs(sigmas) > kMostHeightSigmas) {
      // It cannot stand on this road: reset its height and let it agree with the others again.
      filter_.reset_height(place.slot, std::log(prior.mean_m), square(prior.std_m / prior.mean_m));
      disagreement_[place.slot] = std::copysign(kMostSigmas, sigmas);
    }
    Reading reading;
    reading.index = i;
    reading.slot = place.slot;
    if (!read_box(input, &reading) || !readings_.push_back(reading)) {
      output_.verdicts[i] = BoxVerdict::kOffRoad;
    }
  }
}

bool ObjectsPitch::read_box(const ObjectsPitchInput& input, Reading* reading) {
  const Box& box = input.frame->detections[reading->index].box;
  reading->log_height = filter_.log_height(reading->slot);
  const auto pitch = pitch_from_box(camera_, input.roll_rad, {box.centre_u_px(), box.bottom_px},
                                    box.top_px, std::exp(reading->log_height) / input.height_m);
  if (!pitch) return false;
  reading->pitch_rad = pitch->pitch_rad;
  reading->J_height = pitch->J_log_ratio;

  const double edge_var = edge_var_px2(*input.frame, reading->index);
  // Whatever hides the lower edge moves it up by up to that share of the height.
  const double hidden = hidden_edges(*input.frame, reading->index).lower_ratio;
  const double foot_var = edge_var + square(kHiddenFootStd * hidden * box.height_px());
  const double distance_m = std::exp(reading->log_height) * camera_.fy_px / box.height_px();
  reading->var_rad2 = square(pitch->J_px(1)) * foot_var + square(pitch->J_px(2)) * edge_var +
                      square(pitch->J_roll * input.roll_std_rad) +
                      square(pitch->J_log_ratio * input.height_std_ratio) +
                      square(config_.road_bend_std_rad_m * distance_m);
  reading->std_rad = std::sqrt(reading->var_rad2 +
                               square(reading->J_height) * filter_.log_height_var(reading->slot));
  return true;
}

double ObjectsPitch::edge_var_px2(const DetectionFrame& frame, std::size_t index) {
  const Box& box = frame.detections[index].box;
  if (fit_candidates(frame, index)) {
    const MixtureComponent component = mixture_.component(mixture_.nearest_component(box));
    const double confidence_px2 = placement_confidence_px2(component);
    const bool sound = mixture_.rms_residual() < kMostMixtureResidual * component.amplitude;
    if (sound && std::isfinite(confidence_px2)) {
      output_.confidence_px2[index] = confidence_px2;
      return config_.belief_offset_px2 + config_.belief_slope * confidence_px2;
    }
  }
  return square(config_.edge_std_px) + square(config_.edge_std_ratio * box.height_px());
}

void ObjectsPitch::add_to_mixture(const Detection& detection) {
  if (!mixture_.add_component(detection.box, detection.score)) return;
  for (const Candidate& candidate : detection.candidates) {
    mixture_.add_sample(candidate.box, candidate.score);
  }
}

bool ObjectsPitch::fit_candidates(const DetectionFrame& frame, std::size_t index) {
  const Detection& detection = frame.detections[index];
  if (detection.candidates.size() < kLeastCandidates) return false;
  // The fit includes the neighbour that shares most candidates. More than one neighbour would cost
  // more time than a frame has.
  std::size_t neighbour = index;
  double most_overlap = kLeastOverlap;
  for (std::size_t i = 0; i < frame.detections.size(); ++i) {
    const double overlap = intersection_over_union(frame.detections[i].box, detection.box);
    if (i == index || overlap <= most_overlap) continue;
    most_overlap = overlap;
    neighbour = i;
  }
  mixture_.clear();
  add_to_mixture(detection);
  if (neighbour != index) add_to_mixture(frame.detections[neighbour]);
  return mixture_.num_samples() >= kLeastCandidates && mixture_.fit(kMixtureIterations);
}

void ObjectsPitch::judge(const ObjectsPitchInput& input) {
  votes_.clear();
  for (const Reading& reading : readings_) {
    const bool distrusted = std::abs(disagreement_[reading.slot]) > kMostDisagreement;
    if (distrusted) output_.verdicts[reading.index] = BoxVerdict::kAgainstPlane;
    Vote vote{reading.pitch_rad, reading.std_rad, 0.0};
    if (!distrusted && !votes_.push_back(vote)) return;
  }
  const double prior_std =
      std::sqrt(filter_.slow_pitch_var_rad2() + square(config_.pitch_jitter_std_rad));
  bool room = votes_.push_back({filter_.slow_pitch_rad(), prior_std, 0.0});
  if (input.has_other) {
    room = room && votes_.push_back({input.other_pitch_rad, std::sqrt(input.other_var_rad2), 0.0});
  }
  if (!room) return;
  const double centre_rad = robust_mean(&votes_);

  std::size_t vote = 0;
  for (Reading& reading : readings_) {
    const double sigmas =
        std::clamp((reading.pitch_rad - centre_rad) / reading.std_rad, -kMostSigmas, kMostSigmas);
    double& disagreement = disagreement_[reading.slot];
    disagreement = kDisagreementKeep * disagreement + (1.0 - kDisagreementKeep) * sigmas;
    if (output_.verdicts[reading.index] == BoxVerdict::kAgainstPlane) continue;
    reading.weight = votes_[vote++].weight;
    if (reading.weight < kLeastWeight) output_.verdicts[reading.index] = BoxVerdict::kOutlier;
  }
}

void ObjectsPitch::combine(const ObjectsPitchInput& input) {
  double weight_sum = 0.0;
  double information = 0.0;
  double J_bias = 0.0;
  for (const Reading& reading : readings_) {
    if (output_.verdicts[reading.index] != BoxVerdict::kUsed) continue;
    filter_.update_box(reading.slot, reading.log_height, reading.pitch_rad, reading.J_height,
                       reading.var_rad2 / reading.weight);
    const double share = reading.weight / square(reading.std_rad);
    information += share;
    J_bias += share * reading.J_height;
    weight_sum += reading.weight;
    ++output_.num_used;
  }
  double bias_var = 0.0;
  if (output_.num_used > 0) {
    // All heights may be wrong by the same factor; that part does not average out.
    bias_var = square(J_bias / information * config_.height_bias_std_ratio);
    const double cosine = std::cos(filter_.pitch_rad());
    output_.status = ObjectsPitchStatus::kValid;
    output_.n3 = std::sin(filter_.pitch_rad());
    output_.n3_var = square(cosine) * (filter_.pitch_var_rad2() + bias_var);
    output_.quality = weight_sum / static_cast<double>(readings_.size());
  } else if (!readings_.empty()) {
    output_.status = ObjectsPitchStatus::kFailed;
  }
  const double observed_var = filter_.pitch_var_rad2();
  filter_.tie_to_slow_pitch(square(config_.pitch_jitter_std_rad));
  if (input.has_other) filter_.update_pitch(input.other_pitch_rad, input.other_var_rad2);
  output_.pitch_rad = filter_.pitch_rad();
  const double share = filter_.pitch_var_rad2() / observed_var;
  output_.pitch_var_rad2 = filter_.pitch_var_rad2() + square(share) * bias_var;
}

void ObjectsPitch::finish(const ObjectsPitchInput& input) {
  for (const Reading& reading : readings_) {
    output_.height_m[reading.index] = std::exp(filter_.log_height(reading.slot));
    if (input.frame->detections[reading.index].track_id < 0) filter_.drop(reading.slot);
  }
}

}  // namespace plumb
