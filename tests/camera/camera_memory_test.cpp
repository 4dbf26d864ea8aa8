/// The camera library takes no memory after construction. A program of its own: it replaces new.
#include <gtest/gtest.h>

#include <cstdlib>
#include <new>

#include "modules/camera/convert.hpp"
#include "modules/camera/front_end.hpp"
#include "modules/camera/pacing.hpp"
#include "tests/camera/pattern.hpp"

namespace {
long g_num_new = 0;
}

[[gnu::noinline]] void* operator new(std::size_t bytes) {
  ++g_num_new;
  void* memory = std::malloc(bytes);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t /*bytes*/) noexcept { std::free(memory); }

namespace plumb {
namespace {

TEST(CameraMemory, NoFrameAllocates) {
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
  const long before_construction = g_num_new;
  FrontEnd front_end(config, kWidth, kHeight, nullptr);
  Pacer pacer(1.0);
  SequenceTracker tracker;
  NullProbe probe;
  ASSERT_GT(g_num_new, before_construction);  // the counter works

  const long before = g_num_new;
  for (std::uint32_t i = 0; i < 20; ++i) {
    yuyv_to_grey(packed.data, kWidth, kHeight, 2 * kWidth, grey.data());
    grey[0] = static_cast<std::uint8_t>(i);
    (void)front_end.process({grey.data(), kWidth, kHeight, kWidth}, published.data(), &probe);
    (void)pacer.due_us(i, i);
    (void)tracker.next(i);
  }
  EXPECT_EQ(g_num_new, before);
}

}  // namespace
}  // namespace plumb
