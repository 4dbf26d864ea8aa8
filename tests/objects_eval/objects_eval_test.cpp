#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "core/input_error.hpp"
#include "modules/datasets/text.hpp"
#include "tests/objects/cuboid_scene.hpp"
#include "tests/support/kitti_data.hpp"
#include "tests/support/temp_folder.hpp"
#include "tools/datasets/kitti_tracking/kitti_tracking.hpp"
#include "tools/evaluate/objects_eval/object_depth.hpp"

namespace plumb {
namespace {

namespace fs = std::filesystem;

class ObjectsEvalTest : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* folder : {"calib", "label_02"}) fs::create_directories(root_ / folder);
    write("calib/0000.txt", "P2: 721.5 0 609.6 0 0 721.5 172.9 0 0 0 1 0\n");
  }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(root_ / name) << text;
  }

  /// A label line of `state`, seen on `plane`.
  static std::string label(int frame, int id, const StateVector& state, const RoadPlane& plane) {
    const Detection d = test::detect(state, plane, id);
    const Eigen::Vector3d foot = plane.cam_from_ground({state(kX), state(kY), 0.0});
    return format("%d %d Car 0 0 0 %.6f %.6f %.6f %.6f %.4f %.4f %.4f %.6f %.6f %.6f %.6f\n", frame,
                  id, d.box.left_px, d.box.top_px, d.box.right_px, d.box.bottom_px,
                  height_of(state), width_of(state), length_of(state), foot.x(), foot.y(), foot.z(),
                  -state(kYaw) - 1.5707963);
  }

  test::TempFolder folder_;
  fs::path root_ = folder_.path();
};

TEST_F(ObjectsEvalTest, ReadsLabelsAndTrackersOutput) {
  write("label_02/0000.txt",
        "0 -1 DontCare -1 -1 -10 1 2 3 4 -1 -1 -1 -1 -1 -1 -10\n"
        "0 2 Van 0 1 -1.8 296 161 455 292 2.0 1.82 4.43 -4.55 1.86 13.41 -2.12\n"
        "1 2 Car -1 -1 -1 459.1 184.2 490.6 206.5 -1 -1 -1 -1 -1 -1 -1 -1 1\n"
        "2 2 Car -1 -1 -1 1251.1 157.3 1242.0 176.8 1 1 4 46 0.4 54 -10 6.8\n");
  const auto rows = read_tracking(root_ / "label_02/0000.txt");
  ASSERT_EQ(rows.size(), 2u) << "DontCare and the empty box are left out";
  EXPECT_EQ(rows[0].detection.object_class, ObjectClass::kVan);
  EXPECT_EQ(rows[0].detection.occluded, Occlusion::kPartly);
  EXPECT_EQ(rows[0].detection.truncated_ratio, 0.0);
  EXPECT_TRUE(rows[0].has_box3d);
  EXPECT_EQ(rows[0].size_m, Eigen::Vector3d(4.43, 1.82, 2.0));
  EXPECT_EQ(rows[0].foot_cam0, Eigen::Vector3d(-4.55, 1.86, 13.41));
  EXPECT_FALSE(rows[1].has_box3d);
  EXPECT_EQ(rows[1].detection.occluded, Occlusion::kUnknown);
  EXPECT_TRUE(std::isnan(rows[1].detection.truncated_ratio));
  EXPECT_EQ(detections_of_frame(rows, 1).detections.size(), 1u);
  EXPECT_EQ(detections_of_frame(rows, 1).capture_us, 100'000);
}

TEST_F(ObjectsEvalTest, NamesFileLineAndColumnOfWrongRows) {
  const auto why = [&](const std::string& text) -> std::string {
    write("label_02/0000.txt", text);
    try {
      (void)read_tracking(root_ / "label_02/0000.txt");
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(why("0 2 Van 0 1\n").find("0000.txt:1: 5 columns"), std::string::npos);
  EXPECT_NE(why("\n0 2 Car 0 0 0 1 x 3 4\n").find("0000.txt:2: column 8: 'x'"), std::string::npos);
  EXPECT_NE(why("0 2 Car 0 0 0 1 nan 3 4\n").find("column 8"), std::string::npos);
  EXPECT_NE(why("0 2 Car 0 0 0 1 1 3 4\n0 2 Car 0 0 0 1 1 3 4\n").find("has two boxes in frame 0"),
            std::string::npos);
  EXPECT_THROW((void)read_tracking(root_ / "label_02/9999.txt"), InputError);
  write("calib/0001.txt", "P0: 1 2 3\n");
  EXPECT_THROW((void)read_tracking_camera(root_ / "calib/0001.txt"), InputError);
}

TEST_F(ObjectsEvalTest, PerfectBoxesOnTheCalibratedPlaneAreWellPlacedAndAPitchedOneIsNot) {
  for (const double pitch_rad : {0.0, 0.012}) {
    const RoadPlane plane = test::road(pitch_rad);
    std::string text;
    for (int frame = 0; frame < 10; ++frame) {
      text += label(frame, 1, test::car_at(9.0, 2.5, 0.0), plane);
      text += label(frame, 2, test::car_at(25.0, -3.0, 0.0), plane);
      text += label(frame, 3, test::car_at(40.0, 6.0, 0.0), plane);
    }
    write("label_02/0000.txt", text);
    ObjectDepthOptions options;
    options.root = root_;
    options.sequences = {"0000"};
    const SequenceDepth all = pool(evaluate_object_depth(options));
    EXPECT_EQ(all.close.num_samples, 10u);
    EXPECT_EQ(all.distant.num_samples, 20u);
    EXPECT_EQ(all.num_labels, 30u);
    EXPECT_LT(all.distant.depth_percent(kTrackCue), 5.0);
    EXPECT_LT(all.pitch_rms_rad, 0.004);
    if (pitch_rad == 0.0) {
      EXPECT_LT(all.distant.depth_percent(kFootCalibrated), 3.0);
    } else {
      EXPECT_GT(all.distant.depth_percent(kFootCalibrated), 15.0);
      EXPECT_LT(all.distant.depth_percent(kFootCue),
                0.5 * all.distant.depth_percent(kFootCalibrated));
    }
    EXPECT_NE(depth_table({all}).find("distant"), std::string::npos);
  }
}

TEST(ObjectsEvalReal, TracksHalveTheDistantErrorOfTheCalibratedPlane) {
  const fs::path root = test::kitti_sequence("tracking");
  if (root.empty()) GTEST_SKIP() << test::kNoKitti;
  ObjectDepthOptions options;
  options.root = root;
  options.sequences = {"0000", "0001", "0002", "0004", "0005", "0006", "0007", "0008"};
  const SequenceDepth all = pool(evaluate_object_depth(options));
  EXPECT_GT(all.distant.num_samples, 6000u);
  EXPECT_LT(all.distant.depth_percent(kTrackCue), 0.5 * all.distant.depth_percent(kFootCalibrated));
  EXPECT_LT(all.close.depth_percent(kTrackCue), 0.75 * all.close.depth_percent(kFootCalibrated));
  options.boxes = "det2d/CIWT";
  const SequenceDepth tracker = pool(evaluate_object_depth(options));
  EXPECT_LT(tracker.close.depth_percent(kTrackCue), 10.0);
  EXPECT_LT(tracker.distant.depth_percent(kTrackCue), 12.0);
}

}  // namespace
}  // namespace plumb
