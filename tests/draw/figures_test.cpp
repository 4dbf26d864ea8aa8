/// Tests what plumb-replay's tables become: figures for each frame.
#include "tools/run/draw/figures.hpp"

#include <gtest/gtest.h>

#include "core/input_error.hpp"
#include "tools/run/replay/features_csv.hpp"

namespace plumb {
namespace {

CsvTable frames() {
  return {"frames.csv",
          {"seq,n1,n2,n3,height_m,x_m,z_m,speed_m_s,speed_std_m_s", "7,0,1,0,1.65,0,0,10,0.125",
           "8,,,,,,,,", "9,0,1,0,1.65,0.5,2,,"}};
}

TEST(DriveFigures, HaveThePathUpToTheirFrame) {
  const DriveFigures figures(frames());
  ASSERT_EQ(figures.size(), 3U);
  EXPECT_EQ(figures.seq(2), 9);
  EXPECT_FALSE(figures.find(6));
  const std::vector<Eigen::Vector2d> start = {{0.0, 0.0}};
  const std::vector<Eigen::Vector2d> whole = {{0.0, 0.0}, {0.5, 2.0}};
  EXPECT_EQ(figures.frame(0).path_m, start);
  EXPECT_EQ(figures.frame(1).path_m, start);
  EXPECT_EQ(figures.frame(2).path_m, whole);
  EXPECT_TRUE(figures.frame(0).plane);
  EXPECT_FALSE(figures.frame(1).plane);
  EXPECT_EQ(figures.frame(0).lines[1], "speed 10.00 +- 0.12 m/s");
  EXPECT_EQ(figures.frame(2).lines[1], "speed -");
}

TEST(DriveFigures, TakeTheFeaturesThatTheReplayWrites) {
  vo_motion_t vo{};
  vo.seq = 9;
  vo.num_features = 2;
  vo.features_px[1][0] = 12.3F;
  vo.features_px[1][1] = 0.1F;
  vo.features_kind[1] = vo_motion_t::FEATURE_MOVING;
  const CsvTable table("features.csv", {features_csv_header(), features_csv_row(vo, 0),
                                        features_csv_row(vo, 1), "4711,0,1,2,static"});
  DriveFigures figures(frames());
  figures.add_features(table);
  EXPECT_TRUE(figures.frame(0).features.empty());
  const FrameFigures frame = figures.frame(2);
  ASSERT_EQ(frame.features.size(), 2U) << "and none of a frame that is not there";
  EXPECT_EQ(frame.features[0].kind, FeatureKind::kUndecided);
  EXPECT_EQ(frame.features[1].kind, FeatureKind::kMoving);
  EXPECT_EQ(frame.features[1].px, Eigen::Vector2f(12.3F, 0.1F));
}

TEST(DriveFigures, RefuseAKindThatIsNone) {
  DriveFigures figures(frames());
  try {
    figures.add_features({"f.csv", {"seq,u_px,v_px,kind", "9,1,2,static", "9,1,2,parked"}});
    FAIL() << "taken";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "f.csv:3: kind: 'parked' is no kind of a feature");
  }
}

}  // namespace
}  // namespace plumb
