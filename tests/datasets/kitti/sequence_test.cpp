#include "modules/datasets/kitti/sequence.hpp"

#include <gtest/gtest.h>

#include "tests/support/expect_throw.hpp"
#include "tests/support/kitti_folder.hpp"
#include "tests/tools/drives.hpp"

namespace plumb {
namespace {

using test::expect_contains;
using test::input_error_of;

class SequenceTest : public ::testing::Test {
 protected:
  SequenceOptions options(const std::filesystem::path& folder) {
    SequenceOptions result;
    result.folder = folder;
    return result;
  }
  std::string error_of(const SequenceOptions& o) {
    return input_error_of([&] { (void)read_sequence(o); });
  }
  test::TempFolder folder_;
};

TEST_F(SequenceTest, ReadsOdometryFramesThatBeginAnywhere) {
  const auto seq = test::write_odometry(folder_, 5, 100);
  folder_.write("seq/poses.txt", test::to_file(test::repeat(test::drive_step(1.0), 5)));
  folder_.write("seq/gt_ground_plane_velodyne.txt", "102 0 1 0 1.62\n");
  const Sequence sequence = read_sequence(options(seq));
  ASSERT_EQ(sequence.frames.size(), 5U);
  EXPECT_EQ(sequence.frames[2].seq, 102);
  EXPECT_EQ(sequence.frames[2].capture_us, kOdometryEpoch_us + 200'000);
  EXPECT_NEAR((*sequence.frames[2].T_world_cam)(2, 3), 2.0, 1e-9);
  EXPECT_DOUBLE_EQ(sequence.frames[2].plane->height_m, 1.62);
  EXPECT_FALSE(sequence.frames[3].plane);
}

TEST_F(SequenceTest, CalibrationBeatsTheDefaultAndTheOptionBeatsBoth) {
  const auto seq = test::write_odometry(folder_, 2);
  SequenceOptions o = options(seq);
  EXPECT_DOUBLE_EQ(read_sequence(o).camera.residual_k1, kKittiResidualK1);
  EXPECT_DOUBLE_EQ(read_sequence(o).camera.residual_k2, kKittiResidualK2);
  EXPECT_DOUBLE_EQ(read_sequence(o).camera.camera_height_m, 0.0);
  EXPECT_DOUBLE_EQ(read_sequence(o).camera.readout_s, 0.0);
  folder_.write("seq/calib.txt", std::string(test::kCalibration) +
                                     "residual_k1: 0\ncamera_height_m: 1.5\nreadout_s: 0.02\n");
  EXPECT_DOUBLE_EQ(read_sequence(o).camera.residual_k1, 0.0);
  EXPECT_DOUBLE_EQ(read_sequence(o).camera.residual_k2, 0.0);
  EXPECT_DOUBLE_EQ(read_sequence(o).camera.camera_height_m, 1.5);
  EXPECT_DOUBLE_EQ(read_sequence(o).camera.readout_s, 0.02);
  o.residual_k1 = -0.01;
  o.camera_height_m = 1.7;
  o.readout_s = 0.0;
  EXPECT_DOUBLE_EQ(read_sequence(o).camera.residual_k1, -0.01);
  EXPECT_DOUBLE_EQ(read_sequence(o).camera.residual_k2, 0.0);
  EXPECT_DOUBLE_EQ(read_sequence(o).camera.camera_height_m, 1.7);
  EXPECT_DOUBLE_EQ(read_sequence(o).camera.readout_s, 0.0);
}

TEST_F(SequenceTest, MovesTruthToTheCameraThatIsConverted) {
  const auto seq = test::write_odometry(folder_, 2);
  for (int i = 0; i < 2; ++i) {
    test::write_image(folder_, format("seq/image_2/%06d.png", i), test::test_image(i));
  }
  folder_.write("seq/poses.txt", test::to_file(test::repeat(test::drive_step(1.0), 2)));
  // On an inclined road a camera half a metre to the left is nearer to it by n_x / 2 and more.
  folder_.write("seq/gt_ground_plane.txt", "0 0.1 0.99498743710662 0 1.6\n");
  SequenceOptions o = options(seq);
  o.camera = 2;
  const Sequence sequence = read_sequence(o);
  // P2 has 4.8 / 80, so its camera is 0.06 m to the left.
  EXPECT_NEAR((*sequence.frames[0].T_world_cam)(0, 3), -0.06, 1e-12);
  EXPECT_NEAR(sequence.frames[0].plane->height_m, 1.6 + 0.1 * 0.06, 1e-12);
  EXPECT_TRUE(sequence.colour_allowed);
}

TEST_F(SequenceTest, ReadsARawDriveWithTheCalibrationOneFolderUp) {
  const auto drive = test::write_raw(folder_, 12);
  const Sequence sequence = read_sequence(options(drive));
  ASSERT_EQ(sequence.frames.size(), 12U);
  EXPECT_EQ(sequence.frames[11].capture_us - sequence.frames[0].capture_us, 1'100'000);
  EXPECT_EQ(sequence.camera.width_px, 96);
  EXPECT_DOUBLE_EQ(sequence.camera.residual_k1, kKittiResidualK1);
  EXPECT_FALSE(sequence.frames[0].T_world_cam);
}

TEST_F(SequenceTest, TakesPosesFromOxtsWhenTheCalibrationsAreThere) {
  const auto drive = test::write_raw(folder_, 2);
  for (int i = 0; i < 2; ++i) {
    std::string row =
        format("0 %.12f 0 0 0 0", 8.0 + i * 8.9831528e-06);  // 1 m along the longitude
    for (int k = 6; k < 30; ++k) row += " 0";
    folder_.write(format("date/drive/oxts/data/%010d.txt", i), row + "\n");
  }
  EXPECT_FALSE(read_sequence(options(drive)).frames[1].T_world_cam);
  folder_.write("date/calib_velo_to_cam.txt", "R: 0 -1 0 0 0 -1 1 0 0\nT: 0 0 -0.3\n");
  folder_.write("date/calib_imu_to_velo.txt", "R: 1 0 0 0 1 0 0 0 1\nT: -0.8 0.3 -0.8\n");
  const Sequence sequence = read_sequence(options(drive));
  ASSERT_TRUE(sequence.frames[1].T_world_cam);
  EXPECT_NEAR((*sequence.frames[1].T_world_cam)(2, 3), 1.0, 1e-6);
}

TEST_F(SequenceTest, KeepsGapsInTheNumbersAndTellsThem) {
  const auto seq = test::write_odometry(folder_, 5);
  std::filesystem::remove(seq / "image_0/000002.png");
  const Sequence sequence = read_sequence(options(seq));
  ASSERT_EQ(sequence.frames.size(), 4U);
  EXPECT_EQ(sequence.frames[2].seq, 3);
  EXPECT_EQ(sequence.frames[2].capture_us, kOdometryEpoch_us + 300'000);
  ASSERT_EQ(sequence.notes.size(), 1U);
  expect_contains(sequence.notes[0], "1 frame is missing after 1");
}

TEST_F(SequenceTest, SelectsFramesByNumber) {
  const auto seq = test::write_odometry(folder_, 5, 100);
  SequenceOptions o = options(seq);
  o.start = 101;
  o.end = 102;
  EXPECT_EQ(read_sequence(o).frames.size(), 2U);
  o.start = 200;
  expect_contains(error_of(o), "between --start and --end");
}

TEST_F(SequenceTest, RefusesTimesThatDoNotRise) {
  const auto seq = test::write_odometry(folder_, 3);
  folder_.write("seq/times.txt", "0\n0.2\n0.1\n");
  expect_contains(error_of(options(seq)),
                  "times.txt: the time of frame 2 lies before that of frame 1");
  folder_.write("seq/times.txt", "0\n0.2\n0.2\n");
  expect_contains(error_of(options(seq)), "is the same as that of frame 1");
  folder_.write("seq/times.txt", "0\n0.2\n");
  expect_contains(error_of(options(seq)), "has 2 rows for 3 images");
}

TEST_F(SequenceTest, RefusesFoldersThatAreNotKitti) {
  expect_contains(error_of(options(folder_ / "none")), "is not a folder");
  expect_contains(error_of(options(folder_.path())), "neither image_0 nor image_00/data");
  const auto seq = test::write_odometry(folder_, 2);
  std::filesystem::remove(seq / "calib.txt");
  expect_contains(error_of(options(seq)), "calib.txt");
  folder_.write("seq/calib.txt", "P0: 80 0 48 0 0 80 36 0 0 0 one 0\n");
  expect_contains(error_of(options(seq)), "'one' is not a finite number");
  folder_.write("seq/calib.txt", test::kCalibration);
  folder_.write("seq/gt_ground_plane.txt", "0 0 1 0 1.6\n");
  folder_.write("seq/gt_ground_plane_velodyne.txt", "0 0 1 0 1.6\n");
  expect_contains(error_of(options(seq)), "name one with --planes");
  const auto drive = test::write_raw(folder_, 2);
  std::filesystem::remove(folder_ / "date/calib_cam_to_cam.txt");
  expect_contains(error_of(options(drive)), "no calib_cam_to_cam.txt");
}

}  // namespace
}  // namespace plumb
