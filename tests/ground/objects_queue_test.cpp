#include "modules/ground/cues/objects_queue.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <vector>

#include "tests/detections/road_scene.hpp"
#include "tests/support/count_malloc.hpp"

namespace plumb {
namespace {

constexpr double kBelow_rad = 0.8 * kDegree;  ///< how far the camera looks down

const CameraHeight kHeight{GroundConfig{}.camera_height_m, 0.0};

LinearVariance as_it_is() { return {0.0, 1.0, 1e-12, 1.0, 9e-6}; }

/// A camera whose pitch changes between images; six cars stand on its road.
class ObjectsQueueTest : public testing::Test {
 protected:
  void start(int delay_images, const char* covariance = "learned") {
    GroundConfig config;
    config.detections_delay_images = delay_images;
    config.covariance = covariance;
    queue_.emplace(config, DetectionsConfig{}, test::kSceneCamera, as_it_is());
  }

  [[nodiscard]] static std::int64_t time_of(std::int64_t seq) { return 1'000'000 + 100'000 * seq; }

  const char* detections(std::int64_t seq, double pitch_rad) {
    DetectionFrame frame = test::seen(test::six_cars(), test::road(pitch_rad), time_of(seq));
    frame.seq = seq;
    return queue_->take(frame);
  }

  /// Processes image `seq`. Since the image before, the camera has pitched by `nose_down_rad`.
  std::span<const ObjectsMeasurement> image(std::int64_t seq, double nose_down_rad = 0.0,
                                            VoStatus status = VoStatus::kOk) {
    VoOutput vo;
    vo.seq = seq;
    vo.prev_seq = seq - 1;
    vo.capture_us = time_of(seq);
    vo.status = status;
    vo.T_prev_cam.R = exp_so3(Eigen::Vector3d(-nose_down_rad, 0.0, 0.0));
    const auto normals = queue_->update(vo, kHeight);
    PlaneOutput plane;
    plane.status = GroundStatus::kOk;
    plane.roll_rad = 0.0;
    plane.cov.setZero();
    queue_->note(plane);
    return normals;
  }

  std::optional<ObjectsQueue> queue_;
};

TEST_F(ObjectsQueueTest, ComesOneImageAfterItsDetections) {
  start(1);
  EXPECT_TRUE(image(1).empty());
  EXPECT_EQ(detections(1, kBelow_rad), nullptr);
  const auto normals = image(2);
  ASSERT_EQ(normals.size(), 1U);
  EXPECT_NEAR(normals[0].n3, std::sin(kBelow_rad), 0.05 * kDegree);
  EXPECT_GT(normals[0].confidence, 0.0);
  EXPECT_GT(normals[0].n3_var, normals[0].confidence) << "the turn in between is not known exactly";
  EXPECT_TRUE(image(3).empty()) << "image 2 had none";
}

TEST_F(ObjectsQueueTest, TurnsWithTheCameraInBetween) {
  start(2);
  image(1);
  ASSERT_EQ(detections(1, kBelow_rad), nullptr);
  image(2, 0.5 * kDegree);
  const auto normals = image(3, -0.2 * kDegree);
  ASSERT_EQ(normals.size(), 1U);
  EXPECT_NEAR(normals[0].n3, std::sin(kBelow_rad + 0.3 * kDegree), 0.05 * kDegree);
}

TEST_F(ObjectsQueueTest, IsTheSameHoweverEarlyTheDetectionsCame) {
  start(2);
  image(1);
  ASSERT_EQ(detections(1, kBelow_rad), nullptr);
  image(2);
  const ObjectsMeasurement early = image(3)[0];
  start(2);
  image(1);
  image(2);
  ASSERT_EQ(detections(1, kBelow_rad), nullptr);
  const ObjectsMeasurement late = image(3)[0];
  EXPECT_EQ(early.n3, late.n3);
  EXPECT_EQ(early.n3_var, late.n3_var);
}

TEST_F(ObjectsQueueTest, RefusesDetectionsThatComeTooLateOrInDisorder) {
  start(1);
  image(1);
  image(2);
  EXPECT_STREQ(detections(1, kBelow_rad),
               "detections came later than ground.detections_delay_images allows");
  EXPECT_EQ(detections(2, kBelow_rad), nullptr);
  EXPECT_STREQ(detections(2, kBelow_rad), "detections of an image that is not newer");
  EXPECT_EQ(image(3).size(), 1U) << "what was taken before is not lost";
}

TEST_F(ObjectsQueueTest, CountsDetectionsThatGiveWayBeforeTheirTurn) {
  start(1);
  image(1);
  constexpr auto kRoom = static_cast<std::int64_t>(ObjectsQueue::kMaxWaiting);
  for (std::int64_t seq = 1; seq <= kRoom; ++seq) ASSERT_EQ(detections(seq, kBelow_rad), nullptr);
  EXPECT_EQ(queue_->num_overflowed(), 0);
  ASSERT_EQ(detections(kRoom + 1, kBelow_rad), nullptr);
  EXPECT_EQ(queue_->num_overflowed(), 1);
  EXPECT_TRUE(image(2).empty()) << "those of image 1 are gone";
  EXPECT_EQ(image(3).size(), 1U);
  ASSERT_EQ(detections(kRoom + 2, kBelow_rad), nullptr);
  EXPECT_EQ(queue_->num_overflowed(), 1) << "the turn of image 2 has passed";
}

TEST_F(ObjectsQueueTest, IsSilentAcrossABreakInTheMotion) {
  start(1);
  image(1);
  ASSERT_EQ(detections(1, kBelow_rad), nullptr);
  EXPECT_TRUE(image(2, 0.0, VoStatus::kLost).empty());
  ASSERT_EQ(detections(2, kBelow_rad), nullptr);
  EXPECT_EQ(image(3).size(), 1U);
  ASSERT_EQ(detections(3, kBelow_rad), nullptr);
  EXPECT_TRUE(image(5).empty()) << "image 4 is missing, and with it the turn";
}

TEST_F(ObjectsQueueTest, GoesOnWhenASourceBeginsAnew) {
  start(1);
  for (std::int64_t seq = 50; seq < 53; ++seq) {
    image(seq);
    ASSERT_EQ(detections(seq, kBelow_rad), nullptr);
  }
  image(0);
  ASSERT_EQ(detections(0, kBelow_rad), nullptr);
  EXPECT_EQ(image(1).size(), 1U);
}

TEST_F(ObjectsQueueTest, DelayOfNoneTurnsItOff) {
  start(0);
  image(1);
  EXPECT_EQ(detections(1, kBelow_rad), nullptr);
  EXPECT_TRUE(image(2).empty());
}

TEST_F(ObjectsQueueTest, FixedCovarianceIsTheModelsMean) {
  start(1, "fixed");
  image(1);
  ASSERT_EQ(detections(1, kBelow_rad), nullptr);
  const auto normals = image(2);
  ASSERT_EQ(normals.size(), 1U);
  EXPECT_NEAR(normals[0].n3_var, 9e-6, 2e-6);
  EXPECT_NE(normals[0].confidence, normals[0].n3_var);
}

TEST_F(ObjectsQueueTest, ManyWaitingDetectionsLetTheOldestGo) {
  start(1);
  image(0);
  constexpr auto kMany = static_cast<std::int64_t>(ObjectsQueue::kMaxWaiting) + 1;
  for (std::int64_t seq = 0; seq < kMany; ++seq) ASSERT_EQ(detections(seq, kBelow_rad), nullptr);
  EXPECT_TRUE(image(1).empty());
  for (std::int64_t seq = 2; seq <= kMany; ++seq) EXPECT_EQ(image(seq).size(), 1U) << seq;
}

TEST_F(ObjectsQueueTest, AllocatesNothing) {
  if (!test::kCountsMallocs) GTEST_SKIP() << "the sanitizer owns malloc";
  start(2);
  std::vector<DetectionFrame> frames;
  for (std::int64_t seq = 0; seq < 30; ++seq) {
    frames.push_back(test::seen(test::six_cars(), test::road(kBelow_rad), time_of(seq)));
    frames.back().seq = seq;
  }
  std::size_t num_seen = 0;
  const auto before = test::g_num_mallocs.load();
  for (const DetectionFrame& frame : frames) {
    num_seen += image(frame.seq).size();
    (void)queue_->take(frame);
  }
  EXPECT_EQ(test::g_num_mallocs.load(), before);
  EXPECT_EQ(num_seen, 28U);
}

}  // namespace
}  // namespace plumb
