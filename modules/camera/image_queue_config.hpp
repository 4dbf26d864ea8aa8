/// When a process that is behind leaves images out.
#pragma once

#include <cstdint>

namespace plumb {

struct ImageQueueConfig {
  double max_wait_s = 0.1;

  [[nodiscard]] std::int64_t max_wait_us() const {
    return static_cast<std::int64_t>(max_wait_s * 1e6);
  }

  template <typename Config, typename Visit>
  static void visit(Config& c, Visit&& field) {
    field("images.max_wait_s", c.max_wait_s, 0.01, 60.0,
          "plumb-vo and plumb-ground skip an image that waited longer while a newer one waits");
  }
};

}  // namespace plumb
