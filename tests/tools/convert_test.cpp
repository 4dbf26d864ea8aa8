#include "tools/run/kitti2lcm/convert.hpp"

#include <gtest/gtest.h>

#include "core/channels.hpp"
#include "core/principal_point.hpp"
#include "modules/camera/image_wire.hpp"
#include "platform/bounded_decode.hpp"
#include "platform/log_file.hpp"
#include "plumb/camera_calibration_t.hpp"
#include "plumb/detections_t.hpp"
#include "plumb/ground_truth_t.hpp"
#include "tests/support/expect_throw.hpp"
#include "tests/support/kitti_folder.hpp"
#include "tests/tools/drives.hpp"

namespace plumb {
namespace {

using test::expect_contains;
using test::input_error_of;

struct Event {
  std::int64_t log_us = 0;
  std::string channel;
  std::vector<std::uint8_t> data;
};

std::vector<Event> read_log(const std::filesystem::path& path) {
  LogReader reader(path.string());
  std::vector<Event> events;
  for (LogEvent event; reader.next(&event);) {
    events.push_back(
        {event.log_us, std::string(event.channel), {event.data.begin(), event.data.end()}});
  }
  EXPECT_EQ(reader.num_problems(), 0) << path;
  return events;
}

class Convert : public ::testing::Test {
 protected:
  ConvertResult run(bool jpeg = false) {
    SequenceOptions options;
    options.folder = folder_ / "seq";
    return convert(read_sequence(options), {folder_ / "out.lcm", jpeg});
  }
  std::vector<Event> log() { return read_log(folder_ / "out.lcm"); }
  std::vector<Event> log(const Channel& channel) {
    std::vector<Event> events = log();
    std::erase_if(events, [&](const Event& event) { return event.channel != channel.name; });
    return events;
  }
  test::TempFolder folder_;
};

TEST_F(Convert, PutsBoxesBehindTheImageTheyWereSeenIn) {
  test::write_odometry(folder_, 3, 100);
  const auto labels = folder_.write("boxes.txt",
                                    "100 7 Car 0 0 0 10 20 40 50 1.5 1.7 4 1 1.65 20 0\n"
                                    "102 7 Car 0 0 0 12 20 44 52 1.5 1.7 4 1 1.65 19 0\n"
                                    "102 8 Van -1 -1 -10 50 20 70 40 -1 -1 -1 -1 -1 -1 -1 0.8\n"
                                    "999 9 Car 0 0 0 12 20 44 52 1.5 1.7 4 1 1.65 19 0\n");
  SequenceOptions options;
  options.folder = folder_ / "seq";
  const ConvertResult result =
      convert(read_sequence(options), {folder_ / "out.lcm", false, labels});
  EXPECT_EQ(result.num_detections, 3);
  const auto events = log();
  std::vector<detections_t> found;
  for (std::size_t i = 0; i < events.size(); ++i) {
    if (events[i].channel != kDetections.name) continue;
    EXPECT_EQ(events[i - 1].channel, kCamera.name);
    EXPECT_EQ(events[i - 1].log_us, events[i].log_us);
    ASSERT_TRUE(decode_bounded(events[i].data, &found.emplace_back()));
    EXPECT_EQ(found.back().utime, events[i].log_us);
  }
  ASSERT_EQ(found.size(), 3U) << "one per image, also where nothing was seen";
  EXPECT_EQ(found[0].seq, 100);
  EXPECT_EQ(found[0].num_detections, 1);
  EXPECT_EQ(found[1].num_detections, 0);
  ASSERT_EQ(found[2].num_detections, 2);
  EXPECT_EQ(found[2].detections[0].track_id, 7);
  EXPECT_EQ(found[2].detections[0].box_px[2], 44.0F);
  EXPECT_EQ(found[2].detections[1].class_id, detection_t::CLASS_VAN);
}

TEST_F(Convert, ABadBoxFileIsNamedBeforeALogIsBegun) {
  test::write_odometry(folder_, 3, 100);
  const auto labels = folder_.write("boxes.txt", "100 7 Car 0 0 0 10 20 wide 50\n");
  SequenceOptions options;
  options.folder = folder_ / "seq";
  const Sequence sequence = read_sequence(options);
  expect_contains(input_error_of([&] {
                    (void)convert(sequence, {folder_ / "out.lcm", false, labels});
                  }),
                  "boxes.txt:1: column 9: 'wide'");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out.lcm"));
}

TEST_F(Convert, WritesEveryImageBitForBitWithItsNumberAndTime) {
  test::write_odometry(folder_, 4, 100);
  EXPECT_EQ(run().num_frames, 4);
  const auto events = log(kCamera);
  ASSERT_EQ(events.size(), 4U);
  for (std::size_t i = 0; i < events.size(); ++i) {
    ImageFrame frame;
    ASSERT_EQ(read_image(events[i].data, &frame), nullptr);
    EXPECT_EQ(frame.seq, 100 + static_cast<std::int64_t>(i));
    EXPECT_EQ(frame.capture_us, kOdometryEpoch_us + 100'000 * static_cast<std::int64_t>(i));
    EXPECT_EQ(events[i].log_us, frame.capture_us);
    const cv::Mat expected = test::test_image(100 + static_cast<int>(i));
    EXPECT_TRUE(
        std::equal(frame.data.begin(), frame.data.end(), expected.datastart, expected.dataend));
  }
}

TEST_F(Convert, PutsTheCalibrationFirstAndThenOnceASecond) {
  test::write_odometry(folder_, 25);
  run();
  EXPECT_EQ(log().front().channel, kCameraCalibration.name);
  const auto events = log(kCameraCalibration);
  ASSERT_EQ(events.size(), 3U);
  EXPECT_EQ(events[2].log_us - events[0].log_us, 2'000'000);
  camera_calibration_t message;
  ASSERT_TRUE(decode_bounded(events[1].data, &message));
  EXPECT_EQ(message.width, 96);
  EXPECT_DOUBLE_EQ(message.fx_px, 80.0);
  EXPECT_DOUBLE_EQ(message.residual_k1, kKittiResidualK1);
}

TEST_F(Convert, WritesTruthBesideTheImageItBelongsTo) {
  test::write_odometry(folder_, 3);
  folder_.write("seq/poses.txt", test::to_file(test::repeat(test::drive_step(1.0, 0.1), 3)));
  folder_.write("seq/gt_ground_plane.txt", "2 0 1 0 1.6\n");
  const ConvertResult result = run();
  EXPECT_EQ(result.num_poses, 3);
  EXPECT_EQ(result.num_planes, 1);
  const auto events = log(kGroundTruth);
  ASSERT_EQ(events.size(), 3U);
  ground_truth_t truth;
  ASSERT_TRUE(decode_bounded(events[2].data, &truth));
  EXPECT_EQ(truth.seq, 2);
  EXPECT_EQ(truth.has_pose, 1);
  EXPECT_NEAR(truth.q_world_cam[0], std::cos(0.1), 1e-8);
  EXPECT_NEAR(truth.q_world_cam[2], std::sin(0.1), 1e-8);
  EXPECT_EQ(truth.has_plane, 1);
  EXPECT_DOUBLE_EQ(truth.height_m, 1.6);
  ASSERT_TRUE(decode_bounded(events[1].data, &truth));
  EXPECT_EQ(truth.has_plane, 0);
}

TEST_F(Convert, JpegIsSmallerAndDecodesToNearlyTheSame) {
  test::write_odometry(folder_, 2);
  run(true);
  ImageFrame frame;
  const auto events = log(kCamera);
  ASSERT_EQ(read_image(events[1].data, &frame), nullptr);
  EXPECT_TRUE(frame.compressed);
  EXPECT_LT(frame.data.size(), 96U * 72U);
  ImageDecoder decoder(96, 72);
  ImageView view;
  ASSERT_EQ(decoder.decode(frame, &view), nullptr);
  const cv::Mat decoded(72, 96, CV_8UC1, const_cast<std::uint8_t*>(view.data),
                        static_cast<std::size_t>(view.stride_bytes));
  EXPECT_LT(cv::norm(decoded, test::test_image(1), cv::NORM_L1) / (96 * 72), 4.0);
}

TEST_F(Convert, KeepsTheFramesBeforeAnImageOfAnotherSize) {
  test::write_odometry(folder_, 5);
  test::write_image(folder_, "seq/image_0/000003.png", test::test_image(3, 100, 72));
  const std::string error = input_error_of([&] { run(); });
  expect_contains(error, "000003.png is 100 x 72 pixels, the images before it are 96 x 72");
  expect_contains(error, "holds the 3 frames before it");
  EXPECT_EQ(log(kCamera).size(), 3U);
}

TEST_F(Convert, KeepsTheFramesBeforeATruncatedImage) {
  test::write_odometry(folder_, 5);
  const std::string whole = test::read_text(folder_ / "seq/image_0/000002.png");
  folder_.write("seq/image_0/000002.png", whole.substr(0, whole.size() - 9));
  expect_contains(input_error_of([&] { run(); }), "000002.png is cut off");
  EXPECT_EQ(log(kCamera).size(), 2U);
}

TEST_F(Convert, RefusesAPrincipalPointOutsideTheImage) {
  test::write_odometry(folder_, 2);
  folder_.write("seq/calib.txt", "P0: 80 0 480 0 0 80 36 0 0 0 1 0\n");
  expect_contains(input_error_of([&] { run(); }), "principal point");
}

TEST_F(Convert, DoubtsAPrincipalPointFarOffTheMiddle) {
  test::write_odometry(folder_, 2);
  EXPECT_EQ(run().concern, nullptr);
  folder_.write("seq/calib.txt", "P0: 80 0 48 0 0 80 46 0 0 0 1 0\n");
  EXPECT_STREQ(run().concern, kPrincipalPointIsOff);
}

TEST_F(Convert, RefusesRawImagesThatWereNotRectified) {
  const auto drive = test::write_raw(folder_, 2);
  test::write_image(folder_, "date/drive/image_00/data/0000000000.png",
                    test::test_image(0, 139, 51));
  SequenceOptions options;
  options.folder = drive;
  expect_contains(input_error_of([&] {
                    convert(read_sequence(options), {folder_ / "out.lcm", false});
                  }),
                  "is 139 x 51 pixels, the calibration says 96 x 72 after rectification");
}

}  // namespace
}  // namespace plumb
