#include "modules/ground/cues/dense_alignment.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/numbers.hpp"
#include "modules/ground/covariance/fixed_covariance.hpp"
#include "tests/ground/road_scene.hpp"
#include "tests/support/central_difference.hpp"

namespace plumb {
namespace {

constexpr double kMetresPerVo = 1.3;

CameraModel camera_read_in(double readout_s) {
  CameraModel camera = test::scene_camera();
  camera.readout_s = readout_s;
  return camera;
}

/// Three views of one road: the newest one, one step earlier and three steps earlier. The rows are
/// read within `readout_s`, while the cue is given `told_s`.
struct Views {
  explicit Views(const test::Shutter& now_shutter, const test::Shutter& old_shutter = {},
                 double turn_left_rad = 0.0, double readout_s = 0.0, double told_s = 0.0)
      : camera(camera_read_in(readout_s)), ring(camera) {
    test::Drive drive;
    drive.mount_pitch_rad = 0.02;
    drive.mount_roll_rad = -0.015;
    drive.pitch_amplitude_rad = 0.004;
    drive.turn_left_rad = turn_left_rad;
    const std::vector<Se3> poses = drive.poses(4);
    truth = test::plane_in(poses[3]);
    for (std::uint32_t k = 0; k < 4; ++k) {
      test::Shutter shutter = k == 3 ? now_shutter : old_shutter;
      shutter.step = poses[0].inverse() * poses[1];
      const test::GreyImage image = test::render(camera, poses[k], shutter, k + 1);
      now = &ring.push(k, image.view());
    }
    test::script_vo(poses, 3, {.metres_per_vo = kMetresPerVo, .first_ok_frame = 0}, &vo);
    RowClock clock(camera_read_in(told_s));
    clock.take(2, vo.capture_us - 100'000);
    clock.take(3, vo.capture_us);
    pairs = choose_image_pairs(vo, ring, clock, truth.height_m / kMetresPerVo);
  }

  [[nodiscard]] DenseRequest request(double height_error_ratio) const {
    DenseRequest out;
    out.normal_cam = Eigen::Vector3d(0.0, 1.0, 0.01).normalized();
    out.height = height_error_ratio * truth.height_m / kMetresPerVo;
    out.sweep_ln_range = 0.45;
    out.road = {3.3, 12.0, 1.0, 0.0};
    return out;
  }

  CameraModel camera;
  ImageRing ring;
  const Pyramid* now = nullptr;
  test::TruePlane truth{};
  VoOutput vo;
  ImagePairs pairs;
};

/// Errors of ln h and of the normal's angle in degrees.
struct Errors {
  double ln_height;
  double angle_deg;
};

Errors errors_of(const DenseMeasurement& seen, const Views& views) {
  const double height = kMetresPerVo / seen.q.norm();
  const double cosine = std::min(1.0, seen.q.normalized().dot(views.truth.normal_cam));
  return {std::log(height / views.truth.height_m), std::acos(cosine) / kDegree};
}

TEST(DenseAlignment, ChoosesAShortAndALongBaseline) {
  const Views views({});
  ASSERT_EQ(views.pairs.size(), 2U);
  EXPECT_EQ(views.pairs[0].old_image, views.ring.find(2));
  EXPECT_EQ(views.pairs[1].old_image, views.ring.find(0));
}

TEST(DenseAlignment, FindsTheRenderedPlane) {
  Views views({});
  DenseAlignment cue(views.ring.camera(), views.ring.num_levels());
  for (const double start : {0.7, 1.0, 1.4}) {
    const DenseMeasurement seen = cue.measure(*views.now, views.pairs, views.request(start));
    ASSERT_TRUE(seen.ok);
    const Errors errors = errors_of(seen, views);
    EXPECT_LT(std::abs(errors.ln_height), 0.004) << "start " << start;
    EXPECT_LT(errors.angle_deg, 0.1) << "start " << start;
    EXPECT_GT(seen.ncc, 0.95);
    EXPECT_LT(seen.still_ncc, 0.5);
  }
}

TEST(DenseAlignment, TakesNothingForRoadThatTravelsWithTheCamera) {
  // The back of a truck fills the view. The newest image equals the oldest one, whatever motion VO
  // reports.
  Views views({});
  const Pyramid* back = views.pairs[views.pairs.size() - 1].old_image;
  DenseAlignment cue(views.ring.camera(), views.ring.num_levels());
  const DenseMeasurement seen = cue.measure(*back, views.pairs, views.request(1.0));
  EXPECT_FALSE(seen.ok);
  EXPECT_GT(seen.still_ncc, 0.99);
}

TEST(DenseAlignment, FindsThePlaneInATurn) {
  Views views({}, {}, 0.03);
  DenseAlignment cue(views.ring.camera(), views.ring.num_levels());
  const DenseMeasurement seen = cue.measure(*views.now, views.pairs, views.request(1.0));
  ASSERT_TRUE(seen.ok);
  EXPECT_LT(std::abs(errors_of(seen, views).ln_height), 0.005);
}

TEST(DenseAlignment, KnowsThatRowsAreExposedOneAfterTheOther) {
  for (const double turn_left_rad : {0.0, 0.04}) {
    Views told({}, {}, turn_left_rad, 0.03, 0.03);
    DenseAlignment cue(told.ring.camera(), told.ring.num_levels());
    const DenseMeasurement seen = cue.measure(*told.now, told.pairs, told.request(1.0));
    ASSERT_TRUE(seen.ok);
    EXPECT_LT(std::abs(errors_of(seen, told).ln_height), 0.012) << turn_left_rad;
    EXPECT_LT(errors_of(seen, told).angle_deg, 0.35) << turn_left_rad;

    Views untold({}, {}, turn_left_rad, 0.03, 0.0);
    const DenseMeasurement wrong = cue.measure(*untold.now, untold.pairs, untold.request(1.0));
    EXPECT_GT(std::abs(errors_of(wrong, untold).ln_height), 0.02) << turn_left_rad;
  }
}

TEST(RowClock, SharesTheMotionBetweenTwoImagesOutOverTheRows) {
  const CameraModel camera = camera_read_in(0.02);
  RowClock clock(camera);
  clock.take(4, 1'000'000);
  EXPECT_EQ(clock.lag_per_y(1), 0.0);
  clock.take(6, 1'200'000);  // one image is missing
  // From the first row to the last y grows by height / fy, and 0.02 s pass.
  const double all_rows = camera.height_px / camera.fy_px;
  EXPECT_NEAR(clock.lag_per_y(1) * all_rows, 0.02 / 0.1, 1e-12);
  EXPECT_NEAR(clock.lag_per_y(4) * all_rows, 0.02 / 0.4, 1e-12);
}

TEST(DenseAlignment, WithstandsExposureBlurAndNoise) {
  Views views({.gain = 0.8, .bias = 15.0, .noise_grey = 2.0, .blur_px = 1}, {.noise_grey = 2.0});
  DenseAlignment cue(views.ring.camera(), views.ring.num_levels());
  const DenseMeasurement seen = cue.measure(*views.now, views.pairs, views.request(1.2));
  ASSERT_TRUE(seen.ok);
  const Errors errors = errors_of(seen, views);
  EXPECT_LT(std::abs(errors.ln_height), 0.015);
  EXPECT_LT(errors.angle_deg, 0.3);
}

TEST(DenseAlignment, RefusesAFeaturelessRoadsTilt) {
  // The road shows nothing but noise, so no result may claim to be certain.
  Views views({.gain = 0.0, .bias = 120.0, .noise_grey = 2.0},
              {.gain = 0.0, .bias = 120.0, .noise_grey = 2.0});
  DenseAlignment cue(views.ring.camera(), views.ring.num_levels());
  const DenseMeasurement seen = cue.measure(*views.now, views.pairs, views.request(1.0));
  EXPECT_LT(FixedCovariance().dense_quality(seen), 0.5);
}

TEST(PlaneWarp, GradientOfTheCostMatchesCentralDifferences) {
  // The vector b of the sums is minus half the gradient of sum w r^2 at constant weights. With a
  // huge sigma, all weights are one.
  Views views({.blur_px = 4}, {.gain = 0.95, .bias = 4.0, .blur_px = 4});  // for smooth slopes
  CameraModel camera = views.ring.camera();
  camera.residual_k1 = 0.0;  // J omits its slope on purpose
  const LevelCamera level = camera_of_level(camera, 0);
  RoadPixels pixels;
  const Eigen::Vector3d q = views.truth.normal_cam * kMetresPerVo / (1.02 * views.truth.height_m);
  select_road_pixels(views.now->level(0), level, {3.3, 12.0, 1.0, 0.0}, q, 2000, &pixels);
  const ImagePair& pair = views.pairs[0];
  const PlaneWarp warp(pair.old_image->level(0), level, pair.T_old_cam, 0.0);
  using Params = Eigen::Matrix<double, kNumPairParams, 1>;
  const auto sums_at = [&](const Params& p) {
    PairSums sums;
    warp.accumulate(pixels, Eigen::Vector3d(p(0), p(1), p(2)), {p(3), p(4)}, 1e6, &sums);
    return sums;
  };
  Params at;
  at << q.x(), q.y(), q.z(), 0.01, 1.0;
  const PairSums sums = sums_at(at);
  const auto cost = [&](const Params& p) {
    return Eigen::Matrix<double, 1, 1>(sums_at(p).weighted_square);
  };
  const auto slope = test::central_difference<1, kNumPairParams>(cost, at, 1e-3);
  for (int i = 0; i < kNumPairParams; ++i) {
    // Central differences of pixels are a little flatter than the bilinear surface, so the
    // tolerance is relative to a scale, which H gives.
    const double scale = std::sqrt(sums.H(i, i) * sums.weighted_square);
    EXPECT_NEAR(-0.5 * slope(0, i), sums.b(i), 0.05 * std::abs(sums.b(i)) + 0.02 * scale)
        << "parameter " << i;
  }
}

TEST(RoadPixels, StayWithinTheirNumberAndOnTheRoad) {
  Views views({});
  const LevelCamera level = camera_of_level(views.ring.camera(), 0);
  RoadPixels pixels;
  const Eigen::Vector3d q = views.truth.normal_cam / views.truth.height_m;
  for (const int limit : {100, 1000, kMaxRoadPixels}) {
    select_road_pixels(views.now->level(0), level, {3.3, 12.0, 1.0, 0.0}, q, limit, &pixels);
    EXPECT_LE(pixels.size, limit);
    EXPECT_GT(pixels.size, limit / 2);
    for (int i = 0; i < pixels.size; ++i) {
      const double depth = 1.0 / (q.x() * static_cast<double>(pixels.x[i]) +
                                  q.y() * static_cast<double>(pixels.y[i]) + q.z());
      EXPECT_GT(depth, 3.0 * views.truth.height_m);
      EXPECT_LT(depth, 13.0 * views.truth.height_m);
    }
  }
}

}  // namespace
}  // namespace plumb
