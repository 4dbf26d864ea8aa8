/// Settings of the plane filter and of its initialisation: process noise, gates and start values.
///
/// Units:
///   As the names say; `_ratio` of a length is in camera heights; angles of the normal are small,
///   so that their sines and radians are one.
#pragma once

#include "core/numbers.hpp"

namespace plumb {

struct FilterConfig {
  // Process noise.
  double turn_noise_rad = 0.05 * kDegree;
  double curvature_noise_rad = 0.08 * kDegree;
  double scale_drift_std = 0.004;
  double turn_scale_drift_std = 0.01;
  double held_drift_per_s = 0.005;
  double reference_step_ratio = 0.6;
  double largest_noise_steps = 2.0;
  double bend_strength_ratio = 15.0;
  double least_bend_std = 0.05 * kDegree;
  double level_roll_std_rad = 4.5 * kDegree;
  // Gates.
  double student_t_dof = 4.0;
  double scalar_gate = 16.0;
  double plane_gate = 8.0;
  int lock_out_frames = 10;
  double lock_out_ln_std = 0.15;
  // Start values.
  double start_tilt_std_rad = 1.0 * kDegree;
  double start_ln_height_std = 0.1;
  double converged_ln_std = 0.25;
  // What a cue must show to be used.
  double start_dense_quality = 0.8;
  double least_dense_quality = 0.4;
  int start_points = 8;
  int least_points = 4;
  double least_ray_slope = 0.028;
  double shortest_chord_ratio = 0.25;
  // Search for the road's height.
  double settled_ln_std = 0.05;
  double settled_sweep_ln = 0.2;
  double wide_sweep_ln = 0.45;
  double agree_ln_height = 0.03;
  double distinct_ln_height = 0.1;
  double start_misfit_ratio = 0.55;
  double start_misfit = 0.6;
  int start_confirmations = 2;
  double start_doubt_std = 0.05;

  template <typename Config, typename Visit>
  static void visit(Config& c, Visit&& field);
};

template <typename Config, typename Visit>
void visit_process_noise(Config& c, Visit&& field) {
  field("ground.filter.turn_noise_rad", c.turn_noise_rad, 0.0, 0.1,
        "process noise of the normal per image: error of VO's rotation; 1-sigma");
  field("ground.filter.curvature_noise_rad", c.curvature_noise_rad, 0.0, 0.1,
        "the same per reference step: curvature of the road and suspension");
  field("ground.filter.scale_drift_std", c.scale_drift_std, 0.0, 0.5,
        "process noise of ln height per root of a reference step: drift of VO's scale");
  field("ground.filter.turn_scale_drift_std", c.turn_scale_drift_std, 0.0, 0.5,
        "the same per root of a radian turned");
  field("ground.filter.held_drift_per_s", c.held_drift_per_s, 0.0, 1.0,
        "1-sigma of the drift of VO's scale per second while no cue sees the road, until the drive "
        "shows its own");
  field("ground.filter.reference_step_ratio", c.reference_step_ratio, 0.01, 10.0,
        "length of the reference step in camera heights");
  field("ground.filter.largest_noise_steps", c.largest_noise_steps, 0.1, 100.0,
        "largest number of reference steps for which one image adds noise");
  field("ground.filter.bend_strength_ratio", c.bend_strength_ratio, 0.1, 1000.0,
        "distance in camera heights over which the strength of the road's bends is averaged");
  field("ground.filter.least_bend_std", c.least_bend_std, 0.0, 0.1,
        "smallest strength of the road's bends, 1-sigma of n3 ahead against n3 under the car");
  field("ground.filter.level_roll_std_rad", c.level_roll_std_rad, 0.001, 1.0,
        "1-sigma of the car's roll against its road; keeps roll bounded when no cue measures it");
}

template <typename Config, typename Visit>
void visit_gates(Config& c, Visit&& field) {
  field("ground.filter.student_t_dof", c.student_t_dof, 1.0, 1000.0,
        "degrees of freedom of the innovations' Student-t distribution; large: Gaussian");
  field("ground.filter.scalar_gate", c.scalar_gate, 1.0, 1000.0,
        "squared innovation over its variance above which a scalar observation is rejected");
  field("ground.filter.plane_gate", c.plane_gate, 1.0, 1000.0,
        "the same for an observation of the whole plane, per degree of freedom");
  field("ground.filter.lock_out_frames", c.lock_out_frames, 1, 1000,
        "images in a row with every height rejected after which the gate opens again");
  field("ground.filter.lock_out_ln_std", c.lock_out_ln_std, 0.0, 2.0,
        "1-sigma of ln height that is then added");
}

template <typename Config, typename Visit>
void visit_start(Config& c, Visit&& field) {
  field("ground.filter.start_tilt_std_rad", c.start_tilt_std_rad, 0.0001, 0.5,
        "1-sigma of the first normal");
  field("ground.filter.start_ln_height_std", c.start_ln_height_std, 0.001, 2.0,
        "1-sigma of the first ln height");
  field("ground.filter.converged_ln_std", c.converged_ln_std, 0.001, 2.0,
        "1-sigma of ln height below which the filter has converged");
  field("ground.filter.start_dense_quality", c.start_dense_quality, 0.0, 1.0,
        "least correlation of the dense cue until the filter has converged");
  field("ground.filter.least_dense_quality", c.least_dense_quality, 0.0, 1.0,
        "the same afterwards, and for heights that agree in the search of the start");
  field("ground.filter.start_points", c.start_points, 2, 1000,
        "least number of agreeing road points that start the filter");
  field("ground.filter.least_points", c.least_points, 2, 1000, "the same afterwards");
  field("ground.filter.least_ray_slope", c.least_ray_slope, 0.0, 0.5,
        "y/z of a road point below which it is too near to the horizon");
  field("ground.filter.shortest_chord_ratio", c.shortest_chord_ratio, 0.01, 10.0,
        "camera heights between the images of a chord below which nothing is measured");
  field("ground.filter.settled_ln_std", c.settled_ln_std, 0.0, 2.0,
        "1-sigma of ln height below which the dense cue searches the narrow range of heights");
  field("ground.filter.settled_sweep_ln", c.settled_sweep_ln, 0.01, 1.0,
        "half of the narrow range, in ln height");
  field("ground.filter.wide_sweep_ln", c.wide_sweep_ln, 0.01, 1.0, "half of the wide range");
  field(
      "ground.filter.agree_ln_height", c.agree_ln_height, 0.001, 0.5,
      "largest difference of ln height between two results that agree in the search of the start");
  field("ground.filter.distinct_ln_height", c.distinct_ln_height, 0.01, 1.0,
        "difference of ln height above which two results of that search contradict each other");
  field("ground.filter.start_misfit_ratio", c.start_misfit_ratio, 0.01, 1.0,
        "the filter starts when the best height leaves at most this share of the misfit that the "
        "best contradicting one leaves");
  field("ground.filter.start_misfit", c.start_misfit, 0.01, 1.0,
        "and at most this share of what moved in the images");
  field(
      "ground.filter.start_confirmations", c.start_confirmations, 1, 100,
      "images with a measured height after a start, itself among them, before the scale is known");
  field("ground.filter.start_doubt_std", c.start_doubt_std, 0.0, 1.0,
        "1-sigma of ln scale on top of the filter's at a start or a new unit; a half after a tenth "
        "of a "
        "second in which heights are measured, a third after two");
}

template <typename Config, typename Visit>
void FilterConfig::visit(Config& c, Visit&& field) {
  visit_process_noise(c, field);
  visit_gates(c, field);
  visit_start(c, field);
}

}  // namespace plumb
