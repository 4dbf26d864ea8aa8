#include <gtest/gtest.h>

#include "modules/objects/objects.hpp"
#include "tests/objects/cuboid_scene.hpp"
#include "tests/support/count_malloc.hpp"

namespace plumb {
namespace {

TEST(ObjectsMemory, NothingIsAllocatedAfterConstruction) {
  if (!test::kCountsMallocs) GTEST_SKIP() << "the sanitizer owns malloc";
  static ObjectTracker tracker(DetectionsConfig{}, ObjectsConfig{}, test::kSceneCamera);
  static DetectionFrame frame;
  const RoadPlane plane = test::road(0.002);
  std::size_t num_objects = 0;
  const std::int64_t before = test::g_num_mallocs;
  for (int k = 0; k < 20; ++k) {
    frame = {};
    frame.capture_us = 100'000 * k;
    for (int i = 0; i < 40; ++i) {
      const auto id = i % 2 == 0 ? i : -1;
      const bool held = frame.detections.push_back(
          test::detect(test::car_at(10.0 + 1.3 * i, -12.0 + 0.7 * i, 0.0), plane, id));
      if (!held) break;
    }
    ObjectsInput input;
    input.frame = &frame;
    input.plane = plane;
    input.motion.dt_s = k == 0 ? 0.0 : 0.1;
    num_objects += tracker.update(input).objects.size();
  }
  EXPECT_EQ(test::g_num_mallocs - before, 0);
  EXPECT_GT(num_objects, 300u);
}

}  // namespace
}  // namespace plumb
