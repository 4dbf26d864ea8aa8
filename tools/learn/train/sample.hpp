/// One frame of a drive as the trainer sees it: what was known at run time, and how wrong it was.
///
/// Every value is a number; NaN where there is none (a cue that saw nothing, no true plane). Errors are estimate minus
/// truth, of n1 and n3 (parts of the unit normal), ln h, or as named. The true scale turns [vo] into metres.
///
/// Units  n1, n3, ln ratios: 1.  Variances: of the error beside them.
#pragma once

#include <limits>

namespace plumb {

struct Sample {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

  double seq = kNone;
  double time_s = kNone;
  // Truth.
  double true_step_m = kNone;    ///< of this frame
  double true_turn_rad = kNone;  ///< of this frame
  double chord_frames = kNone;   ///< images over which the true scale was taken
  double chord_m = kNone;        ///< true length of that chord
  double truth_ln_std =
      kNone;                 ///< 1-sigma of the true ln scale: jitter of the truth over its chord
  double has_plane = kNone;  ///< 1: height and normal are measured; 0: nominal height, no normal
  double true_height_m = kNone;
  double nominal_height_m = kNone;
  double true_n1 = kNone;
  double true_n3 = kNone;
  // Context.
  double turn_ratio = kNone;  ///< |curvature| times camera height
  double step_ratio = kNone;  ///< step in camera heights
  double speed_m_s = kNone;   ///< true
  // Dense cue. "given": height once the normal is known (the true one, else the filter's).
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
  double dense_given_ref_var = kNone;  ///< of what the reference normal adds to that error
  double dense_hand_var_n1 = kNone;    ///< by FloorCovariance, like every hand_var
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
  double objects_belief = kNone;  ///< variance of n3 by the boxes alone
  double objects_err_n3 = kNone;
  // Direction of travel.
  double travel_chord_ratio = kNone;  ///< chord in camera heights
  double travel_num_frames = kNone;
  double travel_err = kNone;
  double travel_ref = kNone;
  double travel_hand_var = kNone;
  // What was reported, with the deviations of that run.
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
  double out_travel_square = kNone;
  double out_step_err = kNone;  ///< ln of the motion's length
  double out_step_var = kNone;
  double out_move_nees = kNone;  ///< of the translation, 3 degrees of freedom, divided by 3
  double out_turn_nees = kNone;  ///< of the rotation
  // The published method's beliefs (widths of bells, vote) and errors; only when that mode ran.
  double paper_width_height = kNone;
  double paper_width_n1 = kNone;
  double paper_width_n3 = kNone;
  double paper_vote = kNone;
  double paper_err_height = kNone;  ///< [m], as the published models have it
  double paper_err_n1 = kNone;
  double paper_err_n3 = kNone;
  double paper_err_points = kNone;  ///< [m]

  /// The one list of columns: field(name, member).
  template <typename S, typename Field>
  static void visit(S& s, Field&& field);
};

}  // namespace plumb

#include "tools/learn/train/sample_columns.hpp"
