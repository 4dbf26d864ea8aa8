// Tests that a file is replaced as a whole or not at all.
#include "platform/durable_file.hpp"

#include <gtest/gtest.h>

#include <cerrno>
#include <filesystem>
#include <string>

#include "tests/support/temp_folder.hpp"

namespace plumb {
namespace {

TEST(DurableFile, ReplacesTheWholeTextAndLeavesNothingBeside) {
  const test::TempFolder folder;
  const std::string path = (folder / "state.toml").string();
  ASSERT_TRUE(replace_file(path, std::string(100'000, 'a')));
  ASSERT_TRUE(replace_file(path, "short\n"));
  EXPECT_EQ(test::read_text(path), "short\n");
  const std::filesystem::directory_iterator files(folder.path());
  EXPECT_EQ(std::distance(begin(files), end(files)), 1);
}

TEST(DurableFile, TakesAPathWithoutAFolder) {
  const test::TempFolder folder;
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  EXPECT_TRUE(replace_file("state.toml", "text\n"));
  std::filesystem::current_path(before);
  EXPECT_EQ(test::read_text(folder / "state.toml"), "text\n");
}

TEST(DurableFile, KeepsTheOldTextWhenTheNewOneCannotBeWritten) {
  const test::TempFolder folder;
  const std::string path = (folder / "state.toml").string();
  ASSERT_TRUE(replace_file(path, "old\n"));
  std::filesystem::create_symlink("/dev/full", path + ".part");
  EXPECT_FALSE(replace_file(path, "new\n"));
  EXPECT_EQ(errno, ENOSPC);
  EXPECT_EQ(test::read_text(path), "old\n");
  EXPECT_FALSE(replace_file("/nonexistent/state.toml", "new\n"));
  EXPECT_EQ(errno, ENOENT);
}

}  // namespace
}  // namespace plumb
