#include "modules/detector/crops.hpp"

#include <gtest/gtest.h>

namespace plumb {
namespace {

TEST(Crops, CoverTheWholeImageAndOverlap) {
  const Crops crops = make_crops(1242, 375, 0);
  ASSERT_EQ(crops.size(), 4U);
  EXPECT_EQ(crops[0].left_px, 0);
  EXPECT_EQ(crops[3].left_px + crops[3].side_px, 1242);
  for (std::size_t i = 0; i < crops.size(); ++i) {
    EXPECT_EQ(crops[i].side_px, 375);
    EXPECT_EQ(crops[i].top_px, 0);
    if (i > 0) {
      EXPECT_LE(crops[i].left_px, crops[i - 1].left_px + 300) << "a fifth is shared";
    }
  }
}

TEST(Crops, OfASquareAreOneAndOfATallImageGoDown) {
  EXPECT_EQ(make_crops(400, 400, 0).size(), 1U);
  const Crops tall = make_crops(300, 700, 3);
  ASSERT_EQ(tall.size(), 3U);
  EXPECT_EQ(tall[1].top_px, 200);
  EXPECT_EQ(tall[2].top_px, 400);
  EXPECT_EQ(make_crops(5000, 100, 0).size(), kMaxCrops) << "capacity";
}

TEST(Crops, ABoxAtAnInnerBorderIsCut) {
  const Crop middle{300, 0, 375};
  EXPECT_TRUE(is_cut_by(middle, {301.0, 100.0, 360.0, 150.0}, 1242, 375));
  EXPECT_TRUE(is_cut_by(middle, {600.0, 100.0, 674.5, 150.0}, 1242, 375));
  EXPECT_FALSE(is_cut_by(middle, {310.0, 100.0, 360.0, 374.0}, 1242, 375))
      << "the image's own border";
  EXPECT_FALSE(is_cut_by({0, 0, 375}, {0.0, 100.0, 60.0, 150.0}, 1242, 375));
}

}  // namespace
}  // namespace plumb
