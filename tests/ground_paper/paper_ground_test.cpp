#include "modules/ground_paper/paper_ground.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "modules/chain/ground_algorithm.hpp"
#include "modules/chain/plumb_config.hpp"
#include "platform/config.hpp"
#include "tests/ground/road_scene.hpp"
#include "tests/ground_paper/car_boxes.hpp"
#include "tests/support/temp_folder.hpp"

namespace plumb {
namespace {

constexpr int kNumFrames = 24;

/// Images and VO's results of one drive, which is rendered once for all tests of this program.
struct Footage {
  Footage() {
    drive.pitch_amplitude_rad = 0.004;
    drive.turn_left_rad = 0.005;
    poses = drive.poses(kNumFrames);
    for (std::size_t k = 0; k < kNumFrames; ++k) {
      images.push_back(test::render(camera, poses[k], {.noise_grey = 1.0},
                                    100U + static_cast<std::uint32_t>(k)));
    }
  }
  test::Drive drive;
  CameraModel camera = test::scene_camera();
  std::vector<Se3> poses;
  std::vector<test::GreyImage> images;
};

const Footage& footage() {
  static const Footage shared;
  return shared;
}

PlumbConfig paper_config(const char* cues = "all", const char* covariance = "learned") {
  PlumbConfig config;
  config.ground_mode = "paper";
  config.ground_paper.cues = cues;
  config.ground.covariance = covariance;
  return config;
}

struct Rehearsal {
  explicit Rehearsal(const PlumbConfig& config)
      : ground(config.ground, config.ground_paper, config.detections, footage().camera) {}

  const GroundOutput& step(int k, const DetectionFrame* boxes = nullptr) {
    test::script_vo(footage().poses, k, script, &vo);
    vo.scale_epoch = epoch;
    vo.scale_carry_std = carry_std;
    GroundInput input;
    input.vo = &vo;
    input.due.frame = boxes;
    if (with_images) input.image = footage().images[static_cast<std::size_t>(k)].view();
    return ground.update(input, probe);
  }
  [[nodiscard]] double scale_error(const GroundOutput& out) const {
    return out.ego.log_scale - std::log(script.metres_per_vo);
  }

  PaperGround ground;
  NullProbe probe;
  test::VoScript script;
  VoOutput vo;
  int epoch = 0;
  double carry_std = 0.0;
  bool with_images = true;
};

TEST(PaperGround, MeasuresPlaneScaleAndMotionOfARenderedDrive) {
  Rehearsal run(paper_config());
  GroundOutput out;
  for (int k = 0; k < kNumFrames; ++k) {
    out = run.step(k);
    if (k < 6) continue;
    const test::TruePlane truth = test::plane_in(footage().poses[static_cast<std::size_t>(k)]);
    ASSERT_EQ(out.plane.status, GroundStatus::kOk) << "frame " << k;
    EXPECT_EQ(out.plane.cues[kCueDense].status, CueStatus::kUsed);
    EXPECT_EQ(out.plane.cues[kCuePoints].status, CueStatus::kUsed);
    EXPECT_NEAR(out.plane.height_m, truth.height_m, 0.05 * truth.height_m) << "frame " << k;
    EXPECT_NEAR(run.scale_error(out), 0.0, 0.05) << "frame " << k;
    EXPECT_NEAR(out.plane.pitch_rad, std::asin(truth.normal_cam.z()), 0.01) << "frame " << k;
    EXPECT_EQ(out.ego.status, EgoStatus::kOk);
  }
  const Se3 truth = footage().poses[0].inverse() * footage().poses[kNumFrames - 1];
  EXPECT_LT((out.ego.T_world_cam.t - truth.t).norm(), 0.05 * truth.t.norm());
}

TEST(PaperGround, FindsTheScaleWithEitherCueAlone) {
  for (const char* cue : {"dense", "points"}) {
    Rehearsal run(paper_config(cue));
    for (int k = 0; k < kNumFrames; ++k) {
      const GroundOutput& out = run.step(k);
      const bool dense = std::string(cue) == "dense";
      EXPECT_EQ(out.plane.cues[dense ? kCuePoints : kCueDense].status, CueStatus::kAbsent);
      if (k < 8) continue;
      ASSERT_EQ(out.plane.status, GroundStatus::kOk) << cue << " frame " << k;
      EXPECT_NEAR(run.scale_error(out), 0.0, dense ? 0.05 : 0.12) << cue << " frame " << k;
    }
  }
}

TEST(PaperGround, FixedCovariancesDoNotFollowTheConfidence) {
  Rehearsal learned(paper_config());
  Rehearsal fixed(paper_config("all", "fixed"));
  const PaperModel model = built_in_paper_model();
  for (int k = 0; k < 10; ++k) {
    const GroundOutput& a = learned.step(k);
    const GroundOutput& b = fixed.step(k);
    if (k < 6) continue;
    const CueReport& adaptive = a.plane.cues[kCueDense];
    ASSERT_EQ(adaptive.num_features, 3);
    EXPECT_DOUBLE_EQ(adaptive.n1_var, model.dense_n1.of(adaptive.features[1]));
    EXPECT_DOUBLE_EQ(b.plane.cues[kCueDense].n1_var, model.dense_n1.mean);
    EXPECT_DOUBLE_EQ(b.plane.cues[kCueDense].n3_var, model.dense_n3.mean);
    EXPECT_GT(a.plane.cues[kCuePoints].features[0], 0.0);
  }
}

TEST(PaperGround, TakesObjectsIntoTheSameFusion) {
  Rehearsal without(paper_config());
  Rehearsal with(paper_config());
  const DetectionFrame boxes = test::cars_at_pitch(footage().camera, 0.03, {12.0, 25.0});
  GroundOutput a, b;
  for (int k = 0; k < 10; ++k) {
    a = without.step(k);
    b = with.step(k, &boxes);
  }
  EXPECT_EQ(a.plane.cues[kCueObjects].status, CueStatus::kAbsent);
  EXPECT_EQ(b.plane.cues[kCueObjects].status, CueStatus::kUsed);
  EXPECT_NEAR(b.plane.cues[kCueObjects].n3, std::sin(0.03), 1e-6);
  // Two objects of the mean variance, each an observation of its own.
  EXPECT_DOUBLE_EQ(b.plane.cues[kCueObjects].n3_var, 0.5 * built_in_paper_model().objects_n3.mean);
  EXPECT_LT(std::abs(b.plane.normal_cam.z() - 0.03), std::abs(a.plane.normal_cam.z() - 0.03));
}

TEST(PaperGround, HoldsTheScaleWithoutImages) {
  Rehearsal run(paper_config());
  for (int k = 0; k < 12; ++k) run.step(k);
  run.with_images = false;
  const double before = run.step(12).ego.log_scale;
  const GroundOutput& out = run.step(13);
  EXPECT_EQ(out.plane.status, GroundStatus::kHeld);
  EXPECT_EQ(out.plane.reason, GroundReason::kImageMissing);
  EXPECT_EQ(out.ego.status, EgoStatus::kScaleHeld);
  EXPECT_DOUBLE_EQ(out.ego.log_scale, before);
}

TEST(PaperGround, BeginsAnewInANewUnit) {
  Rehearsal run(paper_config());
  for (int k = 0; k < 10; ++k) run.step(k);
  run.epoch = 1;
  run.carry_std = std::numeric_limits<double>::quiet_NaN();
  run.script.metres_per_vo = 4.0;
  EXPECT_EQ(run.step(10).plane.status, GroundStatus::kInitializing);
  GroundOutput out;
  for (int k = 11; k < 18; ++k) out = run.step(k);
  EXPECT_EQ(out.plane.status, GroundStatus::kOk);
  EXPECT_NEAR(run.scale_error(out), 0.0, 0.08);
}

TEST(PaperGround, RepeatsItselfBitForBit) {
  Rehearsal first(paper_config()), second(paper_config());
  for (int k = 0; k < 12; ++k) {
    const GroundOutput& a = first.step(k);
    const GroundOutput& b = second.step(k);
    EXPECT_EQ(a.plane.status, b.plane.status);
    if (!std::isnan(a.plane.height_m)) {
      EXPECT_EQ(a.plane.height_m, b.plane.height_m);
      EXPECT_EQ(a.plane.normal_cam, b.plane.normal_cam);
    }
    EXPECT_EQ(a.ego.T_world_cam.t, b.ego.T_world_cam.t);
  }
}

TEST(GroundFactory, MakesTheConfiguredAlgorithm) {
  const auto ours = ground_factory(PlumbConfig{}, TrainedModels{})(footage().camera);
  const auto paper = ground_factory(paper_config(), TrainedModels{})(footage().camera);
  EXPECT_NE(dynamic_cast<GroundEstimator*>(ours.get()), nullptr);
  EXPECT_NE(dynamic_cast<PaperGround*>(paper.get()), nullptr);
}

/// Returns the error of loading `text`, or "" when it is accepted.
std::string refusal(const std::string& text) {
  const test::TempFile file(".toml", text);
  PlumbConfig config;
  try {
    load_config(file.path(), &config);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

TEST(PaperSettings, AreTakenAndRefusedLikeAllOthers) {
  EXPECT_EQ(refusal("[ground]\nmode = 'paper'\ncues = 'dense'\n[ground.paper]\nrho = 1.2\n"), "");
  const auto says = [](const std::string& text, const char* part) {
    return refusal(text).find(part) != std::string::npos;
  };
  EXPECT_TRUE(says("[ground]\nmode = 'article'\n", ":2: ground.mode = 'article' is none of"));
  EXPECT_TRUE(says("[ground]\ncues = 'objects'\n", "is none of all, dense, points"));
  EXPECT_TRUE(says("[ground]\ncovariance = 1\n", "is not text in quotes"));
  EXPECT_TRUE(says("[ground.paper]\nrho = 1.0\n", "ground.paper.rho = 1.0 is outside"));
  EXPECT_TRUE(says("[ground.paper]\nmu = nan\n", "ground.paper.mu = nan is outside"));
  EXPECT_TRUE(says("[ground.paper]\nroh = 1.5\n", "did you mean ground.paper.rho?"));
}

}  // namespace
}  // namespace plumb
