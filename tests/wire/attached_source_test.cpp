// Tests that what is attached to the camera survives a restart, and that a wrong file is refused.
#include "modules/vo/attached_source.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "platform/config.hpp"
#include "tests/support/temp_folder.hpp"

namespace plumb {
namespace {

constexpr int kWidthPx = 100;  // seven cells, the last one in part
constexpr int kHeightPx = 64;

class AttachedFileTest : public testing::Test {
 protected:
  AttachedFileTest() {
    std::vector<float> evidence(known_.evidence().size());
    evidence[0] = -3.0F;
    evidence[8] = 20.0F;
    evidence[27] = 9.0F;
    known_.restore(evidence);
  }
  void save() {
    AttachedFile file(path_, kWidthPx, kHeightPx);
    EXPECT_TRUE(file.save(known_));
    EXPECT_FALSE(file.save(known_)) << "the file says it already";
  }
  void expect_refused(const std::string& text, const std::string& why) {
    std::ofstream(path_) << text;
    vo::AttachedRegions regions(kWidthPx, kHeightPx);
    try {
      load_attached_regions(path_, kWidthPx, kHeightPx, &regions);
      ADD_FAILURE() << "not refused: " << why;
    } catch (const ConfigError& error) {
      EXPECT_EQ(error.what(), path_ + ": " + why);
    }
    EXPECT_EQ(regions.share(), 0.0);
  }

  test::TempFolder folder_;
  std::string path_ = (folder_ / "attached.toml").string();
  vo::AttachedRegions known_{kWidthPx, kHeightPx};
};

TEST_F(AttachedFileTest, WhatIsKnownSurvivesARestart) {
  save();
  vo::AttachedRegions again(kWidthPx, kHeightPx);
  load_attached_regions(path_, kWidthPx, kHeightPx, &again);
  EXPECT_TRUE(again.covers({20.0, 20.0}));
  EXPECT_EQ(again.share(), known_.share());
  for (std::size_t i = 0; i < again.evidence().size(); ++i)
    EXPECT_NEAR(again.evidence()[i], std::max(0.0F, known_.evidence()[i]), 1.5F) << i;
}

TEST_F(AttachedFileTest, TriesAgainWhenTheFileCouldNotBeWritten) {
  const std::filesystem::path folder = folder_ / "later";
  AttachedFile file((folder / "attached.toml").string(), kWidthPx, kHeightPx);
  EXPECT_TRUE(file.save(known_));
  for (int i = 0; file.error() == 0 && i < 1'000; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  ASSERT_EQ(file.error(), ENOENT);
  std::filesystem::create_directory(folder);
  EXPECT_TRUE(file.save(known_)) << "although it says the same";
  for (int i = 0; file.error() != 0 && i < 1'000; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_EQ(file.error(), 0);
  EXPECT_TRUE(std::filesystem::exists(folder / "attached.toml"));
}

TEST_F(AttachedFileTest, RefusesAFileOfAnotherImageOrWithADamagedRow) {
  save();
  const std::string good = test::read_text(path_);
  const auto with = [&good](const std::string& from, const std::string& to) {
    std::string text = good;
    return text.replace(text.find(from), from.size(), to);
  };
  expect_refused(with("width_px = 100", "width_px = 640"), "it is of images of 640x64 pixels");
  expect_refused(with("row_002 = \"", "row_002 = \"x"),
                 "attached_regions.row_002 is not a text of 7 digits and dots");
  expect_refused(with("row_003", "row_004"), "attached_regions.row_003 is missing");
}

}  // namespace
}  // namespace plumb
