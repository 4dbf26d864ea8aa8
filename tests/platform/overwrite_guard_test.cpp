#include "platform/overwrite_guard.hpp"

#include <gtest/gtest.h>

#include "core/input_error.hpp"
#include "tests/support/temp_folder.hpp"

namespace plumb {
namespace {

namespace fs = std::filesystem;

class OverwriteGuardTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_.write("log.lcm", "log");
    folder_.write("drive/times.txt", "0");
    folder_.write("drive/image_0/000000.png", "png");
    folder_.write("drive/old.lcm", "log");
  }
  /// What the guard says; empty when it lets the outputs pass.
  static std::string refusal(const OverwriteGuard& guard) {
    try {
      guard.check();
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  [[nodiscard]] std::string against_log(const fs::path& output) const {
    return refusal(OverwriteGuard().reads("LOG", log_).writes("--poses", output));
  }
  [[nodiscard]] std::string against_drive(const fs::path& output) const {
    return refusal(OverwriteGuard()
                       .reads_folder("SEQ_DIR", folder_ / "drive", {".txt", ".png"})
                       .writes("--out", output));
  }
  test::TempFolder folder_;
  const fs::path log_ = folder_ / "log.lcm";
};

TEST_F(OverwriteGuardTest, LetsOtherFilesPass) {
  EXPECT_EQ("", against_log(folder_ / "poses.txt"));
  EXPECT_EQ("", against_log(""));
  EXPECT_EQ("", refusal(OverwriteGuard().reads("LOG", "").writes("--csv", "")));
}

TEST_F(OverwriteGuardTest, RefusesAnInputByAnyPath) {
  EXPECT_EQ("--poses " + log_.string() + " would overwrite the input LOG " + log_.string(),
            against_log(log_));
  EXPECT_NE("", against_log(folder_ / "drive/../log.lcm"));
  fs::create_hard_link(log_, folder_ / "hard.lcm");
  EXPECT_NE("", against_log(folder_ / "hard.lcm"));
  fs::create_symlink("log.lcm", folder_ / "soft.lcm");
  EXPECT_NE("", against_log(folder_ / "soft.lcm"));
  fs::create_directory_symlink(folder_.path(), folder_ / "here");
  EXPECT_NE("", against_log(folder_ / "here/log.lcm"));
}

TEST_F(OverwriteGuardTest, RefusesTheSameOutputTwiceEvenBeforeItExists) {
  const fs::path a = folder_ / "new.txt";
  const auto refused = [&a](const fs::path& b) {
    return refusal(OverwriteGuard().writes("--poses", a).writes("--csv", b));
  };
  EXPECT_EQ("--csv " + a.string() + " is the same file as --poses " + a.string(), refused(a));
  EXPECT_NE("", refused(folder_ / "drive/../new.txt"));
  fs::create_symlink("new.txt", folder_ / "dangling.txt");
  EXPECT_NE("", refused(folder_ / "dangling.txt"));
  fs::create_symlink("loop.txt", folder_ / "loop.txt");
  EXPECT_EQ("", refused(folder_ / "loop.txt"));
  EXPECT_EQ("", refused(folder_ / "other.txt"));
}

TEST_F(OverwriteGuardTest, LetsDevicesPass) {
  EXPECT_EQ("", refusal(OverwriteGuard()
                            .reads("--config", "/dev/null")
                            .writes("--poses", "/dev/null")
                            .writes("--csv", "/dev/null")));
}

TEST_F(OverwriteGuardTest, RefusesTheFilesOfAnInputFolder) {
  EXPECT_NE("", against_drive(folder_ / "drive/times.txt"));
  EXPECT_NE("", against_drive(folder_ / "drive/image_0/000000.png"));
  fs::create_hard_link(folder_ / "drive/times.txt", folder_ / "linked");
  EXPECT_NE("", against_drive(folder_ / "linked"));
  EXPECT_EQ("", against_drive(folder_ / "drive/new.txt"));
  EXPECT_EQ("", against_drive(folder_ / "drive/old.lcm")) << "a log is no input of this folder";
}

}  // namespace
}  // namespace plumb
