// Tests that the newest text reaches the disk and that a failure is told.
#include "platform/file_thread.hpp"

#include <gtest/gtest.h>

#include <cerrno>
#include <chrono>
#include <filesystem>
#include <string>
#include <thread>

#include "tests/support/temp_folder.hpp"

namespace plumb {
namespace {

TEST(FileThread, WritesTheNewestTextBeforeItEnds) {
  const test::TempFolder folder;
  const std::string path = (folder / "state.toml").string();
  {
    FileThread file(path, 100);
    for (int i = 0; i < 50; ++i) EXPECT_TRUE(file.replace("text " + std::to_string(i) + "\n"));
  }
  EXPECT_EQ(test::read_text(path), "text 49\n");
}

TEST(FileThread, RefusesATextThatDoesNotFitAndKeepsTheOneBefore) {
  const test::TempFolder folder;
  const std::string path = (folder / "state.toml").string();
  {
    FileThread file(path, 64);
    EXPECT_TRUE(file.replace("short\n"));
    EXPECT_FALSE(file.replace(std::string(1'000, 'a')));
  }
  EXPECT_EQ(test::read_text(path), "short\n");
}

TEST(FileThread, TouchesNoFileWithoutAText) {
  const test::TempFolder folder;
  { const FileThread file((folder / "state.toml").string(), 64); }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(FileThread, SaysWhyTheFileCannotBeWritten) {
  FileThread file("/nonexistent/state.toml", 64);
  EXPECT_EQ(file.error(), 0);
  ASSERT_TRUE(file.replace("text\n"));
  for (int i = 0; file.error() == 0 && i < 1'000; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_EQ(file.error(), ENOENT);
}

}  // namespace
}  // namespace plumb
