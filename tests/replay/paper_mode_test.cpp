/// Tests the published method in the chain. The configuration chooses it, and it gives the same
/// messages and statuses.
#include <gtest/gtest.h>

#include <cmath>

#include "modules/ground/ground.hpp"
#include "tests/replay/street_log.hpp"

namespace plumb {
namespace {

struct Counter final : CanSink {
  int num_frames = 0;
  void send(std::int64_t /*time_us*/, const CanFrame& /*frame*/) override { ++num_frames; }
};

TEST(PaperMode, FollowsARenderedDriveThroughTheWholeChain) {
  PlumbConfig config;
  config.ground_mode = "paper";
  Counter can;
  double x_m = 0.0, z_m = 0.0;
  int num_ok = 0;
  Chain* running = nullptr;
  Chain replay(config, 1, &can, [&](const FrameRecord& record) {
    ASSERT_NE(record.plane, nullptr);
    ASSERT_NE(record.ego, nullptr);
    EXPECT_EQ(record.refused, nullptr);
    if (record.plane->status == ground_plane_t::STATUS_OK) {
      ++num_ok;
      EXPECT_NEAR(record.plane->height_m, 1.65, 0.25) << "frame " << record.seq;
      // Fields that the messages lack are read from the node itself.
      const GroundOutput* output = running->ground().output();
      ASSERT_NE(output, nullptr);
      EXPECT_EQ(output->seq, record.seq);
      EXPECT_EQ(output->plane.cues[kCueDense].num_features, 3);
      EXPECT_EQ(running->ground().diagnostics(), nullptr);
    }
    x_m = record.ego->t_world_cam_m[0];
    z_m = record.ego->t_world_cam_m[2];
  });
  running = &replay;
  for (const test::StoredEvent& event : test::street_events()) replay.take(event.view());
  replay.finish();
  const Eigen::Vector3d truth =
      (test::street_drive().front().inverse() * test::street_drive().back()).t;
  EXPECT_GT(num_ok, 28);
  EXPECT_NEAR(std::hypot(x_m - truth.x(), z_m - truth.z()), 0.0, 0.06 * truth.norm());
  EXPECT_GT(can.num_frames, 100);
}

}  // namespace
}  // namespace plumb
