#include <gtest/gtest.h>

#include <random>

#include "modules/ground/cues/objects_pitch.hpp"
#include "tests/detections/road_scene.hpp"
#include "tests/support/count_malloc.hpp"

namespace plumb {
namespace {

/// Four neighbours with candidates overlap, so that the largest mixture is fitted, too.
DetectionFrame crowded(int k) {
  std::vector<test::SceneObject> cars = test::six_cars();
  for (int i = 0; i < 4; ++i) cars.push_back({10 + i, 25.0 + 0.2 * i, 5.0 + 0.3 * i});
  DetectionFrame frame = test::seen(cars, test::road(0.005), 100'000 * k);
  std::mt19937 random(static_cast<unsigned>(k));
  std::normal_distribution<double> normal(0.0, 2.0);
  for (Detection& d : frame.detections) {
    d.occluded = Occlusion::kVisible;
    for (std::size_t i = 0; i < kMaxCandidates; ++i) {
      Candidate candidate{d.box, 0.5};
      candidate.box.top_px += normal(random);
      candidate.box.bottom_px += normal(random);
      EXPECT_TRUE(d.candidates.push_back(candidate));
    }
  }
  return frame;
}

TEST(ObjectsPitchMemory, NothingIsAllocatedAfterConstruction) {
  if (!test::kCountsMallocs) GTEST_SKIP() << "the sanitizer owns malloc";
  static ObjectsPitch cue(DetectionsConfig{}, test::kSceneCamera);
  static DetectionFrame frames[20];
  for (int k = 0; k < 20; ++k) frames[k] = crowded(k);
  int num_used = 0;
  const std::int64_t before = test::g_num_mallocs;
  for (const DetectionFrame& frame : frames) {
    ObjectsPitchInput input;
    input.frame = &frame;
    input.height_m = 1.65;
    num_used += cue.update(input).num_used;
  }
  EXPECT_EQ(test::g_num_mallocs - before, 0);
  EXPECT_GT(num_used, 100);
}

TEST(ObjectsPitchMemory, TheCounterCounts) {
  if (!test::kCountsMallocs) GTEST_SKIP() << "the sanitizer owns malloc";
  const std::int64_t before = test::g_num_mallocs;
  void* volatile block = ::operator new(4096);
  EXPECT_GT(test::g_num_mallocs - before, 0);
  ::operator delete(block);
}

}  // namespace
}  // namespace plumb
