/// Tests that the odometry allocates nothing after construction, in every state.
#include <gtest/gtest.h>

#include "tests/support/count_malloc.hpp"
#include "tests/support/heap_bytes.hpp"
#include "tests/vo/drive_fixture.hpp"

namespace plumb {
namespace {

TEST(Memory, NothingIsAllocatedOverADriveWithEveryMishap) {
  if (!test::kCountsMallocs) GTEST_SKIP() << "the sanitizer owns malloc";
  const CameraModel camera = test::scene_camera();
  const test::Scene scene(camera);
  std::vector<test::RenderedImage> images;
  for (const Se3& T : test::drive(24, 0.8, 0.01)) images.push_back(scene.render(T, 1.0, 1));
  images.emplace_back(std::vector<std::uint8_t>(620 * 188, 0), 620, 188);          // dark
  for (unsigned i = 0; i < 3; ++i) images.push_back(scene.render(Se3{}, 1.0, i));  // lost, restarts
  for (const Se3& T : test::drive(12, 0.7)) images.push_back(scene.render(T, 1.0, 3));
  for (unsigned i = 0; i < 3; ++i) images.push_back(images.back());  // frozen

  VisualOdometry odometry(test::Drive::config(), camera, 1);
  NullProbe probe;
  const std::int64_t before = test::g_num_mallocs;
  int num_ok = 0;
  int num_coasting = 0;
  std::int32_t epochs = 0;
  for (std::size_t i = 0; i < images.size(); ++i) {
    const auto seq = static_cast<std::int64_t>(i);
    const VoOutput& out = odometry.update(
        {.capture_us = 100'000 * (seq + 1),
         .seq = seq,
         .image = images[i].view(),
         .is_discontinuous = i + 8 == images.size(),
         .unusable = i + 3 >= images.size() ? VoReason::kImageFrozen : VoReason::kNone},
        probe);
    if (out.status == VoStatus::kOk) ++num_ok;
    if (out.status == VoStatus::kCoasting) ++num_coasting;
    epochs = out.scale_epoch;
  }
  EXPECT_EQ(test::g_num_mallocs - before, 0);
  EXPECT_GT(num_ok, 20);
  EXPECT_GT(num_coasting, 1);
  EXPECT_EQ(epochs, 2);
}

TEST(Memory, OwnsLessThan16MegabytesAtFullSize) {
  if (!test::kCountsMallocs) GTEST_SKIP() << "the sanitizer owns malloc";
  const CameraModel camera{1242, 375, 721.5, 721.5, 609.6, 172.9, 0.0, 0.0, 1.65};
  const std::size_t before = test::heap_bytes();
  const VisualOdometry odometry(VoConfig{}, camera, 1);
  const std::size_t owned = test::heap_bytes() - before;
  EXPECT_GT(owned, std::size_t{1} << 20U);  // the counter works
  EXPECT_LT(owned, std::size_t{16} << 20U);
}

}  // namespace
}  // namespace plumb
