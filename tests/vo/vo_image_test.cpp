#include <gtest/gtest.h>

#include "modules/vo/corners.hpp"
#include "modules/vo/image_health.hpp"
#include "tests/support/scene.hpp"

namespace plumb::vo {
namespace {

using plumb::test::RenderedImage;
using plumb::test::Scene;
using plumb::test::scene_camera;

RenderedImage plain(std::uint8_t grey) {
  return {std::vector<std::uint8_t>(620 * 188, grey), 620, 188};
}

TEST(Corners, FindsTheCornerOfASquareAndNothingOnItsEdges) {
  RenderedImage image = plain(60);
  for (int v = 80; v < 130; ++v) {
    for (int u = 200; u < 500; ++u) image.pixels[static_cast<std::size_t>(v * 620 + u)] = 180;
  }
  CornerDetector detector(620, 188, 400);
  detector.clear();
  const auto corners = detector.detect(image.view(), {2.5, 1000.0});
  ASSERT_GE(corners.size(), 4U);
  for (const Eigen::Vector2d& px : corners) {
    const double du = std::min(std::abs(px.x() - 200.0), std::abs(px.x() - 500.0));
    const double dv = std::min(std::abs(px.y() - 80.0), std::abs(px.y() - 130.0));
    EXPECT_LE(std::max(du, dv), 4.0) << px.transpose();
  }
}

TEST(Corners, OccupiedCellsAndTheirSurroundingsStayEmpty) {
  const Scene scene(scene_camera());
  const RenderedImage image = scene.render(Se3{}, 1.0);
  CornerDetector detector(620, 188, 300);
  detector.clear();
  const std::vector<Eigen::Vector2d> first = detector.detect(image.view(), {0.5, 86.0});
  ASSERT_GT(first.size(), 100U);
  EXPECT_LE(first.size(), 300U);
  EXPECT_TRUE(detector.detect(image.view(), {0.5, 86.0}).size() < first.size() / 4);
  for (std::size_t i = 0; i < first.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) EXPECT_GT((first[i] - first[j]).norm(), 4.0);
  }
}

TEST(Corners, TheThresholdIsLowerBelowTheHorizon) {
  RenderedImage image = plain(100);
  for (const int v : {40, 150}) {  // the same faint speck above and below
    for (int j = 0; j < 3; ++j) {
      for (int i = 0; i < 3; ++i) {
        image.pixels[static_cast<std::size_t>((v + j) * 620 + 300 + i)] = 104;
      }
    }
  }
  CornerDetector detector(620, 188, 300);
  detector.clear();
  const auto corners = detector.detect(image.view(), {2.5, 86.0});
  ASSERT_GE(corners.size(), 1U);
  for (const Eigen::Vector2d& px : corners) EXPECT_GT(px.y(), 140.0);
}

TEST(ImageHealth, DistinguishesDarkAndFlatImages) {
  const VoConfig config;
  const Scene scene(scene_camera());
  const RenderedImage good = scene.render(Se3{}, 1.0, 1);
  EXPECT_EQ(judge_image(good.view(), config), VoReason::kNone);
  EXPECT_EQ(judge_image(plain(2).view(), config), VoReason::kImageDark);
  EXPECT_EQ(judge_image(plain(255).view(), config), VoReason::kImageFlat);
}

TEST(ImageHealth, MeasuresMeanAndStandardDeviation) {
  RenderedImage image = plain(50);
  for (std::size_t i = 0; i < image.pixels.size(); i += 2) image.pixels[i] = 150;
  const ImageLevels levels = measure_levels(image.view());
  EXPECT_NEAR(levels.mean_grey, 100.0, 1e-9);
  EXPECT_NEAR(levels.std_grey, 50.0, 1e-9);
}

}  // namespace
}  // namespace plumb::vo
