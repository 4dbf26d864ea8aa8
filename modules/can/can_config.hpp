/// Every setting of plumb-can; visit() is the one list of keys, ranges and meanings.
/// Identifiers, cycle times and scalings are not settings: config/plumbline.dbc states them.
#pragma once

namespace plumb {

struct CanConfig {
  double stale_s = 0.3;
  double pair_wait_s = 0.1;

  template <typename Config, typename Visit>
  static void visit(Config& c, Visit&& field) {
    field("can.stale_s", c.stale_s, 0.05, 5.0,
          "age of a frame's values from which on they are sent as not available");
    field("can.pair_wait_s", c.pair_wait_s, 0.01, 1.0,
          "wait for the other one of GROUND_PLANE and EGO_MOTION of the same frame");
  }
};

}  // namespace plumb
