/// Checks that no message allocates memory on its way to the bus. This is a separate program
/// because it replaces malloc.
#include <gtest/gtest.h>

#include <string>

#include "modules/can/can_wire.hpp"
#include "tests/support/count_malloc.hpp"

namespace plumb {
namespace {

class CountingSink final : public CanSink {
 public:
  std::int64_t num_frames = 0;
  void send(std::int64_t /*time_us*/, const CanFrame& /*frame*/) override { ++num_frames; }
};

TEST(CanMemory, NothingIsAllocatedAfterConstruction) {
  if (!test::kCountsMallocs) GTEST_SKIP() << "the sanitizer owns malloc";
  CanOutput output{CanConfig{}};
  CountingSink sink;
  ground_plane_t plane{};
  ego_motion_t ego{};
  plane.height_m = 1.65;
  ego.q_world_cam[0] = 1.0;
  objects_t objects{};
  objects.num_objects = 20;
  objects.objects.resize(20);
  for (int i = 0; i < 20; ++i)
    objects.objects[static_cast<std::size_t>(i)].position_ground_m[0] = 50.0 - i;
  mount_t mount{};
  plane.num_cues = ground_plane_t::MAX_CUES;
  plane.cues.resize(ground_plane_t::MAX_CUES);
  const std::int64_t before = test::g_num_mallocs;
  for (int i = 0; i < 10'000; ++i) {
    plane.seq = ego.seq = i % 50 == 0 ? i + 7 : i;
    plane.session = ego.session = i / 1000 + i % 3;  // some are refused
    plane.utime = ego.utime = i * 20'000;
    plane.capture_mono_us = ego.capture_mono_us = objects.capture_mono_us = i * 20'000 - 1'000;
    ego.velocity_ground_m_s[0] = i % 40;                  // some are not plausible
    plane.status = static_cast<std::int8_t>(i / 10 % 5);  // 4 is rejected
    ego.status = static_cast<std::int8_t>(i / 10 % 7);    // 6 is rejected
    output.advance(i * 20'000, sink);
    output.on_ground_plane(plane, i * 20'000);
    output.on_ego_motion(ego, i * 20'000);
    mount.status = static_cast<std::int8_t>(i / 10 % 5);  // 4 is rejected
    output.on_mount(mount, i * 20'000);
    objects.seq = i;
    EXPECT_EQ(output.on_objects(objects, i * 20'000), nullptr);
  }
  output.finish(sink);
  EXPECT_EQ(test::g_num_mallocs, before);
  EXPECT_GT(output.num_rejected(), 0);
  EXPECT_GT(output.num_implausible(), 0);
  EXPECT_GT(output.counters().num_frames, 1'000);
  EXPECT_GT(sink.num_frames, 300'000);

  const std::string text(100, static_cast<char>(sink.num_frames));  // shows that the counter works
  EXPECT_GT(test::g_num_mallocs, before);
}

}  // namespace
}  // namespace plumb
