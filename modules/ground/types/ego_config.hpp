/// Settings of the metric motion that EGO_MOTION reports.
#pragma once

#include "core/numbers.hpp"

namespace plumb {

struct EgoConfig {
  double standstill_step_std_m = 1e-3;
  double standstill_turn_std_rad = 1e-5;
  double coast_step_ratio = 0.05;
  double coast_turn_std_rad = 0.1 * kDegree;
  double step_scatter_ratio = 0.01;
  double least_speed_std_m_s = 0.02;
  double jerk_density_m2_s5 = 4.0;
  double start_accel_std_m_s2 = 3.0;
  double most_accel_m_s2 = 6.0;
  double most_brake_m_s2 = 11.0;
  double most_log_scale_std = 0.35;
  double scatter_memory_s = 2.0;

  template <typename Config, typename Visit>
  static void visit(Config& c, Visit&& field) {
    field("ground.ego.standstill_step_std_m", c.standstill_step_std_m, 1e-6, 1.0,
          "1-sigma of the translation of a frame at standstill: vibration");
    field("ground.ego.standstill_turn_std_rad", c.standstill_turn_std_rad, 1e-7, 0.1,
          "1-sigma of the rotation of a frame at standstill");
    field("ground.ego.coast_step_ratio", c.coast_step_ratio, 0.0, 1.0,
          "1-sigma of a predicted translation, as a share of it, per frame of coasting");
    field("ground.ego.coast_turn_std_rad", c.coast_turn_std_rad, 0.0, 0.1,
          "1-sigma of a predicted rotation per frame of coasting");
    field("ground.ego.step_scatter_ratio", c.step_scatter_ratio, 0.0, 1.0,
          "1-sigma of the measured speed, as a share of it; for the acceleration");
    field("ground.ego.least_speed_std_m_s", c.least_speed_std_m_s, 0.0001, 10.0,
          "what is added to it");
    field("ground.ego.jerk_density_m2_s5", c.jerk_density_m2_s5, 0.001, 1000.0,
          "spectral density of the car's jerk: how fast the acceleration may change");
    field("ground.ego.start_accel_std_m_s2", c.start_accel_std_m_s2, 0.01, 100.0,
          "1-sigma of the acceleration before two speeds are known");
    field("ground.ego.most_accel_m_s2", c.most_accel_m_s2, 1.0, 100.0,
          "acceleration of the vehicle beyond which a speed is taken for a loss of VO's unit");
    field("ground.ego.most_brake_m_s2", c.most_brake_m_s2, 1.0, 100.0, "the same for braking");
    field("ground.ego.most_log_scale_std", c.most_log_scale_std, 0.01, 2.0,
          "1-sigma of ln scale above which the scale counts as not known");
    field("ground.ego.scatter_memory_s", c.scatter_memory_s, 0.1, 60.0,
          "time over which the scatter of the speeds is averaged, for their standard deviation");
  }
};

}  // namespace plumb
