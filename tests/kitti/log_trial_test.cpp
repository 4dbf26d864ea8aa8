#include "tools/kitti/log_trial.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/input_error.hpp"
#include "modules/camera/image_wire.hpp"
#include "modules/datasets/kitti/plane_file.hpp"
#include "modules/datasets/kitti/pose_file.hpp"
#include "platform/log_file.hpp"
#include "plumb/ground_truth_t.hpp"
#include "tests/support/expect_throw.hpp"
#include "tests/support/temp_folder.hpp"
#include "tools/support/camera_log.hpp"

namespace plumb {
namespace {

constexpr int kNumImages = 60;
constexpr int kWidth = 64, kHeight = 64;

/// A log of grey images that move a metre each, with a plane on every second one.
std::string write_log(const test::TempFolder& folder, bool with_poses = true) {
  CameraModel camera;
  camera.width_px = kWidth;
  camera.height_px = kHeight;
  camera.fx_px = camera.fy_px = 60.0;
  camera.cx_px = 32.0;
  camera.cy_px = 24.0;
  const std::string path = (folder / "drive.lcm").string();
  CameraLog log(path, camera, false);
  const std::vector<std::uint8_t> pixels(kWidth * kHeight, 100);
  for (int k = 0; k < kNumImages; ++k) {
    log.begin_image(1'000'000'000'000'000 + 100'000 * k);
    ground_truth_t truth{};
    truth.seq = k;
    truth.has_pose = with_poses || k != 30 ? 1 : 0;
    truth.q_world_cam[0] = 1.0;
    truth.t_world_cam_m[2] = k;
    truth.has_plane = k % 2 == 0 ? 1 : 0;
    truth.normal_cam[1] = 1.0;
    truth.height_m = 1.65;
    log.write(kGroundTruth, truth);
    log.write_image(k, {pixels.data(), kWidth, kHeight, kWidth});
  }
  log.close();
  return path;
}

struct Images {
  std::vector<std::int64_t> seqs;
  double mean = 0.0, std = 0.0;
};

Images read_images(const std::string& path) {
  Images images;
  LogReader reader(path);
  double sum = 0.0, squares = 0.0, num = 0.0;
  for (LogEvent event; reader.next(&event);) {
    ImageFrame frame;
    if (event.channel != kCamera.name || read_image(event.data, &frame) != nullptr) continue;
    images.seqs.push_back(frame.seq);
    for (const std::uint8_t grey : frame.data) {
      sum += grey;
      squares += grey * grey;
      num += 1.0;
    }
  }
  images.mean = sum / num;
  images.std = std::sqrt(squares / num - images.mean * images.mean);
  return images;
}

TEST(LogTrial, TakesTheTruthOutOfALog) {
  const test::TempFolder folder;
  TrialOptions options;
  options.log = write_log(folder);
  options.poses = (folder / "poses.txt").string();
  options.planes = (folder / "planes.txt").string();
  const TrialResult result = make_trial(options);
  EXPECT_EQ(result.num_images, kNumImages);
  EXPECT_EQ(result.num_planes, kNumImages / 2);
  const auto poses = read_poses(options.poses);
  ASSERT_EQ(poses.size(), 60U);
  EXPECT_EQ(poses[17](2, 3), 17.0);
  EXPECT_EQ(read_planes(options.planes).at(4).height_m, 1.65);
}

TEST(LogTrial, DisturbsImagesAndKeepsTheTruthBesideThem) {
  const test::TempFolder folder;
  TrialOptions options;
  options.log = write_log(folder);
  options.out = (folder / "trial.lcm").string();
  options.poses = (folder / "poses.txt").string();
  options.skip = 5;
  options.noise = 3.0;
  options.drop = 0.2;
  options.seed = 2;
  const TrialResult result = make_trial(options);
  const Images images = read_images(options.out);
  EXPECT_NEAR(images.mean, 100.0, 0.1);
  EXPECT_NEAR(images.std, 3.0, 0.1);
  EXPECT_GE(images.seqs.front(), 5);
  EXPECT_GT(result.num_images, 30);
  EXPECT_LT(result.num_images, 55);
  ASSERT_EQ(images.seqs.size(), static_cast<std::size_t>(result.num_images));
  const auto poses = read_poses(options.poses);
  ASSERT_EQ(poses.size(), images.seqs.size());
  for (std::size_t i = 0; i < poses.size(); ++i)
    EXPECT_EQ(poses[i](2, 3), static_cast<double>(images.seqs[i]));
}

TEST(LogTrial, IsTheSameForTheSameSeedAlone) {
  const test::TempFolder folder;
  TrialOptions options;
  options.log = write_log(folder);
  options.noise = 2.0;
  options.drop = 0.1;
  std::vector<std::string> bytes;
  for (const std::uint64_t seed : {1U, 1U, 2U}) {
    options.seed = seed;
    options.out = (folder / "trial.lcm").string();
    (void)make_trial(options);
    bytes.push_back(test::read_text(options.out));
  }
  EXPECT_EQ(bytes[0], bytes[1]);
  EXPECT_NE(bytes[0], bytes[2]);
}

TEST(LogTrial, WritesNoPoseFileThatHasHoles) {
  const test::TempFolder folder;
  TrialOptions options;
  options.log = write_log(folder, false);
  options.poses = (folder / "poses.txt").string();
  EXPECT_EQ(make_trial(options).num_poses, kNumImages - 1);
  EXPECT_FALSE(std::filesystem::exists(options.poses));
  options.skip = 31;
  EXPECT_EQ(make_trial(options).num_poses, kNumImages - 31);
  EXPECT_TRUE(std::filesystem::exists(options.poses));
  options.skip = kNumImages;
  test::expect_contains(test::input_error_of([&] { (void)make_trial(options); }),
                        "--skip leaves no image");
}

}  // namespace
}  // namespace plumb
