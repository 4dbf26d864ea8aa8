// Tests the nodes of vo and ground: calibration rules, refused messages, and the pairing of motions
// with images.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <random>

#include "modules/ground/ground_node.hpp"
#include "modules/vo/vo_node.hpp"
#include "tests/support/temp_folder.hpp"
#include "tests/wire/sample_output.hpp"

namespace plumb {
namespace {

using Bytes = std::vector<std::uint8_t>;
constexpr int kWidth = 320;
constexpr int kHeight = 128;
const CameraModel kModel{kWidth, kHeight, 250.0, 250.0, 160.0, 64.0, 0.0, 0.0, 1.65};

Bytes image_bytes(std::int64_t seq, int width_px = kWidth) {
  Bytes pixels(static_cast<std::size_t>(width_px * kHeight));
  std::mt19937 random(5);
  for (std::uint8_t& p : pixels) p = static_cast<std::uint8_t>(random());
  image_t message{};
  to_wire(seq * 100'000, seq, {pixels.data(), width_px, kHeight, width_px}, &message);
  Bytes bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

class VoNodeTest : public testing::Test {
 protected:
  std::string take(const Bytes& bytes) {
    const char* why = node_->take_image(bytes, 1);
    return why == nullptr ? "" : why;
  }
  NullProbe probe_;
  std::unique_ptr<VoNode> node_ = std::make_unique<VoNode>(VoConfig{}, 1, &probe_);
};

TEST_F(VoNodeTest, SaysNoCalibrationUntilOneArrives) {
  EXPECT_EQ("image came before a calibration", take(image_bytes(1)));
  ASSERT_NE(nullptr, node_->motion()) << "later processes learn why there is no motion";
  EXPECT_EQ(vo_motion_t::STATUS_LOST, node_->motion()->status);
  EXPECT_EQ(vo_motion_t::REASON_NO_CALIBRATION, node_->motion()->reason);
  EXPECT_EQ(1, node_->motion()->seq);
  EXPECT_EQ(nullptr, node_->take_calibration(to_wire(kModel, 0)));
  EXPECT_EQ("", take(image_bytes(2)));
  ASSERT_NE(nullptr, node_->motion());
  EXPECT_EQ(2, node_->motion()->seq);
  EXPECT_EQ(200'000, node_->motion()->utime);
}

TEST_F(VoNodeTest, TakesTheFirstCalibrationAndRefusesADifferentOne) {
  CameraModel other = kModel;
  other.fx_px = -1.0;
  EXPECT_STREQ("calibration: focal length is outside [1, 100000]",
               node_->take_calibration(to_wire(other, 0)));
  EXPECT_FALSE(node_->calibrated());
  EXPECT_EQ(nullptr, node_->take_calibration(to_wire(kModel, 0)));
  EXPECT_EQ(nullptr, node_->take_calibration(to_wire(kModel, 1'000'000)))
      << "the calibration is repeated once a second";
  other.fx_px = 251.0;
  EXPECT_STREQ("calibration contradicts the earlier ones",
               node_->take_calibration(to_wire(other, 0)));
}

TEST_F(VoNodeTest, SaysThatThePrincipalPointIsOff) {
  EXPECT_EQ(node_->concern(), nullptr);
  node_->configure_camera(kModel);
  EXPECT_EQ(node_->concern(), nullptr);
  CameraModel off = kModel;
  off.cy_px = 80.0;
  node_ = std::make_unique<VoNode>(VoConfig{}, 1, &probe_);
  node_->configure_camera(off);
  EXPECT_STREQ(node_->concern(),
               "the calibration's principal point is more than 10 % of the picture off its middle");
}

TEST_F(VoNodeTest, KnowsAfterARestartWhatIsAttachedToTheCamera) {
  const test::TempFolder folder;
  VoConfig config;
  config.state_file = (folder / "attached.toml").string();
  vo::AttachedRegions known(kModel.width_px, kModel.height_px);
  std::vector<float> evidence(known.evidence().size());
  std::fill_n(evidence.begin(), evidence.size() / 2, 20.0F);
  known.restore(evidence);
  AttachedFile(config.state_file, kModel.width_px, kModel.height_px).save(known);

  node_ = std::make_unique<VoNode>(config, 1, &probe_);
  node_->configure_camera(kModel);
  EXPECT_EQ("", take(image_bytes(1)));
  EXPECT_EQ("", take(image_bytes(2)));
  EXPECT_NEAR(node_->motion()->attached_share, 0.5, 0.02);
  EXPECT_STREQ(node_->concern(), "much of the picture shows what is attached to the camera");
  std::filesystem::remove(config.state_file);
  node_.reset();
  EXPECT_TRUE(std::filesystem::exists(config.state_file)) << "it is written in the end";
}

TEST_F(VoNodeTest, RefusesWrongImagesAndGoesOn) {
  ASSERT_EQ(nullptr, node_->take_calibration(to_wire(kModel, 0)));
  for (std::int64_t seq = 1; seq <= 3; ++seq) EXPECT_EQ("", take(image_bytes(seq)));
  EXPECT_EQ("image size differs from the calibration", take(image_bytes(4, 160)));
  EXPECT_EQ(nullptr, node_->motion());
  EXPECT_EQ("not an image_t", take(Bytes(100)));
  EXPECT_EQ("", take(image_bytes(5)));
  EXPECT_EQ("the image was received before", take(image_bytes(5)));
  EXPECT_EQ(nullptr, node_->motion());
  EXPECT_EQ("", take(image_bytes(9)));
  EXPECT_EQ(1 + 3, node_->num_lost()) << "images 4, 6, 7 and 8";
}

TEST_F(VoNodeTest, FollowsASourceThatBeginsAnew) {
  ASSERT_EQ(nullptr, node_->take_calibration(to_wire(kModel, 0)));
  for (std::int64_t seq = 100; seq <= 105; ++seq) EXPECT_EQ("", take(image_bytes(seq)));
  EXPECT_EQ(104, node_->motion()->prev_seq);
  EXPECT_NEAR(0.1, node_->motion()->interval_s, 1e-9);
  EXPECT_NE("", take(image_bytes(0)));
  EXPECT_NE("", take(image_bytes(1)));
  EXPECT_EQ("", take(image_bytes(2))) << "three images agree among themselves";
  EXPECT_EQ(2, node_->motion()->seq);
  EXPECT_EQ(-1, node_->motion()->prev_seq) << "the motion since the earlier images is not known";
  EXPECT_TRUE(std::isnan(node_->motion()->interval_s));
  EXPECT_EQ("", take(image_bytes(3)));
  EXPECT_EQ(2, node_->motion()->prev_seq);
  EXPECT_NEAR(0.1, node_->motion()->interval_s, 1e-9);
}

class GroundNodeTest : public testing::Test {
 protected:
  GroundNodeTest()
      : node_(std::make_unique<GroundNode>(
            GroundConfig{}, DetectionsConfig{}, &probe_,
            [this](const ground_plane_t& plane, const ego_motion_t& ego) {
              EXPECT_EQ(plane.seq, ego.seq);
              results_.push_back(plane);
            })) {}

  void calibrate() { ASSERT_EQ(nullptr, node_->take_calibration(to_wire(kModel, 0))); }
  void image(std::int64_t seq) { EXPECT_EQ(nullptr, node_->take_image(image_bytes(seq))) << seq; }
  static vo_motion_t sample_motion(std::int64_t seq, std::int64_t session = 0) {
    vo_motion_t message;
    to_wire(test::sample_vo_output(), &message);
    message.seq = seq;
    message.session = session;
    message.prev_seq = seq - 1;
    message.utime = seq * 100'000;
    message.num_window = 0;
    return message;
  }
  void motion(std::int64_t seq) {
    EXPECT_EQ(nullptr, node_->take_motion(sample_motion(seq))) << seq;
  }
  // Sequence numbers of the results so far; negative where the image was missing.
  std::vector<std::int64_t> results() const {
    std::vector<std::int64_t> out;
    for (const ground_plane_t& plane : results_)
      out.push_back(plane.reason == ground_plane_t::REASON_IMAGE_MISSING ? -plane.seq : plane.seq);
    return out;
  }
  using Seqs = std::vector<std::int64_t>;

  NullProbe probe_;
  std::vector<ground_plane_t> results_;
  std::unique_ptr<GroundNode> node_;
};

TEST_F(GroundNodeTest, SaysNoCalibrationUntilOneArrives) {
  motion(1);
  ASSERT_EQ(1U, results_.size());
  EXPECT_EQ(ground_plane_t::STATUS_INVALID, results_[0].status);
  EXPECT_EQ(ground_plane_t::REASON_NO_CALIBRATION, results_[0].reason);
  EXPECT_STREQ("image came before a calibration", node_->take_image(image_bytes(2)));
}

TEST_F(GroundNodeTest, PairsMotionsThatTrailTheirImages) {
  calibrate();
  for (std::int64_t seq = 1; seq <= 5; ++seq) image(seq);
  for (std::int64_t seq = 1; seq <= 5; ++seq) motion(seq);
  EXPECT_EQ((Seqs{1, 2, 3, 4, 5}), results());
  EXPECT_EQ(0, node_->num_unpaired());
  EXPECT_EQ(0, node_->num_lost());
}

TEST_F(GroundNodeTest, LetsAMotionWaitForItsImage) {
  calibrate();
  motion(1);
  EXPECT_TRUE(node_->waiting());
  EXPECT_TRUE(results().empty());
  image(1);
  EXPECT_EQ((Seqs{1}), results());
  EXPECT_FALSE(node_->waiting());
  node_->expire();
  EXPECT_EQ((Seqs{1}), results()) << "no motion waits any more";
}

TEST_F(GroundNodeTest, ProcessesAMotionWithoutItsImageWhenTheNextOneComes) {
  calibrate();
  image(1);
  motion(1);
  motion(2);  // image 2 was lost
  EXPECT_EQ((Seqs{1}), results());
  image(3);
  motion(3);
  EXPECT_EQ((Seqs{1, -2, 3}), results());
  EXPECT_EQ(1, node_->num_unpaired());
  EXPECT_EQ(1, node_->num_lost());
}

TEST_F(GroundNodeTest, ProcessesAMotionWithoutItsImageWhenTimeIsUp) {
  calibrate();
  motion(1);
  node_->expire();
  EXPECT_EQ((Seqs{-1}), results());
  EXPECT_EQ(nullptr, node_->take_image(image_bytes(1))) << "a late image is no error";
  EXPECT_EQ((Seqs{-1}), results());
}

TEST_F(GroundNodeTest, NeedsTimeAndNumberToMatch) {
  calibrate();
  image(1);
  vo_motion_t message;
  to_wire(test::sample_vo_output(), &message);
  message.seq = 1;
  message.utime = 999;  // a time of another drive
  message.num_window = 0;
  EXPECT_EQ(nullptr, node_->take_motion(message));
  EXPECT_TRUE(node_->waiting());
}

TEST_F(GroundNodeTest, LetsTheOldestImageGiveWay) {
  calibrate();
  const auto last = std::int64_t{GroundConfig{}.images_kept} + 1;
  for (std::int64_t seq = 1; seq <= last; ++seq) image(seq);
  motion(1);
  EXPECT_TRUE(node_->waiting()) << "gone";
  motion(2);
  motion(last);
  EXPECT_EQ((Seqs{-1, 2, last}), results());
  EXPECT_EQ(1, node_->num_overflowed());
  EXPECT_EQ(1, node_->num_unpaired());
}

TEST_F(GroundNodeTest, CountsAMotionThatNeverCame) {
  calibrate();
  for (std::int64_t seq = 1; seq <= 4; ++seq) image(seq);
  motion(1);
  motion(2);
  motion(4);  // its previous image is 3
  EXPECT_EQ(1, node_->num_lost());
}

TEST_F(GroundNodeTest, RefusesMotionsThatComeTwiceOrOutOfOrder) {
  calibrate();
  for (std::int64_t seq = 1; seq <= 3; ++seq) motion(seq);
  EXPECT_STREQ("VO motion came twice or out of order", node_->take_motion(sample_motion(3)));
  EXPECT_STREQ("VO motion came twice or out of order", node_->take_motion(sample_motion(2)));
  motion(4);
}

TEST_F(GroundNodeTest, ANumberThatIsFarTooHighShutsOutNoMoreThanOneMotion) {
  calibrate();
  for (std::int64_t seq = 1; seq <= 3; ++seq) motion(seq);
  motion(1'000'000);
  EXPECT_STREQ("VO motion came twice or out of order", node_->take_motion(sample_motion(5)));
  EXPECT_EQ(nullptr, node_->take_motion(sample_motion(6)));
  EXPECT_EQ(nullptr, node_->take_motion(sample_motion(7)));
  node_->expire();
  EXPECT_EQ(7, results_.back().seq);
}

TEST_F(GroundNodeTest, FollowsARestartedSenderAtOnce) {
  calibrate();
  for (std::int64_t seq = 100; seq <= 102; ++seq) motion(seq);
  for (std::int64_t seq = 5; seq <= 8; ++seq) {
    EXPECT_EQ(nullptr, node_->take_motion(sample_motion(seq, 77))) << seq;
  }
  node_->expire();
  EXPECT_EQ(8, results_.back().seq);
}

TEST_F(GroundNodeTest, FollowsASenderWhoseClockWasSetBackAfterThreeMotions) {
  calibrate();
  for (std::int64_t seq = 100; seq <= 102; ++seq) {
    EXPECT_EQ(nullptr, node_->take_motion(sample_motion(seq, 77))) << seq;
  }
  for (std::int64_t seq = 5; seq <= 8; ++seq) {
    const char* why = node_->take_motion(sample_motion(seq, 66));
    if (seq < 7) {
      EXPECT_STREQ("VO motion comes from a second sender", why);
    } else {
      EXPECT_EQ(nullptr, why) << seq;
    }
  }
}

TEST_F(GroundNodeTest, ABrokenMotionDoesNotChangeWhomItFollows) {
  calibrate();
  for (std::int64_t seq = 100; seq <= 102; ++seq) motion(seq);
  for (std::int64_t seq = 5; seq <= 9; ++seq) {
    vo_motion_t broken = sample_motion(seq, 77);
    broken.status = 99;
    EXPECT_STREQ("VO motion: unknown status", node_->take_motion(broken));
  }
  motion(103);
}

TEST_F(GroundNodeTest, DoesNotWaitForAnImageThatWasLeftOut) {
  calibrate();
  EXPECT_EQ(nullptr, node_->skip_image(image_bytes(1)));
  motion(1);
  EXPECT_FALSE(node_->waiting());
  EXPECT_EQ((Seqs{-1}), results());
  image(2);
  motion(2);
  EXPECT_EQ((Seqs{-1, 2}), results());
  EXPECT_EQ(0, node_->num_lost()) << "it was left out, not lost";
}

TEST_F(GroundNodeTest, ASecondSenderChangesNothing) {
  calibrate();
  for (std::int64_t seq = 1; seq <= 9; ++seq) {
    EXPECT_EQ(nullptr, node_->take_motion(sample_motion(seq, 77)));
    EXPECT_STREQ("VO motion comes from a second sender",
                 node_->take_motion(sample_motion(seq + 50, 66)));
  }
}

TEST_F(GroundNodeTest, TakesDetectionsUntilTheirTurnIsOver) {
  detections_t message{};
  message.seq = 1;
  message.utime = 100'000;
  EXPECT_STREQ("detections came before a calibration", node_->take_detections(message));
  calibrate();
  EXPECT_EQ(nullptr, node_->take_detections(message));
  for (std::int64_t seq = 2; seq <= 4; ++seq) {
    image(seq);
    motion(seq);
  }
  message.seq = 2;
  message.utime = 200'000;
  EXPECT_STREQ("detections came later than ground.detections_delay_images allows",
               node_->take_detections(message));
  message.num_detections = -1;
  EXPECT_NE(nullptr, node_->take_detections(message));
}

/// Notes the camera height that it is given.
class HeightRecorder final : public GroundAlgorithm {
 public:
  explicit HeightRecorder(std::vector<double>* heights_m) : heights_m_(heights_m) {}
  const GroundOutput& update(const GroundInput& input, StageProbe& /*probe*/) override {
    heights_m_->push_back(input.camera_height.height_m);
    return output_;
  }

 private:
  std::vector<double>* heights_m_;
  GroundOutput output_;
};

TEST_F(GroundNodeTest, HandsTheNewestCameraHeightToEveryFrame) {
  std::vector<double> heights_m;
  node_ = std::make_unique<GroundNode>(
      GroundConfig{}, DetectionsConfig{}, &probe_,
      [](const ground_plane_t& /*plane*/, const ego_motion_t& /*ego*/) {}, GroundModel{},
      [&](const CameraModel&) { return std::make_unique<HeightRecorder>(&heights_m); });
  calibrate();
  image(1);
  motion(1);
  node_->set_camera_height({1.58, 0.01});
  image(2);
  motion(2);
  EXPECT_EQ(heights_m, (std::vector<double>{1.65, 1.58}));
}

TEST_F(GroundNodeTest, RefusesAMotionThatBreaksItsContract) {
  calibrate();
  vo_motion_t message;
  to_wire(test::sample_vo_output(), &message);
  message.num_road_points = 999;
  EXPECT_STREQ("VO motion: number of road points is out of range", node_->take_motion(message));
  EXPECT_TRUE(results().empty());
}

}  // namespace
}  // namespace plumb
