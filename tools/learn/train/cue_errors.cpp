#include "tools/learn/train/cue_errors.hpp"

#include <Eigen/LU>
#include <cmath>

#include "core/pose_wire.hpp"
#include "modules/ground/covariance/fixed_covariance.hpp"
#include "modules/ground/types/plane_state.hpp"

namespace plumb {
namespace {

constexpr double kShortestTrueStep_m = 0.1;

double given_variance(const Eigen::Matrix3d& cov) { return 1.0 / cov.inverse()(2, 2); }

Eigen::Vector3d true_state(const CueReference& reference) {
  return {reference.plane->normal_cam.x(), reference.plane->normal_cam.z(), reference.ln_height};
}

}  // namespace

void write_dense(const CueDiagnostics& diagnostics, const CueReference& reference, Sample* sample) {
  const DenseMeasurement& dense = diagnostics.dense;
  if (!dense.ok) return;
  sample->dense_used = diagnostics.cues[kCueDense].status == CueStatus::kUsed ? 1.0 : 0.0;
  sample->dense_ncc = dense.ncc;
  sample->dense_sad = dense.sad;
  sample->dense_still_ncc = dense.still_ncc;
  sample->dense_sigma_grey = dense.sigma_grey;
  sample->dense_num_pixels = dense.num_pixels;

  const Eigen::Vector3d state = state_of_plane(dense.q);
  const Eigen::Matrix3d information = state_information(dense);
  const Eigen::Matrix3d pixel = information.inverse();
  sample->dense_pixel_var_n1 = pixel(0, 0);
  sample->dense_pixel_var_n3 = pixel(1, 1);
  sample->dense_pixel_var_height = pixel(2, 2);
  sample->dense_pixel_var_given = 1.0 / information(2, 2);
  const Eigen::RowVector2d slope = given_slope(information);
  sample->dense_slope_n1 = slope(0);
  sample->dense_slope_n3 = slope(1);

  const Eigen::Matrix3d hand = FixedCovariance().dense(dense, diagnostics.context);
  sample->dense_hand_var_n1 = hand(0, 0);
  sample->dense_hand_var_n3 = hand(1, 1);
  sample->dense_hand_var_height = hand(2, 2);
  sample->dense_hand_var_given = given_variance(hand);

  sample->dense_err_height = state(2) - reference.ln_height;
  const Eigen::Vector2d tilt(state(0) - reference.normal_cam.x(),
                             state(1) - reference.normal_cam.z());
  sample->dense_err_given = sample->dense_err_height - slope * tilt;
  sample->dense_given_ref_var = slope * reference.normal_cov * slope.transpose();
  if (reference.plane == nullptr) return;
  sample->dense_err_n1 = state(0) - true_state(reference)(0);
  sample->dense_err_n3 = state(1) - true_state(reference)(1);
}

void write_points(const CueDiagnostics& diagnostics, const CueReference& reference,
                  Sample* sample) {
  const PointsMeasurement& points = diagnostics.points;
  const double height = reference.normal_cam.dot(points.centre);
  if (!points.ok || !(height > 0.0)) return;
  sample->points_used = diagnostics.cues[kCuePoints].status == CueStatus::kUsed ? 1.0 : 0.0;
  sample->points_num_candidates = points.num_candidates;
  sample->points_num_inliers = points.num_inliers;
  sample->points_score = points.score;
  sample->points_spread = points.ln_height_std;
  const Eigen::Vector3d state(reference.normal_cam.x(), reference.normal_cam.z(), 0.0);
  const Eigen::RowVector2d slope = points.centre.transpose() * normal_jacobian(state) / height;
  sample->points_slope_n3 = slope(1);
  sample->points_err = std::log(height) - reference.ln_height;
  sample->points_ref_var = slope * reference.normal_cov * slope.transpose();
  sample->points_hand_var = FixedCovariance().points(points, diagnostics.context);
}

void write_chord(const CueDiagnostics& diagnostics, const CueReference& reference, Sample* sample) {
  const Chord& chord = diagnostics.chord;
  if (!chord.valid || !diagnostics.measurable) return;
  sample->chord_ratio = chord.length / std::exp(reference.ln_height);
  sample->chord_num_frames = chord.num_frames;
  sample->chord_hand_var = FixedCovariance().chord(chord, diagnostics.context);
  sample->chord_ref = reference.normal_cam.dot(chord.direction);
  if (reference.plane != nullptr) sample->chord_err = sample->chord_ref;
}

void write_cues(const CueReports& reports, Sample* sample) {
  for (std::size_t i = 0; i < kNumCues; ++i) {
    const CueReport& report = reports[i];
    CueSample& cue = sample->cues[i];
    cue.status = static_cast<double>(report.status);
    cue.quality = report.quality;
    cue.innovation_n1 = report.innovation(0);
    cue.innovation_n3 = report.innovation(1);
    cue.innovation_ln_height = report.innovation(2);
    cue.test_ratio = report.test_ratio;
  }
}

void write_objects(const CueReport& objects, const TruePlane* truth, Sample* sample) {
  const bool seen = objects.status == CueStatus::kUsed || objects.status == CueStatus::kGated;
  if (!seen || truth == nullptr) return;
  sample->objects_confidence = objects.features[0];
  sample->objects_err_n3 = objects.n3 - truth->normal_cam.z();
}

void write_paper(const PlaneOutput& plane, double metres_per_vo, double true_height_m,
                 const TruePlane* truth, Sample* sample) {
  const CueReport& dense = plane.cues[kCueDense];
  if (dense.status != CueStatus::kAbsent && dense.num_features == 3) {
    sample->paper_width_height = dense.features[0];
    sample->paper_width_n1 = dense.features[1];
    sample->paper_width_n3 = dense.features[2];
    sample->paper_err_height = dense.height * metres_per_vo - true_height_m;
    if (truth != nullptr) {
      sample->paper_err_n1 = dense.n1 - truth->normal_cam.x();
      sample->paper_err_n3 = dense.n3 - truth->normal_cam.z();
    }
  }
  const CueReport& points = plane.cues[kCuePoints];
  if (points.status != CueStatus::kAbsent && points.num_features == 1) {
    sample->paper_vote = points.features[0];
    sample->paper_err_points = points.height * metres_per_vo - true_height_m;
  }
}

void write_plane_output(const ground_plane_t& plane, const TruePlane& truth, Sample* sample) {
  if (plane.status != ground_plane_t::STATUS_OK) return;
  sample->out_height_err = std::log(plane.height_m / truth.height_m);
  sample->out_height_var = plane.cov[2][2];
  sample->out_pitch_err = plane.pitch_rad - truth.pitch_rad();
  sample->out_pitch_var = plane.cov[0][0];
  sample->out_roll_err = plane.roll_rad - truth.roll_rad();
  sample->out_roll_var = plane.cov[1][1];
}

void write_motion_output(const ego_motion_t& ego, const Se3& T_prev_cam_true, Sample* sample) {
  Se3 T_prev_cam;
  Matrix6d cov;
  if (ego.status != ego_motion_t::STATUS_OK || T_prev_cam_true.t.norm() < kShortestTrueStep_m ||
      from_wire(ego.q_prev_cam, ego.t_prev_cam_m, &T_prev_cam) != nullptr ||
      from_wire(ego.cov_prev_cam, &cov) != nullptr) {
    return;
  }
  const double length = T_prev_cam.t.norm();
  if (!(length > 0.0)) return;
  const Eigen::Vector3d along = T_prev_cam.t / length;
  const Eigen::Matrix3d move_cov = cov.topLeftCorner<3, 3>();
  const Eigen::Matrix3d turn_cov = cov.bottomRightCorner<3, 3>();
  sample->out_step_err = std::log(length / T_prev_cam_true.t.norm());
  sample->out_step_var = along.dot(move_cov * along) / (length * length);
  const Eigen::Vector3d moved = T_prev_cam.t - T_prev_cam_true.t;
  const Eigen::Vector3d turned = log_so3(T_prev_cam_true.R.transpose() * T_prev_cam.R);
  sample->out_move_nees = moved.dot(move_cov.inverse() * moved) / 3.0;
  sample->out_turn_nees = turned.dot(turn_cov.inverse() * turned) / 3.0;
}

}  // namespace plumb
