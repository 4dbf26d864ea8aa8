#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <string>

#include "modules/ground/ground.hpp"
#include "tests/ground/road_scene.hpp"

namespace plumb {
namespace {

/// Images and VO's results of one drive, which is rendered once for all tests of this program.
struct Footage {
  explicit Footage(int num_frames) {
    drive.pitch_amplitude_rad = 0.006;
    drive.turn_left_rad = 0.01;
    poses = drive.poses(num_frames);
    for (int k = 0; k < num_frames; ++k) {
      const auto i = static_cast<std::size_t>(k);
      images.push_back(test::render(camera, poses[i], {.noise_grey = 1.0},
                                    100U + static_cast<std::uint32_t>(k)));
    }
  }
  test::Drive drive;
  CameraModel camera = test::scene_camera();
  std::vector<Se3> poses;
  std::vector<test::GreyImage> images;
};

const Footage& footage() {
  static const Footage shared(36);
  return shared;
}

struct Rehearsal {
  const GroundOutput& step(int k) {
    VoOutput vo;
    test::script_vo(footage().poses, k, script, &vo);
    vo.scale_epoch = epoch;
    vo.scale_carry_std = carry_std;
    return step(vo, k);
  }
  const GroundOutput& step(const VoOutput& vo, int k,
                           std::span<const ObjectsMeasurement> objects = {}) {
    GroundInput input;
    input.vo = &vo;
    input.objects = objects;
    if (with_images) input.image = footage().images[static_cast<std::size_t>(k)].view();
    return estimator.update(input, probe);
  }
  [[nodiscard]] double scale_error(const GroundOutput& out) const {
    return out.ego.log_scale - std::log(script.metres_per_vo);
  }

  GroundEstimator estimator{GroundConfig{}, footage().camera};
  NullProbe probe;
  test::VoScript script;
  int epoch = 0;
  double carry_std = 0.0;
  bool with_images = true;
};

TEST(GroundEstimator, MeasuresPlaneScaleAndMotionOfARenderedDrive) {
  Rehearsal run;
  for (int k = 0; k < 36; ++k) {
    const GroundOutput& out = run.step(k);
    if (k < 2) {
      EXPECT_EQ(out.plane.status, GroundStatus::kInitializing);
      continue;
    }
    const test::TruePlane truth = test::plane_in(footage().poses[static_cast<std::size_t>(k)]);
    ASSERT_EQ(out.plane.status, GroundStatus::kOk) << "frame " << k;
    EXPECT_EQ(out.plane.reason, GroundReason::kNone);
    EXPECT_NEAR(out.plane.height_m, truth.height_m, 0.03 * truth.height_m) << "frame " << k;
    EXPECT_NEAR(out.plane.pitch_rad, std::asin(truth.normal_cam.z()), 0.006) << "frame " << k;
    EXPECT_NEAR(out.plane.roll_rad, std::atan2(truth.normal_cam.x(), truth.normal_cam.y()), 0.012);
    if (k < 3) continue;  // one image alone does not make a scale
    EXPECT_EQ(out.ego.status, EgoStatus::kOk) << "frame " << k;
    EXPECT_NEAR(run.scale_error(out), 0.0, k < 12 ? 0.04 : 0.015) << "frame " << k;
  }
}

TEST(GroundEstimator, AJumpOfVosSpeedLosesTheScaleUntilItIsMeasuredAnew) {
  Rehearsal run;
  for (int k = 0; k < 16; ++k) run.step(k);
  VoOutput vo;
  test::script_vo(footage().poses, 16, run.script, &vo);
  vo.T_prev_cam.t *= 3.0;
  EXPECT_EQ(run.step(vo, 16).ego.status, EgoStatus::kInitializing);
  for (int k = 17; k < 21; ++k) EXPECT_EQ(run.step(k).ego.status, EgoStatus::kInitializing);
  for (int k = 21; k < 30; ++k) run.step(k);
  EXPECT_EQ(run.step(30).ego.status, EgoStatus::kOk);
  EXPECT_NEAR(run.scale_error(run.step(31)), 0.0, 0.04);
}

TEST(GroundEstimator, ScaleIsKnownLessTheLongerNoCueSeesTheRoad) {
  Rehearsal run;
  VoOutput vo;
  for (int k = 0; k < 10; ++k) run.step(k);
  const double before = run.step(10).ego.log_scale_std;
  double last = before;
  run.with_images = false;
  for (int k = 11; k < 36; ++k) {
    test::script_vo(footage().poses, k, run.script, &vo);
    vo.road_points.clear();
    const GroundOutput& out = run.step(vo, k);
    EXPECT_EQ(out.ego.status, EgoStatus::kScaleHeld);
    EXPECT_GE(out.ego.log_scale_std, last);
    last = out.ego.log_scale_std;
  }
  EXPECT_GT(last, 1.2 * before);
}

TEST(GroundEstimator, IntegratedPathEndsWhereTheDriveEnds) {
  Rehearsal run;
  Se3 pose;
  for (int k = 0; k < 36; ++k) pose = run.step(k).ego.T_world_cam;
  const Se3 truth = footage().poses[0].inverse() * footage().poses[35];
  EXPECT_LT((pose.t - truth.t).norm(), 0.015 * truth.t.norm());
}

/// Returns the rms error of n3 from frame 10 on in a run without images from frame 6 on. The n3 of
/// the objects is off by `bias`.
double pitch_error(bool with_objects, double bias, CueStatus* last_status) {
  Rehearsal run;
  double sum = 0.0;
  for (int k = 0; k < 36; ++k) {
    VoOutput vo;
    test::script_vo(footage().poses, k, run.script, &vo);
    run.with_images = k < 6;
    const double n3 = test::plane_in(footage().poses[static_cast<std::size_t>(k)]).normal_cam.z();
    const ObjectsMeasurement objects{n3 + bias, 1e-6, 1e-6, 1.0};
    const GroundOutput& out = run.step(
        vo, k, with_objects ? std::span{&objects, 1} : std::span<const ObjectsMeasurement>{});
    *last_status = out.plane.cues[kCueObjects].status;
    if (k >= 10) sum += (out.plane.normal_cam.z() - n3) * (out.plane.normal_cam.z() - n3);
  }
  return std::sqrt(sum / 26.0);
}

TEST(GroundEstimator, DetectedObjectsCarryThePitchWhenTheRoadIsNotSeen) {
  CueStatus status{};
  const double without = pitch_error(false, 0.0, &status);
  EXPECT_EQ(status, CueStatus::kAbsent);
  const double with = pitch_error(true, 0.0, &status);
  EXPECT_EQ(status, CueStatus::kUsed);
  EXPECT_LT(with, 0.7 * without) << with << " against " << without;
  const double contradicted = pitch_error(true, 0.1, &status);
  EXPECT_EQ(status, CueStatus::kGated);
  EXPECT_DOUBLE_EQ(contradicted, without) << "what is refused changes nothing";
}

TEST(GroundEstimator, ObjectsTellNothingBeforeThereIsAPlaneOrAtRest) {
  Rehearsal run;
  const ObjectsMeasurement objects{0.0, 1e-6, 1e-6, 1.0};
  VoOutput vo;
  test::script_vo(footage().poses, 0, run.script, &vo);
  EXPECT_EQ(run.step(vo, 0, {&objects, 1}).plane.cues[kCueObjects].status, CueStatus::kAbsent);
  for (int k = 1; k < 8; ++k) run.step(k);
  test::script_vo(footage().poses, 8, run.script, &vo);
  vo.status = VoStatus::kStandstill;
  const double before = run.step(7).plane.cov(0, 0);
  for (int k = 0; k < 20; ++k) {
    const GroundOutput& out = run.step(vo, 8, {&objects, 1});
    EXPECT_EQ(out.plane.cues[kCueObjects].status, CueStatus::kAbsent);
    EXPECT_GT(out.plane.cov(0, 0), 0.5 * before);
  }
}

TEST(GroundEstimator, WorksOnPointsWhenImagesAreMissing) {
  Rehearsal run;
  run.with_images = false;
  for (int k = 0; k < 30; ++k) {
    const GroundOutput& out = run.step(k);
    EXPECT_EQ(out.plane.cues[kCueDense].status, CueStatus::kAbsent);
    if (k < 5) continue;
    EXPECT_EQ(out.plane.status, GroundStatus::kOk);
    EXPECT_EQ(out.plane.reason, GroundReason::kImageMissing);
    EXPECT_NEAR(run.scale_error(out), 0.0, 0.03);
  }
}

// At high speed VO may track nothing nearby. Then the image of the road alone has to start the
// scale.
TEST(GroundEstimator, StartsFromTheRoadAloneWhenNoPointsLieOnIt) {
  Rehearsal run;
  for (int k = 0; k < 36; ++k) {
    VoOutput vo;
    test::script_vo(footage().poses, k, run.script, &vo);
    vo.road_points.clear();
    const GroundOutput& out = run.step(vo, k);
    EXPECT_NE(out.plane.cues[kCuePoints].status, CueStatus::kUsed);
    if (k < 4) continue;
    ASSERT_EQ(out.plane.status, GroundStatus::kOk) << "frame " << k;
    EXPECT_NEAR(run.scale_error(out), 0.0, k < 12 ? 0.04 : 0.015) << "frame " << k;
  }
}

TEST(GroundEstimator, HoldsThePlaneWithNeitherImageNorPoints) {
  Rehearsal run;
  for (int k = 0; k < 20; ++k) run.step(k);
  run.with_images = false;
  run.script.num_points = run.script.num_outliers = 0;
  const GroundOutput& out = run.step(20);
  EXPECT_EQ(out.plane.status, GroundStatus::kHeld);
  EXPECT_EQ(out.plane.reason, GroundReason::kImageMissing);
  EXPECT_NEAR(out.plane.height_m, test::kRoadHeight, 0.02 * test::kRoadHeight);
  EXPECT_EQ(out.ego.status, EgoStatus::kScaleHeld);
}

TEST(GroundEstimator, RefusesAnImageOfAnotherSize) {
  Rehearsal run;
  for (int k = 0; k < 10; ++k) run.step(k);
  VoOutput vo;
  test::script_vo(footage().poses, 10, run.script, &vo);
  const test::GreyImage small(320, 120);
  const GroundOutput& out = run.estimator.update({&vo, small.view()}, run.probe);
  EXPECT_EQ(out.plane.reason, GroundReason::kImageMissing);
}

TEST(GroundEstimator, FreezesAtStandstill) {
  Rehearsal run;
  GroundOutput before;
  for (int k = 0; k < 20; ++k) before = run.step(k);
  for (int k = 20; k < 60; ++k) {
    VoOutput vo;
    vo.seq = k;
    vo.prev_seq = k - 1;
    vo.capture_us = 100'000LL * k + 1'000'000;
    vo.status = VoStatus::kStandstill;
    const GroundOutput& out = run.step(vo, 19);
    EXPECT_EQ(out.plane.status, GroundStatus::kHeld);
    EXPECT_EQ(out.plane.reason, GroundReason::kStandstill);
    EXPECT_EQ(out.ego.status, EgoStatus::kStandstill);
    EXPECT_EQ(out.ego.log_scale, before.ego.log_scale);
    EXPECT_EQ(out.plane.normal_cam, before.plane.normal_cam);
    EXPECT_EQ(out.ego.T_world_cam.t, before.ego.T_world_cam.t);
  }
}

TEST(GroundEstimator, FollowsANewUnitWhoseRatioIsRoughlyKnown) {
  Rehearsal run;
  for (int k = 0; k < 18; ++k) run.step(k);
  run.script.metres_per_vo *= 1.2;
  run.epoch = 1;
  run.carry_std = 0.15;
  for (int k = 18; k < 22; ++k) run.step(k);
  const GroundOutput& out = run.step(22);
  EXPECT_NEAR(run.scale_error(out), 0.0, 0.02);
}

// After a long gap the carried unit may be off by more than the dense cue's sweep reaches.
TEST(GroundEstimator, FindsANewUnitFarFromTheOneCarried) {
  for (const double factor : {0.45, 1.0, 2.2}) {
    Rehearsal run;
    for (int k = 0; k < 18; ++k) run.step(k);
    run.script.metres_per_vo *= factor;
    run.epoch = 1;
    run.carry_std = 0.6;
    for (int k = 18; k < 22; ++k) run.step(k);
    const GroundOutput& out = run.step(22);
    EXPECT_NEAR(run.scale_error(out), 0.0, 0.03) << factor;
    EXPECT_LT(out.ego.log_scale_std, 0.1) << factor;
  }
}

TEST(GroundEstimator, StartsAnewInAUnitOfUnknownRatioWithoutLosingItsPlace) {
  Rehearsal run;
  for (int k = 0; k < 18; ++k) run.step(k);
  run.script.metres_per_vo = 0.4;
  run.epoch = 1;
  run.carry_std = std::numeric_limits<double>::quiet_NaN();
  GroundOutput out;
  for (int k = 18; k < 36; ++k) out = run.step(k);
  EXPECT_NEAR(run.scale_error(out), 0.0, 0.015);
  EXPECT_EQ(out.ego.reset_counter, 0);
  const Se3 truth = footage().poses[0].inverse() * footage().poses[35];
  EXPECT_LT((out.ego.T_world_cam.t - truth.t).norm(), 0.02 * truth.t.norm());
}

TEST(GroundEstimator, SaysThatVoIsLost) {
  Rehearsal run;
  for (int k = 0; k < 10; ++k) run.step(k);
  VoOutput vo;
  vo.seq = 10;
  vo.prev_seq = 9;
  vo.status = VoStatus::kLost;
  const GroundOutput& out = run.step(vo, 10);
  EXPECT_EQ(out.plane.status, GroundStatus::kInvalid);
  EXPECT_EQ(out.plane.reason, GroundReason::kVoLost);
  EXPECT_EQ(out.ego.status, EgoStatus::kLost);
}

TEST(GroundEstimator, RepeatsItselfBitForBit) {
  Rehearsal first, second;
  for (int k = 0; k < 30; ++k) {
    const GroundOutput& a = first.step(k);
    const GroundOutput& b = second.step(k);
    EXPECT_EQ(a.plane.status, b.plane.status);
    if (!std::isnan(a.plane.height_m)) {
      EXPECT_EQ(a.plane.height_m, b.plane.height_m);
      EXPECT_EQ(a.plane.normal_cam, b.plane.normal_cam);
    }
    EXPECT_EQ(a.ego.T_world_cam.t, b.ego.T_world_cam.t);
    EXPECT_EQ(a.ego.cov_world_cam, b.ego.cov_world_cam);
  }
}

TEST(GroundEstimator, ReportsInnovationsAndTestRatiosOfTheCuesThatItFused) {
  Rehearsal run;
  for (int k = 0; k < 12; ++k) {
    const GroundOutput& out = run.step(k);
    if (k < 6) continue;
    const CueReport& dense = out.plane.cues[kCueDense];
    ASSERT_EQ(dense.status, CueStatus::kUsed);
    EXPECT_TRUE(dense.innovation.allFinite());
    EXPECT_LT(dense.innovation.cwiseAbs().maxCoeff(), 0.1);
    EXPECT_GE(dense.test_ratio, 0.0);
    EXPECT_LT(dense.test_ratio, 1.0);
    const CueReport& points = out.plane.cues[kCuePoints];
    EXPECT_TRUE(std::isnan(points.innovation(0)));
    EXPECT_LT(std::abs(points.innovation(2)), 0.1);
    EXPECT_TRUE(std::isnan(out.plane.cues[kCueObjects].test_ratio)) << "there are no objects";
  }
}

TEST(GroundEstimator, FollowsACameraWhoseHeightChanges) {
  GroundConfig config;
  config.camera_height_m = test::kRoadHeight;
  GroundEstimator estimator(config, footage().camera);
  NullProbe probe;
  test::VoScript script;
  double before = 0.0;
  for (int k = 0; k < 24; ++k) {
    VoOutput vo;
    test::script_vo(footage().poses, k, script, &vo);
    GroundInput input{&vo, footage().images[static_cast<std::size_t>(k)].view()};
    // From image 20 on, another source says that the camera stands 4 % higher. The pictures still
    // show the old height, so that the scale has to move towards them afterwards.
    if (k >= 20) input.camera_height = {1.04 * test::kRoadHeight, 0.02 * test::kRoadHeight};
    const GroundOutput& out = estimator.update(input, probe);
    if (k < 20) before = out.ego.log_scale;
    EXPECT_TRUE(k != 19 || out.ego.log_scale_std < 0.02);
    if (k != 20) continue;
    EXPECT_NEAR(out.ego.log_scale, before, 0.02) << "the scale does not jump";
    EXPECT_GT(out.ego.log_scale_std, 0.02) << "it is as uncertain as the height";
  }
}

TEST(GroundEstimator, SettingsOfTheFilterTakeEffect) {
  const auto log_scale_std = [](const GroundConfig& config) {
    GroundEstimator estimator(config, footage().camera);
    NullProbe probe;
    test::VoScript script;
    double std = 0.0;
    for (int k = 0; k < 12; ++k) {
      VoOutput vo;
      test::script_vo(footage().poses, k, script, &vo);
      std = estimator.update({&vo, footage().images[static_cast<std::size_t>(k)].view()}, probe)
                .ego.log_scale_std;
    }
    return std;
  };
  const double usual = log_scale_std({});
  GroundConfig drifting;
  drifting.filter.scale_drift_std = 0.1;
  EXPECT_GT(log_scale_std(drifting), 1.5 * usual);
  GroundConfig strict;
  strict.filter.start_dense_quality = strict.filter.least_dense_quality = 1.0;
  strict.filter.start_points = strict.filter.least_points = 1000;
  EXPECT_TRUE(std::isnan(log_scale_std(strict))) << "no cue is good enough to start";
}

/// Records the names of the stages in order.
class NamesProbe final : public StageProbe {
 public:
  void begin() override { names_ = "begin"; }
  void mark(const char* name) override { names_ += std::string(" ") + name; }
  [[nodiscard]] const std::string& names() const { return names_; }

 private:
  std::string names_;
};

TEST(GroundEstimator, MarksEveryStageInEveryFrame) {
  Rehearsal run;
  NamesProbe probe;
  for (int k = 0; k < 6; ++k) {
    VoOutput vo;
    test::script_vo(footage().poses, k, run.script, &vo);
    run.estimator.update({&vo, footage().images[static_cast<std::size_t>(k)].view()}, probe);
    EXPECT_EQ(probe.names(), "begin pyramid dense points objects motion fuse ego");
  }
}

}  // namespace
}  // namespace plumb
