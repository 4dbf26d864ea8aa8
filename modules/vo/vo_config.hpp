/// Every setting of plumb-vo; visit() is the one list of keys, ranges and meanings.
#pragma once

#include <string>

namespace plumb {

struct VoConfig {
  int max_tracks = 500;

  template <typename Config, typename Visit>
  static void visit(Config& c, Visit&& field) {
    field("vo.max_tracks", c.max_tracks, 64, 2000, "features tracked at once");
  }
};

}  // namespace plumb
