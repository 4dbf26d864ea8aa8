#include "tools/learn/train/sampler.hpp"

#include <algorithm>
#include <cmath>

#include "modules/ground/types/plane_state.hpp"
#include "tools/learn/train/cue_errors.hpp"
#include "tools/support/statistics.hpp"

namespace plumb {
namespace {

// VO's unit is compared with the truth over this many images. They are enough to average out the
// truth's jitter and so few that VO hardly drifts.
constexpr std::int64_t kChordFrames = 10;
constexpr double kShortestChord_m = 1.0;

const WindowPose* find_chord(const VoOutput& vo, const TruthTrack& truth) {
  const WindowPose* best = nullptr;
  for (const WindowPose& pose : vo.window) {
    const std::int64_t age = vo.seq - pose.seq;
    if (age < 1 || age > kChordFrames || !truth.motion(pose.seq, vo.seq)) continue;
    if (best == nullptr || pose.seq < best->seq) best = &pose;
  }
  return best;
}

}  // namespace

/// Metres per [vo] in this frame, from the truth.
struct Sampler::Reference {
  bool known = false;
  double ln_scale = 0.0;
};

Sampler::Sampler(const TruthTrack* truth, double nominal_height_m)
    : truth_(truth), nominal_height_m_(nominal_height_m) {}

bool Sampler::take_truth(const VoOutput& vo, Sample* sample, Reference* reference) {
  const auto step = truth_->motion(vo.prev_seq, vo.seq);
  if (!step) return false;
  sample->true_step_m = step->t.norm();
  sample->true_turn_rad = log_so3(step->R).norm();
  const WindowPose* chord = find_chord(vo, *truth_);
  if (chord == nullptr) return true;
  const double length_m = truth_->motion(chord->seq, vo.seq)->t.norm();
  const double length = chord->T_window_cam.t.norm();
  sample->chord_frames = static_cast<double>(vo.seq - chord->seq);
  sample->chord_m = length_m;
  if (length_m < kShortestChord_m || !(length > 0.0)) return true;
  reference->known = true;
  reference->ln_scale = std::log(length_m / length);
  step_misfits_m_.push_back(sample->true_step_m - vo.T_prev_cam.t.norm() * length_m / length);
  return true;
}

void Sampler::add(const SampledFrame& frame) {
  const CueDiagnostics* diagnostics = frame.diagnostics;
  Sample sample;
  Reference scale;
  if (diagnostics != nullptr && !diagnostics->filter_started) return;
  if (!take_truth(*frame.vo, &sample, &scale)) return;
  sample.seq = static_cast<double>(frame.vo->seq);
  sample.time_s = 1e-6 * static_cast<double>(frame.vo->capture_us);

  const TruePlane* plane = truth_->plane(frame.vo->seq);
  sample.has_plane = plane != nullptr ? 1.0 : 0.0;
  sample.true_height_m = plane != nullptr ? plane->height_m : nominal_height_m_;
  sample.nominal_height_m = nominal_height_m_;
  if (plane != nullptr) {
    sample.true_n1 = plane->normal_cam.x();
    sample.true_n3 = plane->normal_cam.z();
    write_plane_output(*frame.plane, *plane, &sample);
  }
  write_cues(frame.output->plane.cues, &sample);
  write_objects(frame.output->plane.cues[kCueObjects], plane, &sample);
  const auto motion = truth_->motion(frame.vo->prev_seq, frame.vo->seq);
  if (motion) write_motion_output(*frame.ego, *motion, &sample);
  if (scale.known && frame.ego->log_scale_std > 0.0) {
    sample.out_scale_err = frame.ego->log_scale - scale.ln_scale;
    sample.out_scale_var = frame.ego->log_scale_std * frame.ego->log_scale_std;
  }
  if (scale.known && diagnostics != nullptr) add_cues(*diagnostics, scale.ln_scale, plane, &sample);
  if (scale.known && diagnostics == nullptr) {
    write_paper(frame.output->plane, std::exp(scale.ln_scale), sample.true_height_m, plane,
                &sample);
  }
  samples_.push_back(sample);
}

void Sampler::add_cues(const CueDiagnostics& diagnostics, double ln_scale, const TruePlane* plane,
                       Sample* sample) const {
  if (diagnostics.measurable) {
    sample->turn_ratio = diagnostics.context.turn_ratio;
    sample->step_ratio = diagnostics.context.step_ratio;
  }
  CueReference reference;
  reference.ln_height = std::log(sample->true_height_m) - ln_scale;
  reference.plane = plane;
  reference.normal_cam = plane != nullptr ? plane->normal_cam : normal_of_state(diagnostics.state);
  if (plane == nullptr) reference.normal_cov = diagnostics.cov.topLeftCorner<2, 2>();
  sample->out_scale_bias_var = diagnostics.ln_scale_bias_var;
  sample->out_height_added_var = diagnostics.plane_added.ln_height;
  sample->out_pitch_added_var = diagnostics.plane_added.pitch_rad2;
  sample->out_roll_added_var = diagnostics.plane_added.roll_rad2;
  sample->out_dense_n1_square = diagnostics.plane_context.dense_n1_square;
  sample->out_dense_n3_square = diagnostics.plane_context.dense_n3_square;
  sample->out_chord_square = diagnostics.plane_context.chord_square;
  write_dense(diagnostics, reference, sample);
  write_points(diagnostics, reference, sample);
  write_chord(diagnostics, reference, sample);
}

std::vector<Sample> Sampler::take() {
  // Each end of a chord jitters as each end of a step does.
  const double jitter_m = step_misfits_m_.size() > 2 ? robust_std(step_misfits_m_) : 0.0;
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    Sample& sample = samples_[i];
    if (sample.chord_m >= kShortestChord_m) sample.truth_ln_std = jitter_m / sample.chord_m;
    if (i == 0) continue;
    const double dt_s = sample.time_s - samples_[i - 1].time_s;
    if (samples_[i - 1].seq + 1.0 == sample.seq && dt_s > 0.0)
      sample.speed_m_s = sample.true_step_m / dt_s;
  }
  return std::move(samples_);
}

}  // namespace plumb
