#include "tools/learn/train/targets.hpp"

#include <cmath>

namespace plumb {
namespace {

// Without a true plane, the height ahead follows the road's bend. The rest of it has this standard
// deviation on drives with true planes.
constexpr double kBendRestStd = 0.011;
constexpr double kLeastSlope = 2.0;  // of ln h against n3, for a height's error to show a tilt

bool finite(double a, double b, double c) {
  return std::isfinite(a) && std::isfinite(b) && std::isfinite(c);
}

/// Variance of the true ln h that a cue is compared with.
double reference_var(const Sample& s, double normal_part) {
  const double road = s.has_plane > 0.5 ? 0.0 : kBendRestStd;
  return s.truth_ln_std * s.truth_ln_std + road * road + normal_part;
}

/// What the road's bend adds to the nominal height ahead, where there is no true plane.
double bend_of(const Sample& s, const GroundModel& model) {
  return s.has_plane > 0.5 ? 0.0 : model.bend.height_slope * s.chord_ref;
}

CueFeatures features(const Sample& s, double pixel_var) {
  return dense_features(pixel_var, s.dense_ncc, s.turn_ratio, s.step_ratio);
}

bool dense_row(Target target, const Sample& s, const GroundModel& model, TargetRow* out) {
  if (!(s.dense_used > 0.5)) return false;
  VarianceRow& row = out->row;
  if (target == Target::kDenseHeight) {
    row = {s.dense_err_given - bend_of(s, model), reference_var(s, s.dense_given_ref_var), 1.0,
           features(s, s.dense_pixel_var_given)};
    out->hand_var = s.dense_hand_var_given;
  } else if (target == Target::kDenseN1) {
    row = {s.dense_err_n1, 0.0, 1.0, features(s, s.dense_pixel_var_n1)};
    out->hand_var = s.dense_hand_var_n1;
  } else if (s.has_plane > 0.5) {
    row = {s.dense_err_n3, 0.0, 1.0, features(s, s.dense_pixel_var_n3)};
    out->hand_var = s.dense_hand_var_n3;
  } else {
    if (!(std::abs(s.dense_slope_n3) > kLeastSlope)) return false;
    const double given = model.dense_height.of(features(s, s.dense_pixel_var_given));
    const double per_tilt = 1.0 / s.dense_slope_n3;
    row = {(s.dense_err_height - bend_of(s, model)) * per_tilt,
           (given + reference_var(s, 0.0)) * per_tilt * per_tilt, 1.0,
           features(s, s.dense_pixel_var_n3)};
    out->hand_var = s.dense_hand_var_n3;
    out->direct = false;
  }
  return true;
}

bool points_row(const Sample& s, const GroundModel& model, TargetRow* out) {
  if (!(s.points_used > 0.5)) return false;
  out->row = {s.points_err - bend_of(s, model), reference_var(s, s.points_ref_var), 1.0,
              points_features(s.points_num_inliers, s.points_spread, s.turn_ratio, s.step_ratio)};
  out->hand_var = s.points_hand_var;
  return true;
}

/// Chords that do not overlap have independent errors.
bool chord_row(const std::vector<Sample>& frames, std::size_t i, TargetRow* out) {
  const Sample& s = frames[i];
  if (!(s.chord_num_frames >= 1.0)) return false;
  const auto num = static_cast<std::size_t>(s.chord_num_frames);
  if (i < num || frames[i - num].seq + s.chord_num_frames != s.seq) return false;
  out->row = {std::sqrt(0.5) * (s.chord_err - frames[i - num].chord_err), 0.0, 1.0,
              chord_features(s.turn_ratio, s.step_ratio)};
  out->hand_var = s.chord_hand_var;
  return true;
}

bool plane_row(Target target, const Sample& s, TargetRow* out) {
  const bool roll = target == Target::kPlaneRoll;
  const CueFeatures f =
      roll ? plane_features(s.out_dense_n1_square, 0.0, s.turn_ratio, s.step_ratio)
           : plane_features(s.out_dense_n3_square, s.out_chord_square, s.turn_ratio, s.step_ratio);
  const auto row = [&f](double error, double var, double added) {
    return VarianceRow{error, var - added, 1.0, f};
  };
  out->row = roll ? row(s.out_roll_err, s.out_roll_var, s.out_roll_added_var)
             : target == Target::kPlanePitch
                 ? row(s.out_pitch_err, s.out_pitch_var, s.out_pitch_added_var)
                 : row(s.out_height_err, s.out_height_var, s.out_height_added_var);
  return true;
}

bool row_of(Target target, const std::vector<Sample>& frames, std::size_t i,
            const GroundModel& model, TargetRow* out) {
  const Sample& s = frames[i];
  switch (target) {
    case Target::kPoints:
      return points_row(s, model, out);
    case Target::kChord:
      return chord_row(frames, i, out);
    case Target::kPlanePitch:
    case Target::kPlaneRoll:
    case Target::kPlaneHeight:
      return plane_row(target, s, out);
    default:
      return dense_row(target, s, model, out);
  }
}

}  // namespace

bool is_plane(Target target) { return target >= Target::kPlanePitch; }

const char* target_name(Target target) {
  constexpr std::array<const char*, kTargets.size()> kNames{
      "dense_height", "dense_n1",    "dense_n3",   "points",
      "chord",        "plane_pitch", "plane_roll", "plane_height"};
  return kNames[static_cast<std::size_t>(target)];
}

// The whole drive has the weight of 2 sqrt(n) rows: about the number of independent ones in it.
double drive_weight(std::size_t num) {
  return 2.0 / std::sqrt(static_cast<double>(std::max<std::size_t>(num, 4)));
}

std::vector<TargetRow> rows_of(Target target, const DriveSamples& drive, const GroundModel& model) {
  std::vector<TargetRow> rows;
  if (is_plane(target) && drive.algorithm != "learned") return rows;
  for (std::size_t i = 0; i < drive.frames.size(); ++i) {
    const Sample& s = drive.frames[i];
    TargetRow row;
    if (!row_of(target, drive.frames, i, model, &row)) continue;
    bool complete = finite(row.row.error, row.row.extra_var, row.hand_var);
    for (const double f : row.row.features) complete = complete && std::isfinite(f);
    if (!complete) continue;
    row.seq = s.seq;
    row.step_ratio = s.step_ratio;
    rows.push_back(row);
  }
  for (TargetRow& row : rows) row.row.weight = drive_weight(rows.size());
  return rows;
}

LogVariance& model_of(Target target, GroundModel* model) {
  LogVariance* const kModels[] = {&model->dense_height, &model->dense_n1,    &model->dense_n3,
                                  &model->points,       &model->chord,       &model->plane_pitch,
                                  &model->plane_roll,   &model->plane_height};
  return *kModels[static_cast<std::size_t>(target)];
}

const LogVariance& model_of(Target target, const GroundModel& model) {
  const LogVariance* const kModels[] = {&model.dense_height, &model.dense_n1,    &model.dense_n3,
                                        &model.points,       &model.chord,       &model.plane_pitch,
                                        &model.plane_roll,   &model.plane_height};
  return *kModels[static_cast<std::size_t>(target)];
}

// What the covariances set by hand say about the same features. They are variances, so that the
// powers are twice those of standard deviations.
SlopePrior prior_of(Target target) {
  switch (target) {
    case Target::kPoints:
      return {{0.7, 0.5, 1.5, 0.5}, {0.5, 0.5, 0.7, 0.7}};
    case Target::kChord:
      return {{0.0, 0.0, 0.5, 0.5}, {0.0, 0.0, 0.7, 0.7}};
    case Target::kPlaneRoll:
      return {{0.5, 0.0, 0.5, 0.5}, {0.7, 0.0, 0.7, 0.7}};
    case Target::kPlanePitch:
    case Target::kPlaneHeight:
      return {{0.5, 0.5, 0.5, 0.5}, {0.7, 0.7, 0.7, 0.7}};
    default:
      return {{0.3, 4.0, 1.5, 0.5}, {0.3, 1.0, 0.7, 0.7}};
  }
}

VarianceBounds bounds_of(Target target) {
  if (target == Target::kDenseHeight || target == Target::kPoints) return {0.003, 0.6};
  // The residual of a cue that sees no road is unbounded, but the reported error stays below this.
  if (target == Target::kPlaneHeight) return {0.0005, 0.15};
  if (is_plane(target)) return {0.0001, 0.03};
  return {0.0007, 0.17};
}

}  // namespace plumb
