#include <gtest/gtest.h>

#include <cmath>

#include "modules/ground/filter/plane_angles.hpp"
#include "modules/ground_paper/paper_dense_cue.hpp"
#include "modules/ground_paper/paper_points_cue.hpp"
#include "tests/ground/road_scene.hpp"

namespace plumb {
namespace {

constexpr double kRho = 1.5;
constexpr double kVoteMu = 50.0;

/// Two images of the rendered road, the second `step` frames after the first, and the truth in it.
struct Views {
  explicit Views(const test::Drive& drive, std::size_t step = 1)
      : poses(drive.poses(8)),
        old_image(test::render(camera, poses[4], {.noise_grey = 1.0}, 11)),
        image(test::render(camera, poses[4 + step], {.noise_grey = 1.0}, 12)),
        T_old_cam(poses[4].inverse() * poses[4 + step]),
        truth(test::plane_in(poses[4 + step])),
        z(truth.normal_cam.x(), truth.normal_cam.z(), truth.height_m) {}

  CameraModel camera = test::scene_camera();
  PixelBox box = region_of(camera, 0.2, 0.333);
  std::vector<Se3> poses;
  test::GreyImage old_image;
  test::GreyImage image;
  Se3 T_old_cam;
  test::TruePlane truth;
  Eigen::Vector3d z;
};

TEST(RoadRegion, IsTheMiddleFifthOfTheLowerThird) {
  CameraModel camera;
  camera.width_px = 1242;
  camera.height_px = 375;
  const PixelBox box = region_of(camera, 0.2, 1.0 / 3.0);
  EXPECT_EQ(box.u1 - box.u0, 248);
  EXPECT_EQ(box.u0, 497);
  EXPECT_EQ(box.v0, 250);
  EXPECT_EQ(box.v1, 375);
}

TEST(RoadRegion, DiffersLeastUnderTheTruePlane) {
  const Views views{test::Drive{}};
  RoadRegion region(views.camera, views.box);
  region.take(views.image.view());
  const auto sad = [&](const Eigen::Vector3d& z) {
    return region.sad(views.old_image.view(), views.T_old_cam, q_of(z));
  };
  const double best = sad(views.z);
  EXPECT_LT(best, 3.0);
  for (const double sign : {-1.0, 1.0}) {
    EXPECT_GT(sad(views.z + Eigen::Vector3d(0.05 * sign, 0.0, 0.0)), 1.1 * best);
    EXPECT_GT(sad(views.z + Eigen::Vector3d(0.0, 0.03 * sign, 0.0)), 1.1 * best);
    EXPECT_GT(sad(views.z + Eigen::Vector3d(0.0, 0.0, 0.15 * sign)), 1.1 * best);
  }
}

TEST(RoadRegion, SaysNothingWhenTheOldImageDoesNotShowIt) {
  const Views views{test::Drive{}};
  RoadRegion region(views.camera, views.box);
  region.take(views.image.view());
  const Se3 away{exp_so3({0.0, 1.5, 0.0}), {0.0, 0.0, 1.0}};
  EXPECT_TRUE(std::isnan(region.sad(views.old_image.view(), away, q_of(views.z))));
}

TEST(PaperDenseCue, FindsTheRenderedPlaneFromTheCalibratedOne) {
  for (const double turn : {0.0, 0.02}) {
    test::Drive drive;
    drive.turn_left_rad = turn;
    const Views views{drive};
    PaperDenseCue cue(views.camera, views.box, kRho);
    cue.take(views.image.view());
    const PaperDenseMeasurement seen =
        cue.measure(views.old_image.view(), views.T_old_cam, {0.0, 0.0, 1.1 * test::kRoadHeight});
    ASSERT_TRUE(seen.ok);
    EXPECT_NEAR(seen.z(kH), views.z(kH), 0.02 * views.z(kH));
    EXPECT_NEAR(seen.z(kN1), views.z(kN1), 0.01);
    EXPECT_NEAR(seen.z(kN3), views.z(kN3), 0.006);
    EXPECT_LT(seen.num_evaluations, 205);
    EXPECT_TRUE(seen.width.allFinite());
    EXPECT_GT(seen.width.minCoeff(), 0.0);
  }
}

TEST(PaperDenseCue, IsLessConfidentOnABlurredRoad) {
  const Views views{test::Drive{}};
  PaperDenseCue cue(views.camera, views.box, kRho);
  const auto width = [&](int blur_px) {
    const auto old_image = test::render(views.camera, views.poses[4], {.blur_px = blur_px}, 11);
    const auto image = test::render(views.camera, views.poses[5], {.blur_px = blur_px}, 12);
    cue.take(image.view());
    return cue.measure(old_image.view(), views.T_old_cam, {0.0, 0.0, test::kRoadHeight}).width;
  };
  const Eigen::Vector3d sharp = width(0);
  const Eigen::Vector3d blurred = width(3);
  EXPECT_GT(blurred(kH), 1.3 * sharp(kH));
  EXPECT_GT(blurred(kN3), 1.3 * sharp(kN3));
}

TEST(PaperDenseCue, SearchesTheHeightInAnyUnit) {
  const Views views{test::Drive{}};
  PaperDenseCue cue(views.camera, views.box, kRho);
  cue.take(views.image.view());
  for (const double unit_m : {0.2, 1.0, 7.0}) {
    Se3 T = views.T_old_cam;
    T.t /= unit_m;
    const double height = cue.search_height(views.old_image.view(), T, Eigen::Vector3d::UnitY());
    EXPECT_NEAR(height * unit_m, test::kRoadHeight, 0.1 * test::kRoadHeight);
  }
  // The same image twice looks like a road infinitely far below.
  EXPECT_EQ(cue.search_height(views.image.view(), views.T_old_cam, Eigen::Vector3d::UnitY()), 0.0);
}

TEST(Triangulation, FindsDepthAndHowFarTheMatchMisses) {
  const Views views{test::Drive{}};
  const Eigen::Vector3d p_cam(0.6, 1.4, 9.0);
  PixelMatch match{views.camera.project(p_cam), views.camera.project(views.T_old_cam * p_cam)};
  const Triangulated exact = triangulate(views.camera, views.T_old_cam, match);
  ASSERT_TRUE(exact.ok);
  EXPECT_LT((exact.p_cam - p_cam).norm(), 1e-6);
  EXPECT_LT(exact.miss_px, 1e-6);

  // An error along the epipolar line changes the depth. One across the line remains as the miss.
  const Eigen::Vector2d along =
      (match.old - views.camera.project(views.T_old_cam * (1.1 * p_cam))).normalized();
  match.old += 3.0 * Eigen::Vector2d(-along.y(), along.x());
  const double miss_px = triangulate(views.camera, views.T_old_cam, match).miss_px;
  EXPECT_GT(miss_px, 2.9);
  EXPECT_LT(miss_px, 4.0);
}

TEST(Triangulation, RefusesPointsBehindTheCamera) {
  const Views views{test::Drive{}};
  const Eigen::Vector3d p_cam(0.6, 1.4, 9.0);
  const PixelMatch swapped{views.camera.project(views.T_old_cam * p_cam),
                           views.camera.project(p_cam)};
  EXPECT_FALSE(triangulate(views.camera, views.T_old_cam, swapped).ok);
}

TEST(PaperPointsCue, FindsTheHeightOfARenderedRoadBySift) {
  const Views views{test::Drive{}};
  SiftMatcher matcher(views.box, 2);
  matcher.detect(0, views.old_image.view());
  matcher.detect(1, views.image.view());
  const auto matches = matcher.match(1, 0);
  PaperPointsCue cue(views.camera, views.truth.normal_cam, kVoteMu);
  const PaperPointsMeasurement seen = cue.measure(matches, views.T_old_cam);
  ASSERT_TRUE(seen.ok) << matches.size() << " matches";
  EXPECT_NEAR(seen.height, views.truth.height_m, 0.03 * views.truth.height_m);
  EXPECT_GT(seen.score, 5.0);
  Se3 T = views.T_old_cam;
  T.t /= 3.0;
  EXPECT_NEAR(3.0 * cue.search_height(matches, T, views.truth.height_m), views.truth.height_m,
              0.05 * views.truth.height_m);

  // The cue assumes the calibrated pitch. Half a degree of pitch is 4 % of height.
  const Eigen::Vector3d pitched = exp_so3({0.009, 0.0, 0.0}) * views.truth.normal_cam;
  PaperPointsCue misled(views.camera, pitched, kVoteMu);
  EXPECT_GT(std::abs(misled.measure(matches, views.T_old_cam).height / seen.height - 1.0), 0.02);
}

TEST(SiftMatcher, FindsNothingInAGreyWall) {
  const CameraModel camera = test::scene_camera();
  test::GreyImage wall(camera.width_px, camera.height_px);
  for (int v = 0; v < camera.height_px; ++v) {
    std::fill_n(wall.row(v), camera.width_px, std::uint8_t{90});
  }
  SiftMatcher matcher(region_of(camera, 0.2, 0.333), 2);
  matcher.detect(0, wall.view());
  matcher.detect(1, wall.view());
  EXPECT_TRUE(matcher.match(1, 0).empty());
}

}  // namespace
}  // namespace plumb
