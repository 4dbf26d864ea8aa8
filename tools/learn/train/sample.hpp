/// One frame of a drive as the trainer sees it: what was known at run time, and the errors.
///
/// Every value is a number; NaN where there is none (a cue that measured nothing, no true plane).
/// Errors are estimate minus truth, of n1 and n3 (components of the unit normal), of ln h, or as
/// named. The true scale turns [vo] into metres.
///
/// Units:
///   n1, n3 and ln ratios: 1.  A variance has the unit of the error beside it, squared.
#pragma once

#include <array>
#include <limits>

#include "modules/ground/types/cue_table.hpp"

namespace plumb {

/// What every cue of kCueTable reports alike.
struct CueSample {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

  double status = kNone;  ///< CueStatus
  double quality = kNone;
  double innovation_n1 = kNone;
  double innovation_n3 = kNone;
  double innovation_ln_height = kNone;
  double test_ratio = kNone;
};

struct Sample {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

  double seq = kNone;
  double time_s = kNone;
  // Truth.
  double true_step_m = kNone;    ///< of this frame
  double true_turn_rad = kNone;  ///< of this frame
  double chord_frames = kNone;   ///< images over which the true scale was taken
  double chord_m = kNone;        ///< true length of that chord
  /// 1-sigma of the true ln scale: jitter of the truth over its chord.
  double truth_ln_std = kNone;
  double has_plane = kNone;  ///< 1: height and normal are measured; 0: nominal height, no normal
  double true_height_m = kNone;
  double nominal_height_m = kNone;
  double true_n1 = kNone;
  double true_n3 = kNone;
  // Context.
  double turn_ratio = kNone;  ///< |curvature| times camera height
  double step_ratio = kNone;  ///< step in camera heights
  double speed_m_s = kNone;   ///< true
  // Dense cue. "given" is the height given the normal (the true one, else the filter's).
  double dense_used = kNone;
  double dense_ncc = kNone;
  double dense_sad = kNone;
  double dense_still_ncc = kNone;
  double dense_sigma_grey = kNone;
  double dense_num_pixels = kNone;
  double dense_pixel_var_n1 = kNone;  ///< by pixel noise alone
  double dense_pixel_var_n3 = kNone;
  double dense_pixel_var_height = kNone;
  double dense_pixel_var_given = kNone;
  double dense_slope_n1 = kNone;  ///< d(ln h given the normal) / d(n1)
  double dense_slope_n3 = kNone;
  double dense_err_n1 = kNone;
  double dense_err_n3 = kNone;
  double dense_err_height = kNone;
  double dense_err_given = kNone;
  double dense_given_ref_var = kNone;  ///< what the reference normal adds to that error
  double dense_hand_var_n1 = kNone;    ///< from FixedCovariance, like every hand_var
  double dense_hand_var_n3 = kNone;
  double dense_hand_var_height = kNone;
  double dense_hand_var_given = kNone;
  // Points cue.
  double points_used = kNone;
  double points_num_candidates = kNone;
  double points_num_inliers = kNone;
  double points_score = kNone;
  double points_spread = kNone;
  double points_slope_n3 = kNone;
  double points_err = kNone;
  double points_ref_var = kNone;
  double points_hand_var = kNone;
  // Detected objects.
  double objects_confidence = kNone;  ///< variance of n3 by the boxes alone
  double objects_err_n3 = kNone;
  // Direction of translation over a chord.
  double chord_ratio = kNone;  ///< chord in camera heights
  double chord_num_frames = kNone;
  double chord_err = kNone;
  double chord_ref = kNone;
  double chord_hand_var = kNone;
  // What was reported, with the variances of that run.
  double out_scale_err = kNone;
  double out_scale_var = kNone;
  double out_scale_bias_var = kNone;  ///< part of it that the model adds for a whole drive
  double out_height_err = kNone;
  double out_height_var = kNone;
  double out_height_added_var = kNone;  ///< part of it that is not the filter's and the cues'
  double out_pitch_err = kNone;
  double out_pitch_var = kNone;
  double out_pitch_added_var = kNone;
  double out_roll_err = kNone;
  double out_roll_var = kNone;
  double out_roll_added_var = kNone;
  double out_dense_n1_square = kNone;  ///< as PlaneContext has it
  double out_dense_n3_square = kNone;
  double out_chord_square = kNone;
  double out_step_err = kNone;  ///< ln of the motion's length
  double out_step_var = kNone;
  double out_move_nees = kNone;  ///< of the translation, 3 degrees of freedom, divided by 3
  double out_turn_nees = kNone;  ///< of the rotation
  // The published method's confidences (widths of the slices, score of the vote) and errors; only
  // when that mode ran.
  double paper_width_height = kNone;
  double paper_width_n1 = kNone;
  double paper_width_n3 = kNone;
  double paper_vote = kNone;
  double paper_err_height = kNone;  ///< [m], as the published models have it
  double paper_err_n1 = kNone;
  double paper_err_n3 = kNone;
  double paper_err_points = kNone;  ///< [m]
  std::array<CueSample, kNumCues> cues{};

  /// The one list of columns: field(name, member).
  template <typename S, typename Field>
  static void visit(S& s, Field&& field);
};

}  // namespace plumb

#include "tools/learn/train/sample_columns.hpp"
