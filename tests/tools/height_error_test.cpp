#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <cstdlib>
#include <string>

#include "plumb_paths.hpp"
#include "tests/support/temp_folder.hpp"

namespace plumb::test {
namespace {

struct Result {
  int exit_code = -1;
  std::string out;
  std::string err;
};

Result height_error(const TempFolder& folder, const std::string& arguments) {
  const std::string command = std::string(PLUMB_SOURCE_DIR) + "/tools/evaluate/height_error " +
                              arguments + " >" + (folder / "out").string() + " 2>" +
                              (folder / "err").string();
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_text(folder / "out"),
          read_text(folder / "err")};
}

/// Ten frames of 1 m; VO's unit is 2 m. The filter holds 1.65 m x 1.02, the dense cue sees 0.84.
struct Drive {
  Drive() {
    std::string poses;
    std::string csv =
        "seq,vo_status,scale_epoch,vo_t_x,vo_t_y,vo_t_z,plane_status,log_scale,dense_status,"
        "dense_height_vo,points_status,points_height_vo\n";
    for (int k = 0; k < 10; ++k) {
      const std::string z = std::to_string(k);
      poses += "1 0 0 0 0 1 0 0 0 0 1 " + z + "\n";
      csv += z + (k == 0 ? ",initializing,0,0,0,0,initializing,,absent,,absent,\n"
                         : ",ok,0,0,0,0.5,ok,0.673344553,used,0.84,failed,0.5\n");
    }
    folder.write("poses.txt", poses);
    folder.write("drive.csv", csv);
  }
  [[nodiscard]] std::string files() const {
    return (folder / "poses.txt").string() + " " + (folder / "drive.csv").string();
  }
  TempFolder folder;
};

TEST(HeightError, ComparesWithTheNominalHeightByTheTrueStep) {
  const Drive drive;
  const Result result = height_error(drive.folder, drive.files());
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("fused       9 frames  mean   2.00 %  bias   2.00 %"),
            std::string::npos)
      << result.out;
  EXPECT_NE(result.out.find("dense       9 frames  mean   1.82 %"), std::string::npos);
  EXPECT_NE(result.out.find("points      0 frames"), std::string::npos);
}

TEST(HeightError, PrefersMeasuredPlanes) {
  const Drive drive;
  std::string planes = "# frame nx ny nz height_m\n";
  for (int k = 0; k < 10; ++k) planes += std::to_string(k) + " 0 1 0 1.4\n";
  drive.folder.write("planes.txt", planes);
  const Result result = height_error(
      drive.folder, drive.files() + " --planes " + (drive.folder / "planes.txt").string());
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("dense       9 frames  mean  20.00 %  bias  20.00 %  within 7 %:   0"),
            std::string::npos)
      << result.out;
}

TEST(HeightError, RefusesWhatDoesNotBelongTogether) {
  const Drive drive;
  const Result missing = height_error(drive.folder, "nowhere.txt nowhere.csv");
  EXPECT_EQ(missing.exit_code, 2);
  EXPECT_NE(missing.err.find("cannot read nowhere.txt"), std::string::npos);
  drive.folder.write("poses.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n");
  const Result fewer = height_error(drive.folder, drive.files());
  EXPECT_EQ(fewer.exit_code, 2);
  EXPECT_NE(fewer.err.find("10 frames"), std::string::npos);
  drive.folder.write("poses.txt", "1 0 0\n");
  EXPECT_EQ(height_error(drive.folder, drive.files()).exit_code, 2);
}

}  // namespace
}  // namespace plumb::test
