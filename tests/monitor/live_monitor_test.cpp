/// The monitor on a bus of its own: what it shows is what the bus carried, and it says nothing.
#include "tools/monitor/live_monitor.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <thread>

#include "core/channels.hpp"
#include "platform/clock.hpp"
#include "tests/monitor/web_client.hpp"
#include "tests/support/private_network.hpp"

namespace plumb {
namespace {

using nlohmann::json;
using test::WebClient;

/// Runs the monitor in the test's thread, and `act` in another one, until `act` is done.
template <typename Act>
void watch_while(const LiveOptions& options, Act act) {
  if (!test::enter_private_network()) GTEST_SKIP() << test::kNoPrivateNetwork;
  block_stop_signals();
  EventLoop loop;
  LiveMonitor monitor(options, PlumbConfig{});
  WebServer server({"127.0.0.1", 0, -1}, {}, &monitor);
  std::thread actor([&] {
    act(server.port());
    ::kill(::getpid(), SIGTERM);
  });
  monitor.run(&loop, &server);
  actor.join();
}

image_t grey_image(std::int64_t seq) {
  std::vector<std::uint8_t> pixels(64 * 48, 100);
  image_t image;
  to_wire(seq * 100'000, seq, {pixels.data(), 64, 48, 64}, &image);
  return image;
}

/// Publishes one image and its results as the chain does.
class FakeChain {
 public:
  explicit FakeChain(const std::string& url) : bus_(url, &counters_) {}
  void publish(std::int64_t seq, double speed_m_s) {
    camera_.publish(grey_image(seq));
    vo_motion_t vo{};
    vo.seq = seq;
    vo.num_road_points = 1;
    vo.road_points_px[0][0] = 12.25F;
    vo.num_features = 2;
    vo.features_px[1][0] = 12.5F;
    vo.features_px[1][1] = 7.0F;
    vo.features_kind[1] = vo_motion_t::FEATURE_MOVING;
    vo_.publish(vo);
    ground_plane_t plane{};
    plane.seq = seq;
    plane.height_m = 1.0 / 3.0;
    plane.cov[2][2] = 0.01;
    plane.num_cues = 1;
    plane.cues.resize(1);
    plane.cues[0].test_ratio = 0.7;
    plane_.publish(plane);
    ego_motion_t ego{};
    ego.seq = seq;
    ego.utime = seq * 100'000;
    ego.velocity_ground_m_s[0] = speed_m_s;
    ego_.publish(ego);
  }

 private:
  Counters counters_;
  Bus bus_;
  Publisher<image_t> camera_{bus_, kCamera, 1 << 16};
  Publisher<vo_motion_t> vo_{bus_, kVoMotion};
  Publisher<ground_plane_t> plane_{bus_, kGroundPlane};
  Publisher<ego_motion_t> ego_{bus_, kEgoMotion};
};

constexpr const char* kUrl = "udpm://239.255.76.67:7667?ttl=0";

LiveOptions at_rate(double rate_hz) {
  LiveOptions options;
  options.lcm_url = kUrl;
  options.rate_hz = rate_hz;
  return options;
}

TEST(LiveMonitor, ShowsWhatTheBusCarries) {
  watch_while(at_rate(10.0), [](int port) {
    WebClient page(port);
    page.open_page();
    const auto hello = page.hear_packet("hello");
    ASSERT_TRUE(hello);
    EXPECT_EQ((*hello)["mode"], "live");
    FakeChain chain(kUrl);
    for (std::int64_t seq = 1; seq <= 3; ++seq) {
      const double speed = 10.0 / 3.0 + static_cast<double>(seq);
      chain.publish(seq, speed);
      const auto frame = page.hear_packet("frame");
      ASSERT_TRUE(frame) << seq;
      EXPECT_EQ((*frame)["seq"], seq);
      EXPECT_EQ((*frame)["ego"]["velocity"][0], speed) << "not the same bits";
      EXPECT_EQ((*frame)["row"][2], speed);
      EXPECT_EQ((*frame)["plane"]["height"], 1.0 / 3.0);
      EXPECT_EQ((*frame)["plane"]["cues"][0]["test_ratio"], 0.7);
      EXPECT_EQ((*frame)["vo"]["features"], nlohmann::json({0.0, 0.0, 0, 12.5, 7.0, 2}));
      EXPECT_EQ((*frame)["image"]["seq"], seq);
      EXPECT_EQ(page.jpeg().substr(0, 2), "\xff\xd8");
      page.say("ack " + (*frame)["id"].dump());
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
  });
}

TEST(LiveMonitor, KeepsItsOwnRate) {
  watch_while(at_rate(5.0), [](int port) {
    WebClient page(port);
    page.open_page();
    ASSERT_TRUE(page.hear_packet("hello"));
    FakeChain chain(kUrl);
    for (std::int64_t seq = 0; seq < 100; ++seq) {
      chain.publish(seq, 1.0);
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    int num_frames = 0;
    while (const auto frame = page.hear_packet("frame", 300)) {
      ++num_frames;
      page.say("ack " + (*frame)["id"].dump());
    }
    EXPECT_GE(num_frames, 2);
    EXPECT_LE(num_frames, 8) << "100 images in a second at 5 frames/s";
  });
}

TEST(LiveMonitor, ShowsImagesThatHaveNoResultsAndPublishesNothing) {
  watch_while(at_rate(10.0), [](int port) {
    WebClient page(port);
    page.open_page();
    ASSERT_TRUE(page.hear_packet("hello"));
    Counters counters;
    Bus bus(kUrl, &counters);
    int num_heard = 0;
    std::vector<std::unique_ptr<RawSubscriber>> readers;
    for (const Channel* channel : {&kVoMotion, &kGroundPlane, &kEgoMotion, &kMount, &kObjects,
                                   &kDetections, &kHealthVo, &kHealthCan}) {
      readers.push_back(std::make_unique<RawSubscriber>(
          bus, *channel, Input::kOccasional, [&num_heard](RawSubscriber::Bytes) -> const char* {
            ++num_heard;
            return nullptr;
          }));
    }
    Publisher<image_t> camera(bus, kCamera, 1 << 16);
    bool is_shown = false;
    for (std::int64_t seq = 0; seq < 30 && !is_shown; ++seq) {
      camera.publish(grey_image(seq));
      bus.handle(50);
      const auto state = page.hear_packet("state", 50);
      if (!state) continue;
      is_shown = state->contains("image") && page.jpeg().substr(0, 2) == "\xff\xd8";
      page.say("ack " + (*state)["id"].dump());
    }
    EXPECT_TRUE(is_shown);
    EXPECT_EQ(num_heard, 0);
  });
}

}  // namespace
}  // namespace plumb
