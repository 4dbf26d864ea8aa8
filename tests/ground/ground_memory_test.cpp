/// Checks that the ground library allocates nothing after construction, and little during it. This
/// is a separate program because it replaces malloc.
#include <gtest/gtest.h>

#include "modules/ground/ground.hpp"
#include "tests/ground/road_scene.hpp"
#include "tests/support/count_malloc.hpp"
#include "tests/support/heap_bytes.hpp"

namespace plumb {
namespace {

TEST(GroundMemory, NoFrameAllocates) {
  if (!test::kCountsMallocs) GTEST_SKIP() << "the sanitizer owns malloc";
  const CameraModel camera = test::scene_camera();
  test::Drive drive;
  drive.turn_left_rad = 0.02;
  const std::vector<Se3> poses = drive.poses(24);
  std::vector<test::GreyImage> images;
  std::vector<VoOutput> vo(poses.size());
  for (std::size_t k = 0; k < poses.size(); ++k) {
    images.push_back(test::render(camera, poses[k], {}, 1));
    test::script_vo(poses, static_cast<int>(k), {}, &vo[k]);
  }
  vo[15].scale_epoch = 1;  // another unit from here on
  for (std::size_t k = 15; k < vo.size(); ++k) vo[k].scale_epoch = 1;
  vo[20].status = VoStatus::kStandstill;
  vo[21].status = VoStatus::kCoasting;
  vo[22].status = VoStatus::kLost;

  const auto before_construction = test::g_num_mallocs.load();
  GroundEstimator estimator(GroundConfig{}, camera);
  NullProbe probe;
  ASSERT_GT(test::g_num_mallocs.load(), before_construction);  // shows that the counter works
  const auto before = test::g_num_mallocs.load();
  for (std::size_t k = 0; k < poses.size(); ++k) {
    (void)estimator.update({&vo[k], images[k].view()}, probe);
  }
  EXPECT_EQ(test::g_num_mallocs.load(), before);
}

TEST(GroundMemory, OwnsLessThan16MegabytesAtFullSize) {
  if (!test::kCountsMallocs) GTEST_SKIP() << "the sanitizer owns malloc";
  const CameraModel camera{1242, 375, 721.5, 721.5, 609.6, 172.9, 0.0, 0.0, 1.65};
  const std::size_t before = test::heap_bytes();
  const GroundEstimator estimator(GroundConfig{}, camera);
  const std::size_t owned = test::heap_bytes() - before;
  EXPECT_GT(owned, std::size_t{1} << 20U);  // shows that the counter works
  EXPECT_LT(owned, std::size_t{16} << 20U);
}

}  // namespace
}  // namespace plumb
