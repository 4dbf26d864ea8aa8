/// When a process that is behind leaves images out, and how much memory it has for them.
#pragma once

#include <cstdint>

namespace plumb {

struct ImageQueueConfig {
  static constexpr int kMaxPixels = 1920 * 1200;

  double max_wait_s = 0.1;
  int max_pixels = kMaxPixels;

  [[nodiscard]] std::int64_t max_wait_us() const {
    return static_cast<std::int64_t>(max_wait_s * 1e6);
  }

  template <typename Config, typename Visit>
  static void visit(Config& c, Visit&& field) {
    field("images.max_wait_s", c.max_wait_s, 0.01, 60.0,
          "plumb-vo and plumb-ground skip an image that waited longer while a newer one waits");
    field("images.max_pixels", c.max_pixels, 64 * 64, kMaxPixels,
          "of the largest image that readers of CAMERA have memory for, 7 times");
  }
};

}  // namespace plumb
