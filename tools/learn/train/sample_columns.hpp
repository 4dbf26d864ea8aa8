/// Lists the columns of a sample file, in order. This file is a part of sample.hpp.
#pragma once

#include <string>

#include "tools/learn/train/sample.hpp"

namespace plumb {

template <typename Cue, typename Field>
void visit_cue(const std::string& name, Cue& cue, Field&& field) {
  field((name + "_status").c_str(), cue.status);
  field((name + "_quality").c_str(), cue.quality);
  field((name + "_innovation_n1").c_str(), cue.innovation_n1);
  field((name + "_innovation_n3").c_str(), cue.innovation_n3);
  field((name + "_innovation_ln_height").c_str(), cue.innovation_ln_height);
  field((name + "_test_ratio").c_str(), cue.test_ratio);
}

template <typename S, typename Field>
void visit_truth(S& s, Field&& field) {
  field("seq", s.seq);
  field("time_s", s.time_s);
  field("true_step_m", s.true_step_m);
  field("true_turn_rad", s.true_turn_rad);
  field("chord_frames", s.chord_frames);
  field("chord_m", s.chord_m);
  field("truth_ln_std", s.truth_ln_std);
  field("has_plane", s.has_plane);
  field("true_height_m", s.true_height_m);
  field("nominal_height_m", s.nominal_height_m);
  field("true_n1", s.true_n1);
  field("true_n3", s.true_n3);
  field("turn_ratio", s.turn_ratio);
  field("step_ratio", s.step_ratio);
  field("speed_m_s", s.speed_m_s);
}

template <typename S, typename Field>
void visit_dense(S& s, Field&& field) {
  field("dense_used", s.dense_used);
  field("dense_ncc", s.dense_ncc);
  field("dense_sad", s.dense_sad);
  field("dense_still_ncc", s.dense_still_ncc);
  field("dense_sigma_grey", s.dense_sigma_grey);
  field("dense_num_pixels", s.dense_num_pixels);
  field("dense_pixel_var_n1", s.dense_pixel_var_n1);
  field("dense_pixel_var_n3", s.dense_pixel_var_n3);
  field("dense_pixel_var_height", s.dense_pixel_var_height);
  field("dense_pixel_var_given", s.dense_pixel_var_given);
  field("dense_slope_n1", s.dense_slope_n1);
  field("dense_slope_n3", s.dense_slope_n3);
  field("dense_err_n1", s.dense_err_n1);
  field("dense_err_n3", s.dense_err_n3);
  field("dense_err_height", s.dense_err_height);
  field("dense_err_given", s.dense_err_given);
  field("dense_given_ref_var", s.dense_given_ref_var);
  field("dense_hand_var_n1", s.dense_hand_var_n1);
  field("dense_hand_var_n3", s.dense_hand_var_n3);
  field("dense_hand_var_height", s.dense_hand_var_height);
  field("dense_hand_var_given", s.dense_hand_var_given);
}

template <typename S, typename Field>
void visit_points_and_objects(S& s, Field&& field) {
  field("points_used", s.points_used);
  field("points_num_candidates", s.points_num_candidates);
  field("points_num_inliers", s.points_num_inliers);
  field("points_score", s.points_score);
  field("points_spread", s.points_spread);
  field("points_slope_n3", s.points_slope_n3);
  field("points_err", s.points_err);
  field("points_ref_var", s.points_ref_var);
  field("points_hand_var", s.points_hand_var);
  field("objects_confidence", s.objects_confidence);
  field("objects_err_n3", s.objects_err_n3);
}

template <typename S, typename Field>
void visit_chord(S& s, Field&& field) {
  field("chord_ratio", s.chord_ratio);
  field("chord_num_frames", s.chord_num_frames);
  field("chord_err", s.chord_err);
  field("chord_ref", s.chord_ref);
  field("chord_hand_var", s.chord_hand_var);
}

template <typename S, typename Field>
void visit_output(S& s, Field&& field) {
  field("out_scale_err", s.out_scale_err);
  field("out_scale_var", s.out_scale_var);
  field("out_scale_bias_var", s.out_scale_bias_var);
  field("out_height_err", s.out_height_err);
  field("out_height_var", s.out_height_var);
  field("out_height_added_var", s.out_height_added_var);
  field("out_pitch_err", s.out_pitch_err);
  field("out_pitch_var", s.out_pitch_var);
  field("out_pitch_added_var", s.out_pitch_added_var);
  field("out_roll_err", s.out_roll_err);
  field("out_roll_var", s.out_roll_var);
  field("out_roll_added_var", s.out_roll_added_var);
  field("out_dense_n1_square", s.out_dense_n1_square);
  field("out_dense_n3_square", s.out_dense_n3_square);
  field("out_chord_square", s.out_chord_square);
  field("out_step_err", s.out_step_err);
  field("out_step_var", s.out_step_var);
  field("out_move_nees", s.out_move_nees);
  field("out_turn_nees", s.out_turn_nees);
}

template <typename S, typename Field>
void visit_paper(S& s, Field&& field) {
  field("paper_width_height", s.paper_width_height);
  field("paper_width_n1", s.paper_width_n1);
  field("paper_width_n3", s.paper_width_n3);
  field("paper_vote", s.paper_vote);
  field("paper_err_height", s.paper_err_height);
  field("paper_err_n1", s.paper_err_n1);
  field("paper_err_n3", s.paper_err_n3);
  field("paper_err_points", s.paper_err_points);
}

template <typename S, typename Field>
void Sample::visit(S& s, Field&& field) {
  visit_truth(s, field);
  visit_dense(s, field);
  visit_points_and_objects(s, field);
  visit_chord(s, field);
  visit_output(s, field);
  visit_paper(s, field);
  for (std::size_t i = 0; i < kNumCues; ++i)
    visit_cue(std::string("cue_") + kCueTable[i].name, s.cues[i], field);
}

}  // namespace plumb
