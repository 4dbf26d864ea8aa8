// Checks that decode, from_wire, to_wire and encode do not allocate.
#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "modules/camera/image_wire.hpp"
#include "modules/ground/ground_wire.hpp"
#include "modules/ground/pending_images.hpp"
#include "modules/vo/vo_wire.hpp"
#include "platform/bus.hpp"
#include "platform/health.hpp"
#include "tests/support/count_malloc.hpp"
#include "tests/wire/sample_output.hpp"

namespace plumb {
namespace {

// Number of allocations in the second run of `work`; the first may allocate once.
template <typename Work>
std::int64_t allocations_of(Work work) {
  work();
  const std::int64_t before = test::g_num_mallocs;
  for (int i = 0; i < 100; ++i) work();
  return test::g_num_mallocs - before;
}

class WireMemory : public testing::Test {
 protected:
  void SetUp() override {
    if (!test::kCountsMallocs) GTEST_SKIP() << "the sanitizer owns malloc";
  }
  Counters counters_;
  Bus bus_{"memq://", &counters_};
};

TEST_F(WireMemory, TheCounterCounts) {
  EXPECT_EQ(100, allocations_of([] { ::operator delete(::operator new(4)); }));
}

TEST_F(WireMemory, AVoMotionIsEncodedAndDecodedInPlace) {
  Publisher<vo_motion_t> out(bus_, kVoMotion);
  const VoOutput output = test::sample_vo_output();
  static vo_motion_t message;
  static vo_motion_t received;
  static VoOutput back;
  EXPECT_EQ(0, allocations_of([&] {
              to_wire(output, &message);
              const auto bytes = out.encode(message);
              ASSERT_TRUE(decode_bounded(bytes, &received));
              ASSERT_EQ(nullptr, from_wire(received, &back));
            }));
}

TEST_F(WireMemory, GroundMessagesAreEncodedAndDecodedInPlace) {
  Publisher<ground_plane_t> plane_out(bus_, kGroundPlane);
  Publisher<ego_motion_t> ego_out(bus_, kEgoMotion);
  const GroundOutput output = test::sample_ground_output();
  ground_plane_t plane{};
  ego_motion_t ego{};
  GroundOutput back;
  EXPECT_EQ(0, allocations_of([&] {
              to_wire(output, &plane);
              to_wire(output, &ego);
              ASSERT_TRUE(decode_bounded(plane_out.encode(plane), &plane));
              ASSERT_TRUE(decode_bounded(ego_out.encode(ego), &ego));
              ASSERT_EQ(nullptr, from_wire(plane, ego, &back));
            }));
}

TEST_F(WireMemory, AGreyImageIsEncodedReadAndKeptInPlace) {
  constexpr int kWidth = 640;
  constexpr int kHeight = 200;
  const std::vector<std::uint8_t> pixels(kWidth * kHeight, 7);
  Publisher<image_t> out(bus_, kCamera, max_image_bytes(pixels.size()));
  image_t message{};
  ImageDecoder decoder(kWidth, kHeight);
  PendingImages pending(kWidth, kHeight, 8);
  EXPECT_EQ(0, allocations_of([&] {
              to_wire(1, 2, {pixels.data(), kWidth, kHeight, kWidth}, &message);
              ImageFrame frame;
              ImageView view;
              ASSERT_EQ(nullptr, read_image(out.encode(message), &frame));
              ASSERT_EQ(nullptr, decoder.decode(frame, &view));
              ASSERT_TRUE(pending.put(frame));
              ASSERT_NE(nullptr, pending.find(2, 1));
            }));
}

TEST_F(WireMemory, AColourJpegIsDecodedInPlace) {
  constexpr int kWidth = 1921;
  constexpr int kHeight = 203;
  cv::Mat image(kHeight, kWidth, CV_8UC3);
  cv::randu(image, 0, 255);
  std::vector<std::uint8_t> jpeg;
  cv::imencode(".jpg", image, jpeg);
  ImageDecoder decoder(kWidth, kHeight);
  ImageFrame frame;
  frame.width_px = kWidth;
  frame.height_px = kHeight;
  frame.compressed = true;
  frame.data = jpeg;
  EXPECT_EQ(0, allocations_of([&] {
              ImageView view;
              ASSERT_EQ(nullptr, decoder.decode(frame, &view));
            }));
}

TEST_F(WireMemory, HealthIsReportedInPlace) {
  StageTimer timer;
  Health health("test");
  Publisher<process_health_t> out(bus_, kHealthVo, Health::kMaxBytes);
  std::int64_t now_us = 0;
  EXPECT_EQ(0, allocations_of([&] {
              timer.begin();
              timer.mark("a stage with a name too long for the small-string buffer");
              timer.end();
              counters_.reject("a reason too long for the small-string buffer of std::string");
              const auto bytes =
                  out.encode(health.report(now_us += 500'000, counters_, bus_, timer));
              ASSERT_FALSE(bytes.empty());
            }));
}

}  // namespace
}  // namespace plumb
