#include "modules/detector/detector_node.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "platform/config.hpp"
#include "tests/support/kitti_data.hpp"
#include "tests/support/run_program.hpp"

namespace plumb {
namespace {

std::string refusal(const DetectorConfig& config) {
  try {
    const Network network(config);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

DetectorConfig small_network() {
  const auto folder = test::kitti_sequence("../detectors/yolo-fastest-1.1");
  DetectorConfig config;
  if (folder.empty()) return config;
  config.model_file = (folder / "yolo-fastest-1.1.cfg").string();
  config.weights_file = (folder / "yolo-fastest-1.1.weights").string();
  return config;
}

std::vector<std::uint8_t> image_message(std::int64_t seq, const cv::Mat& grey) {
  image_t message;
  to_wire(1'000'000 + seq, seq,
          {grey.data, grey.cols, grey.rows, static_cast<std::ptrdiff_t>(grey.step[0])}, &message);
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

TEST(Network, SaysWhatIsWrongWithItsSettings) {
  const test::TempFolder folder;
  DetectorConfig config;
  EXPECT_EQ(refusal(config), "detect.model_file is not set");
  config.model_file = "/nonexistent/net.cfg";
  EXPECT_NE(refusal(config).find("/nonexistent/net.cfg"), std::string::npos);
  config.model_file = folder.write("junk.onnx", "no network").string();
  EXPECT_NE(refusal(config).find("not a network"), std::string::npos);
  for (const char* classes : {"2=car", "car:2", "-1:car", "2:tank", " "}) {
    config.classes = classes;
    EXPECT_EQ(refusal(config).rfind("detect.classes", 0), 0U) << classes << ": " << refusal(config);
  }
}

TEST(DetectorProgram, WithoutANetworkEndsWithOneSentence) {
  const test::TempFolder folder;
  const auto result = test::run_program(folder, "plumb-detect", "--lcm-url memq://");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("detect.model_file is not set"), std::string::npos) << result.err;
}

class DetectorOnRoads : public testing::Test {
 protected:
  void SetUp() override {
    drive_ = test::kitti_sequence("raw/drive0009_000-050");
    if (drive_.empty() || small_network().model_file.empty()) GTEST_SKIP() << test::kNoKitti;
    image_ = cv::imread((drive_ / "image_0/0000000040.png").string(), cv::IMREAD_GRAYSCALE);
    ASSERT_FALSE(image_.empty());
  }
  std::filesystem::path drive_;
  cv::Mat image_;
};

TEST_F(DetectorOnRoads, FindsParkedCarsWithTheBoxesBehindThem) {
  DetectorNode node(small_network());
  ASSERT_EQ(node.take_image(image_message(40, image_)), nullptr);
  const char* refused = nullptr;
  const detections_t* found = node.search(&refused);
  ASSERT_NE(found, nullptr) << refused;
  EXPECT_EQ(found->seq, 40);
  EXPECT_EQ(found->utime, 1'000'040);
  EXPECT_GE(found->num_detections, 3);
  int num_cars = 0;
  for (const detection_t& d : found->detections) {
    num_cars += d.class_id == detection_t::CLASS_CAR ? 1 : 0;
    EXPECT_GE(d.score, 0.3F);
    ASSERT_GE(d.num_candidates, 1);
    for (int k = 0; k < 4; ++k) EXPECT_EQ(d.candidates_px[0][k], d.box_px[k]) << "itself first";
    EXPECT_GT(d.box_px[3], 150.0F) << "vehicles stand below the horizon";
  }
  EXPECT_GE(num_cars, 3);
  EXPECT_EQ(node.search(&refused), nullptr) << "each image once";
  EXPECT_EQ(refused, nullptr);
}

TEST_F(DetectorOnRoads, GivesTheSameBoxesEveryTimeAndTakesTheNewestImage) {
  std::vector<std::vector<std::uint8_t>> runs;
  for (int run = 0; run < 2; ++run) {
    DetectorNode node(small_network());
    ASSERT_EQ(node.take_image(image_message(39, cv::Mat::zeros(image_.size(), CV_8U))), nullptr);
    ASSERT_EQ(node.take_image(image_message(40, image_)), nullptr);
    EXPECT_EQ(node.num_skipped(), 1);
    const char* refused = nullptr;
    const detections_t* found = node.search(&refused);
    ASSERT_NE(found, nullptr);
    EXPECT_EQ(found->seq, 40);
    auto& bytes = runs.emplace_back(static_cast<std::size_t>(found->getEncodedSize()));
    found->encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  }
  EXPECT_EQ(runs[0], runs[1]);
}

TEST_F(DetectorOnRoads, RefusesWhatIsNoImageAndGoesOn) {
  DetectorNode node(small_network());
  EXPECT_NE(node.take_image({}), nullptr);
  const char* refused = nullptr;
  EXPECT_EQ(node.search(&refused), nullptr);
  ASSERT_EQ(node.take_image(image_message(40, image_(cv::Rect(300, 0, 500, 375)).clone())),
            nullptr);
  EXPECT_NE(node.search(&refused), nullptr) << "another size is another image";
}

}  // namespace
}  // namespace plumb
