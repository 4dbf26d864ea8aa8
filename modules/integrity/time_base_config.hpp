/// Every setting of the judge of time stamps; visit() is the one list of keys, ranges and meanings.
#pragma once

namespace plumb {

struct TimeBaseConfig {
  int agreeing_images = 3;
  double min_interval_s = 0.004;
  double max_interval_s = 1.0;
  double jitter_s = 0.004;
  int reorder_images = 16;

  template <typename Config, typename Visit>
  static void visit(Config& c, Visit&& field) {
    field("time.agreeing_images", c.agreeing_images, 2, 20,
          "images in a row that agree among themselves make a time base");
    field("time.min_interval_s", c.min_interval_s, 0.0005, 0.1,
          "images of one camera are never closer together");
    field("time.max_interval_s", c.max_interval_s, 0.1, 10.0,
          "images with consecutive numbers are never further apart");
    field("time.jitter_s", c.jitter_s, 0.0005, 0.05,
          "a stamp that is off the expected time by less is jitter; a camera that jitters more is "
          "learned");
    field("time.reorder_images", c.reorder_images, 1, 32,
          "images that arrive late by up to as many numbers are out of order, not a second pass");
  }
};

}  // namespace plumb
