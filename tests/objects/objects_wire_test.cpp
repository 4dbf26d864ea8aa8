// Tests detections_t, objects_t and the node between them: round trips and refused messages.
#include "modules/objects/objects_wire.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "core/numbers.hpp"
#include "modules/detections/detections_wire.hpp"
#include "modules/objects/objects_node.hpp"
#include "platform/bounded_decode.hpp"
#include "tests/objects/cuboid_scene.hpp"

namespace plumb {
namespace {
constexpr float kNanF = std::numeric_limits<float>::quiet_NaN();

DetectionFrame two_cars(std::int64_t seq) {
  DetectionFrame frame;
  frame.seq = seq;
  frame.capture_us = 100'000 * seq;
  for (const auto id : {3, 8}) {
    Detection detection = test::detect(test::car_at(12.0 + id, 4.0 - id, 0.0), test::road(0.0), id);
    for (int i = 0; i < 5; ++i) {
      EXPECT_TRUE(detection.candidates.push_back({detection.box, 0.1 * i}));
    }
    EXPECT_TRUE(frame.detections.push_back(detection));
  }
  return frame;
}

detections_t sound(std::int64_t seq = 1) {
  detections_t message;
  to_wire(two_cars(seq), &message);
  return message;
}

TEST(DetectionsWire, RoundTripKeepsEverything) {
  const DetectionFrame sent = two_cars(9);
  detections_t message;
  to_wire(sent, &message);
  DetectionFrame received;
  ASSERT_EQ(from_wire(message, &received), nullptr);
  EXPECT_EQ(received.seq, 9);
  EXPECT_EQ(received.capture_us, 900'000);
  ASSERT_EQ(received.detections.size(), 2u);
  const Detection& a = sent.detections[1];
  const Detection& b = received.detections[1];
  EXPECT_EQ(b.track_id, a.track_id);
  EXPECT_EQ(b.object_class, a.object_class);
  EXPECT_NEAR(b.score, a.score, 1e-6);
  EXPECT_NEAR(b.box.bottom_px, a.box.bottom_px, 1e-4);
  ASSERT_EQ(b.candidates.size(), 5u);
  EXPECT_NEAR(b.candidates[4].score, 0.4, 1e-6);
}

TEST(DetectionsWire, RefusesEveryBrokenField) {
  using Break = std::function<void(detections_t*)>;
  const std::pair<const char*, Break> cases[] = {
      {"count below zero", [](detections_t* m) { m->num_detections = -1; }},
      {"count without boxes", [](detections_t* m) { m->num_detections = 40; }},
      {"ten thousand boxes",
       [](detections_t* m) {
         m->num_detections = 10'000;
         m->detections.resize(10'000, m->detections[0]);
       }},
      {"class", [](detections_t* m) { m->detections[0].class_id = 7; }},
      {"negative class", [](detections_t* m) { m->detections[0].class_id = -1; }},
      {"track id", [](detections_t* m) { m->detections[0].track_id = -2; }},
      {"track id twice", [](detections_t* m) { m->detections[0].track_id = 8; }},
      {"score", [](detections_t* m) { m->detections[1].score = 1.5F; }},
      {"score NaN", [](detections_t* m) { m->detections[1].score = kNanF; }},
      {"box NaN", [](detections_t* m) { m->detections[1].box_px[2] = kNanF; }},
      {"box infinite",
       [](detections_t* m) {
         m->detections[1].box_px[2] = std::numeric_limits<float>::infinity();
       }},
      {"box of negative width",
       [](detections_t* m) { std::swap(m->detections[0].box_px[0], m->detections[0].box_px[2]); }},
      {"box without height",
       [](detections_t* m) { m->detections[0].box_px[1] = m->detections[0].box_px[3]; }},
      {"truncation", [](detections_t* m) { m->detections[0].truncated_ratio = 2.0F; }},
      {"occlusion", [](detections_t* m) { m->detections[0].occluded = 4; }},
      {"candidates", [](detections_t* m) { m->detections[0].num_candidates = 17; }},
      {"candidates below zero", [](detections_t* m) { m->detections[0].num_candidates = -3; }},
      {"candidate NaN", [](detections_t* m) { m->detections[0].candidates_px[2][1] = kNanF; }},
      {"candidate score", [](detections_t* m) { m->detections[0].candidate_scores[0] = kNanF; }}};
  for (const auto& [name, breaks] : cases) {
    detections_t message = sound();
    breaks(&message);
    DetectionFrame frame;
    EXPECT_NE(from_wire(message, &frame), nullptr) << name;
  }
}

TEST(DetectionsWire, UnknownTruncationIsAllowed) {
  detections_t message = sound();
  message.detections[0].truncated_ratio = kNanF;
  DetectionFrame frame;
  EXPECT_EQ(from_wire(message, &frame), nullptr);
  EXPECT_TRUE(std::isnan(frame.detections[0].truncated_ratio));
}

ObjectsOutput sample_objects() {
  ObjectsOutput output;
  output.capture_us = 123;
  output.seq = 7;
  output.num_refused = 2;
  ObjectOutput object;
  object.track_id = 5;
  object.object_class = ObjectClass::kVan;
  object.status = ObjectStatus::kMeasured;
  object.reason = ObjectReason::kHidden;
  object.position_m = {20.0, -3.0};
  object.position_cov_m2 << 1.0, 0.1, 0.1, 0.2;
  object.velocity_valid = true;
  object.velocity_m_s = {9.0, 0.5};
  object.velocity_cov_m2_s2 << 0.4, 0.0, 0.0, 0.3;
  object.yaw_rad = 0.05;
  object.yaw_std_rad = 0.02;
  object.size_m = {4.9, 1.9, 2.1};
  object.size_std_m = {0.4, 0.1, 0.1};
  object.time_to_collision_s = kNan;
  object.age_s = 1.5;
  EXPECT_TRUE(output.objects.push_back(object));
  object.track_id = 6;
  object.velocity_valid = false;
  EXPECT_TRUE(output.objects.push_back(object));
  return output;
}

TEST(ObjectsWire, RoundTripThroughBytesKeepsEverything) {
  objects_t message;
  to_wire(sample_objects(), &message);
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  ASSERT_GT(message.encode(bytes.data(), 0, static_cast<int>(bytes.size())), 0);
  objects_t decoded;
  ASSERT_TRUE(decode_bounded(bytes, &decoded));
  ObjectsOutput output;
  ASSERT_EQ(from_wire(decoded, &output), nullptr);
  ASSERT_EQ(output.objects.size(), 2u);
  EXPECT_EQ(output.seq, 7);
  EXPECT_EQ(output.num_refused, 2);
  const ObjectOutput& object = output.objects[0];
  EXPECT_EQ(object.reason, ObjectReason::kHidden);
  EXPECT_EQ(object.object_class, ObjectClass::kVan);
  EXPECT_EQ(object.position_m, Eigen::Vector2d(20.0, -3.0));
  EXPECT_EQ(object.position_cov_m2(0, 1), 0.1);
  EXPECT_EQ(object.velocity_m_s, Eigen::Vector2d(9.0, 0.5));
  EXPECT_EQ(object.size_std_m.x(), 0.4);
  EXPECT_TRUE(std::isnan(object.time_to_collision_s));
  EXPECT_FALSE(output.objects[1].velocity_valid);
  bytes.pop_back();
  EXPECT_FALSE(decode_bounded(bytes, &decoded));
}

TEST(ObjectsWire, RefusesEveryBrokenField) {
  using Break = std::function<void(objects_t*)>;
  const std::pair<const char*, Break> cases[] = {
      {"count", [](objects_t* m) { m->num_objects = 33; }},
      {"refused", [](objects_t* m) { m->num_refused = -1; }},
      {"class", [](objects_t* m) { m->objects[0].class_id = 9; }},
      {"status", [](objects_t* m) { m->objects[0].status = 3; }},
      {"reason", [](objects_t* m) { m->objects[0].reason = 7; }},
      {"age", [](objects_t* m) { m->objects[0].age_s = kNan; }},
      {"time to collision", [](objects_t* m) { m->objects[0].time_to_collision_s = -1.0; }},
      {"position", [](objects_t* m) { m->objects[0].position_ground_m[1] = kNan; }},
      {"covariance", [](objects_t* m) { m->objects[0].position_cov_m2[0][0] = -1.0; }},
      {"velocity", [](objects_t* m) { m->objects[0].velocity_ground_m_s[1] = kNan; }},
      {"yaw", [](objects_t* m) { m->objects[0].yaw_rad = kNan; }},
      {"size", [](objects_t* m) { m->objects[0].size_m[2] = -0.1; }},
      {"deviation", [](objects_t* m) { m->objects[0].yaw_std_rad = kNan; }}};
  for (const auto& [name, breaks] : cases) {
    objects_t message;
    to_wire(sample_objects(), &message);
    breaks(&message);
    ObjectsOutput output;
    EXPECT_NE(from_wire(message, &output), nullptr) << name;
  }
}

std::vector<std::uint8_t> bytes_of(const objects_t& message) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  EXPECT_GT(message.encode(bytes.data(), 0, static_cast<int>(bytes.size())), 0);
  return bytes;
}

class ObjectsNodeTest : public testing::Test {
 protected:
  void calibrate() {
    camera_calibration_t message{};
    message.width = 1242;
    message.height = 375;
    message.fx_px = message.fy_px = 721.5;
    message.cx_px = 609.6;
    message.cy_px = 172.9;
    message.camera_height_m = 1.65;
    ASSERT_EQ(node_.take_calibration(message), nullptr);
  }
  /// Sends plane and motion of image `seq`, with 1 m of driving per image.
  const char* take_ground(std::int64_t seq) {
    GroundOutput output;
    output.seq = seq;
    output.capture_us = 100'000 * seq;
    output.plane.status = GroundStatus::kOk;
    output.plane.normal_cam = {0.0, 1.0, 0.0};
    output.plane.height_m = 1.65;
    output.plane.pitch_rad = output.plane.roll_rad = 0.0;
    output.plane.cov.setZero();
    output.plane.cov.diagonal() << 1e-6, 1e-6, 1e-6;
    output.ego.status = EgoStatus::kOk;
    output.ego.log_scale = output.ego.log_scale_std = 0.0;
    output.ego.T_world_cam.t = {0.0, 0.0, static_cast<double>(seq)};
    ground_plane_t plane{};
    ego_motion_t ego{};
    to_wire(output, &plane);
    to_wire(output, &ego);
    plane.capture_mono_us = 7'000'000 + output.capture_us;
    if (const char* why = node_.take_plane(plane)) return why;
    return node_.take_ego(ego);
  }

  static ObjectsConfig on_plane(const char* plane) {
    ObjectsConfig config;
    config.plane = plane;
    return config;
  }
  ObjectsNode make(const ObjectsConfig& config) {
    return {DetectionsConfig{}, config, GroundConfig{},
            [this](const objects_t& m) { published_.push_back(m); }};
  }

  std::vector<objects_t> published_;
  ObjectsNode node_ = make({});
};

TEST_F(ObjectsNodeTest, ProcessesDetectionsWithThePlaneOfTheirImage) {
  calibrate();
  ASSERT_EQ(take_ground(1), nullptr);
  ASSERT_EQ(node_.take_detections(sound(1)), nullptr);
  ASSERT_EQ(published_.size(), 1u);
  EXPECT_EQ(published_[0].seq, 1);
  EXPECT_EQ(published_[0].num_objects, 2);
  EXPECT_EQ(published_[0].capture_mono_us, 7'100'000) << "that of the plane";
  EXPECT_NE(published_[0].objects[0].reason, object_t::REASON_CALIBRATED_PLANE);
}

TEST_F(ObjectsNodeTest, LateDetectionsBelongToTheImageTheyWereMadeOf) {
  calibrate();
  for (int seq = 1; seq <= 10; ++seq) ASSERT_EQ(take_ground(seq), nullptr);
  ASSERT_EQ(node_.take_detections(sound(4)), nullptr);
  ASSERT_EQ(published_.size(), 1u);
  EXPECT_EQ(published_[0].seq, 4);
  ASSERT_EQ(node_.take_detections(sound(9)), nullptr);
  ASSERT_EQ(published_.size(), 2u);
  // The cars kept their places in the image while the camera drove 5 m in 0.5 s,
  // so they are as fast.
  EXPECT_FALSE(std::isnan(published_[1].objects[0].velocity_ground_m_s[0]));
  EXPECT_GT(published_[1].objects[0].velocity_ground_m_s[0], 5.0);
}

TEST_F(ObjectsNodeTest, DetectionsWaitForTheirPlaneAndGoOnWithoutIt) {
  calibrate();
  ASSERT_EQ(node_.take_detections(sound(1)), nullptr);
  EXPECT_TRUE(node_.waiting());
  EXPECT_TRUE(published_.empty());
  ASSERT_EQ(take_ground(1), nullptr);
  EXPECT_EQ(published_.size(), 1u);
  ASSERT_EQ(node_.take_detections(sound(2)), nullptr);
  node_.expire();
  ASSERT_EQ(published_.size(), 2u);
  EXPECT_EQ(published_[1].capture_mono_us, 0) << "not known without the plane";
  EXPECT_EQ(published_[1].objects[0].reason, object_t::REASON_CALIBRATED_PLANE);
  EXPECT_TRUE(std::isnan(published_[1].objects[0].velocity_ground_m_s[0]));
}

TEST_F(ObjectsNodeTest, SlowPlanesGiveWhatPromptOnesGive) {
  calibrate();
  for (int seq = 1; seq <= 6; ++seq) {
    ASSERT_EQ(take_ground(seq), nullptr);
    ASSERT_EQ(node_.take_detections(sound(seq)), nullptr);
  }
  const std::vector<objects_t> prompt = std::exchange(published_, {});
  node_ = make({});
  calibrate();
  // WHEN detections of three images wait before the first plane arrives,
  for (int seq = 1; seq <= 6; ++seq) {
    ASSERT_EQ(node_.take_detections(sound(seq)), nullptr);
    if (seq < 3) continue;
    ASSERT_EQ(take_ground(seq - 2), nullptr);
  }
  for (int seq = 5; seq <= 6; ++seq) ASSERT_EQ(take_ground(seq), nullptr);
  EXPECT_FALSE(node_.waiting());
  ASSERT_EQ(published_.size(), prompt.size());
  for (std::size_t i = 0; i < prompt.size(); ++i)
    EXPECT_EQ(bytes_of(published_[i]), bytes_of(prompt[i]));
}

TEST_F(ObjectsNodeTest, DetectionsWhosePlaneWasLostGoOnWithoutItInOrder) {
  calibrate();
  for (int seq = 1; seq <= 3; ++seq) ASSERT_EQ(node_.take_detections(sound(seq)), nullptr);
  EXPECT_TRUE(published_.empty());
  // WHEN no more detections can wait, the oldest are processed.
  ASSERT_EQ(node_.take_detections(sound(4)), nullptr);
  ASSERT_EQ(published_.size(), 1u);
  // WHEN the plane of the third image arrives, that of the second is lost.
  ASSERT_EQ(take_ground(3), nullptr);
  ASSERT_EQ(published_.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(published_[i].seq, static_cast<int>(i) + 1);
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_EQ(published_[i].objects[0].reason, object_t::REASON_CALIBRATED_PLANE);
  EXPECT_NE(published_[2].objects[0].reason, object_t::REASON_CALIBRATED_PLANE);
  EXPECT_TRUE(node_.waiting());
  EXPECT_EQ(node_.num_unpaired(), 2);
  node_.expire();
  EXPECT_EQ(published_.back().seq, 4);
  EXPECT_EQ(node_.num_unpaired(), 3);
}

TEST_F(ObjectsNodeTest, CountsAPlaneWhoseMotionNeverCame) {
  calibrate();
  ASSERT_EQ(take_ground(1), nullptr);
  EXPECT_EQ(node_.num_lost(), 0);
  GroundOutput alone;
  alone.seq = 2;
  alone.capture_us = 200'000;
  ground_plane_t plane{};
  to_wire(alone, &plane);
  ASSERT_EQ(node_.take_plane(plane), nullptr);
  ASSERT_EQ(take_ground(3), nullptr);
  EXPECT_EQ(node_.num_lost(), 1);
}

TEST_F(ObjectsNodeTest, KeepsToTheCalibratedPlaneWhenAskedTo) {
  node_ = make(on_plane("calibrated"));
  calibrate();
  for (int seq = 1; seq <= 2; ++seq) {
    ASSERT_EQ(take_ground(seq), nullptr);
    ASSERT_EQ(node_.take_detections(sound(seq)), nullptr);
    ASSERT_EQ(published_.size(), static_cast<std::size_t>(seq));
    EXPECT_EQ(published_.back().objects[0].reason, object_t::REASON_CALIBRATED_PLANE);
  }
  EXPECT_FALSE(std::isnan(published_[1].objects[0].velocity_ground_m_s[0])) << "the motion is used";
}

TEST_F(ObjectsNodeTest, BeginsAnewWithItsSource) {
  calibrate();
  for (int seq = 5; seq <= 7; ++seq) {
    ASSERT_EQ(take_ground(seq), nullptr);
    ASSERT_EQ(node_.take_detections(sound(seq)), nullptr);
  }
  ASSERT_EQ(take_ground(1), nullptr);
  ASSERT_EQ(node_.take_detections(sound(1)), nullptr);
  ASSERT_EQ(published_.size(), 4U);
  EXPECT_EQ(published_.back().objects[0].age_s, 0.0) << "old tracks are gone";
}

TEST_F(ObjectsNodeTest, RefusesWhatComesTooEarlyTwiceOrOutOfOrder) {
  EXPECT_STREQ(node_.take_detections(sound(1)), "detections came before a calibration");
  calibrate();
  for (int seq = 1; seq <= 5; ++seq) ASSERT_EQ(take_ground(seq), nullptr);
  EXPECT_EQ(node_.take_detections(sound(3)), nullptr);
  const char* late = "detections of an image that is not newer than the last one";
  EXPECT_STREQ(node_.take_detections(sound(3)), late);
  EXPECT_STREQ(node_.take_detections(sound(2)), late);
  EXPECT_EQ(node_.take_detections(sound(4)), nullptr);
  EXPECT_EQ(published_.size(), 2u);
}

TEST_F(ObjectsNodeTest, AHostileMessageLeavesTheTracksAlone) {
  calibrate();
  ASSERT_EQ(take_ground(1), nullptr);
  ASSERT_EQ(take_ground(2), nullptr);
  ASSERT_EQ(node_.take_detections(sound(1)), nullptr);
  detections_t hostile = sound(2);
  hostile.detections[1].box_px[0] = kNanF;
  EXPECT_NE(node_.take_detections(hostile), nullptr);
  ASSERT_EQ(node_.take_detections(sound(2)), nullptr);
  EXPECT_EQ(published_.back().num_objects, 2);
  EXPECT_GT(published_.back().objects[0].age_s, 0.0);
}

}  // namespace
}  // namespace plumb
