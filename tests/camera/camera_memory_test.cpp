/// Checks that the camera library allocates nothing after construction. This is a separate program
/// because it replaces malloc.
#include <gtest/gtest.h>

#include "modules/camera/convert.hpp"
#include "modules/camera/front_end.hpp"
#include "modules/camera/pacing.hpp"
#include "tests/camera/pattern.hpp"
#include "tests/support/count_malloc.hpp"

namespace plumb {
namespace {

TEST(CameraMemory, NoFrameAllocates) {
  if (!test::kCountsMallocs) GTEST_SKIP() << "the sanitizer owns malloc";
  constexpr int kWidth = 640;
  constexpr int kHeight = 360;
  CameraConfig config;
  config.fx_px = config.fy_px = 420.0;
  config.cx_px = 320.0;
  config.cy_px = 180.0;
  config.k1 = -0.3;
  config.k2 = 0.1;
  config.mask_polygon = "0,360 200,300 440,300 640,360";
  const cv::Mat packed = test::noise(kHeight, 2 * kWidth, 31);
  std::vector<std::uint8_t> grey(static_cast<std::size_t>(kWidth * kHeight));
  std::vector<std::uint8_t> published(grey.size());
  const auto before_construction = test::g_num_mallocs.load();
  FrontEnd front_end(config, kWidth, kHeight, nullptr);
  Pacer pacer(1.0);
  SequenceTracker tracker;
  NullProbe probe;
  ASSERT_GT(test::g_num_mallocs.load(), before_construction);  // shows that the counter works

  const auto before = test::g_num_mallocs.load();
  for (std::uint32_t i = 0; i < 20; ++i) {
    yuyv_to_grey(packed.data, kWidth, kHeight, 2 * kWidth, grey.data());
    grey[0] = static_cast<std::uint8_t>(i);
    (void)front_end.process({grey.data(), kWidth, kHeight, kWidth}, published.data(), &probe);
    (void)pacer.due_us(i, i);
    (void)tracker.next(i);
  }
  EXPECT_EQ(test::g_num_mallocs.load(), before);
}

}  // namespace
}  // namespace plumb
