/// Limits of a road vehicle; visit() is the one list of keys, ranges and meanings.
#pragma once

namespace plumb {

struct PlausibilityConfig {
  double max_speed_m_s = 75.0;
  double max_accel_m_s2 = 12.0;
  double max_sustained_accel_m_s2 = 4.0;
  double max_yaw_rate_rad_s = 1.6;
  double max_yaw_accel_rad_s2 = 6.0;
  double max_lateral_accel_m_s2 = 12.0;
  double min_height_m = 0.3;
  double max_height_m = 5.0;
  double max_pitch_rad = 0.25;
  double max_roll_rad = 0.25;
  double max_tilt_rate_rad_s = 0.8;
  double max_scale_rate_hz = 0.3;
  double min_interval_s = 0.004;
  double max_interval_s = 1.0;
  int recover_images = 3;
  double reestablish_s = 1.2;

  template <typename Config, typename Visit>
  static void visit(Config& c, Visit&& field) {
    field("vehicle.max_speed_m_s", c.max_speed_m_s, 5.0, 150.0, "no faster, either direction");
    field("vehicle.max_accel_m_s2", c.max_accel_m_s2, 2.0, 30.0,
          "change of speed between two images, and the acceleration itself");
    field("vehicle.max_sustained_accel_m_s2", c.max_sustained_accel_m_s2, 1.0, 30.0,
          "change of speed while it was not believed");
    field("vehicle.max_yaw_rate_rad_s", c.max_yaw_rate_rad_s, 0.2, 6.0, "no faster turn");
    field("vehicle.max_yaw_accel_rad_s2", c.max_yaw_accel_rad_s2, 0.5, 50.0,
          "change of the yaw rate");
    field("vehicle.max_lateral_accel_m_s2", c.max_lateral_accel_m_s2, 2.0, 30.0,
          "speed times yaw rate");
    field("vehicle.min_height_m", c.min_height_m, 0.1, 5.0, "camera above the road");
    field("vehicle.max_height_m", c.max_height_m, 0.2, 10.0, "camera above the road");
    field("vehicle.max_pitch_rad", c.max_pitch_rad, 0.02, 0.8, "camera against the road");
    field("vehicle.max_roll_rad", c.max_roll_rad, 0.02, 0.8, "camera against the road");
    field("vehicle.max_tilt_rate_rad_s", c.max_tilt_rate_rad_s, 0.1, 10.0,
          "change of pitch and roll");
    field("vehicle.max_scale_rate_hz", c.max_scale_rate_hz, 0.02, 10.0,
          "change per second of the logarithm of the scale and of the height");
    field("vehicle.min_interval_s", c.min_interval_s, 0.0005, 0.1, "between two images");
    field("vehicle.max_interval_s", c.max_interval_s, 0.1, 10.0, "between two images");
    field("vehicle.recover_images", c.recover_images, 1, 20,
          "images in a row that agree with what was believed before a signal is valid again");
    field("vehicle.reestablish_s", c.reestablish_s, 0.2, 10.0,
          "values that only agree among themselves are believed after this time");
  }
};

}  // namespace plumb
