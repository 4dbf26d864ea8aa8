/// Tests files of samples. What is written is read back. Files that are incomplete, of another
/// version, or of mixed drives or algorithms are refused.
#include "tools/learn/train/sample_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "tests/support/expect_throw.hpp"
#include "tests/support/temp_folder.hpp"
#include "tests/train/drawn.hpp"

namespace plumb {
namespace {

class SampleFile : public testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path write(const DriveSamples& drive) const {
    const auto path = folder_.path() / (drive.drive + ".csv");
    write_samples(drive, path);
    return path;
  }
  /// A copy of a sound file in which `from` is replaced once by `to`.
  [[nodiscard]] std::filesystem::path changed(const std::string& from,
                                              const std::string& to) const {
    std::string text = test::read_text(write(test::draw_drive("sound", 3, 1, 0.01)));
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
    const auto path = folder_.path() / "changed.csv";
    std::ofstream(path) << text;
    return path;
  }
  test::TempFolder folder_;
};

TEST_F(SampleFile, ComesBackToTheLastBit) {
  const DriveSamples drive = test::draw_drive("04_000-050", 20, 7, 0.0123);
  const DriveSamples back = read_samples(write(drive));
  EXPECT_EQ(back.drive, drive.drive);
  EXPECT_EQ(back.algorithm, drive.algorithm);
  ASSERT_EQ(back.frames.size(), drive.frames.size());
  for (std::size_t i = 0; i < drive.frames.size(); ++i) {
    std::vector<double> a, b;
    Sample::visit(drive.frames[i], [&a](const char*, double v) { a.push_back(v); });
    Sample::visit(back.frames[i], [&b](const char*, double v) { b.push_back(v); });
    for (std::size_t k = 0; k < a.size(); ++k) {
      if (std::isnan(a[k])) {
        EXPECT_TRUE(std::isnan(b[k]));
      } else {
        EXPECT_EQ(a[k], b[k]);
      }
    }
  }
}

TEST_F(SampleFile, AppearsWholeOrNotAtAll) {
  const auto path = folder_.path() / "nowhere" / "a.csv";
  EXPECT_THROW(write_samples(test::draw_drive("a", 3, 1, 0.01), path), InputError);
  (void)write(test::draw_drive("a", 3, 1, 0.01));
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path()))
    EXPECT_EQ(entry.path().filename(), "a.csv");  // no temporary file is left
}

TEST_F(SampleFile, OfAnotherVersionIsRefused) {
  test::expect_contains(
      test::input_error_of([&] { (void)read_samples(changed("version 3", "version 1")); }),
      "changed.csv:1: holds samples of version '1'");
}

TEST_F(SampleFile, WithoutItsFirstLineIsRefused) {
  test::expect_contains(
      test::input_error_of([&] { (void)read_samples(changed("# plumb-train", "# other")); }),
      "changed.csv:1: is not a sample file");
}

TEST_F(SampleFile, WithOtherColumnsIsRefused) {
  test::expect_contains(
      test::input_error_of([&] { (void)read_samples(changed("seq,", "number,")); }),
      "changed.csv:2: columns");
}

TEST_F(SampleFile, WithAWordForANumberIsRefused) {
  test::expect_contains(
      test::input_error_of([&] { (void)read_samples(changed("\n1,", "\none,")); }),
      "changed.csv:4: seq: 'one' is not a number");
}

TEST_F(SampleFile, WithACellTooFewIsRefused) {
  test::expect_contains(test::input_error_of([&] { (void)read_samples(changed("\n1,,", "\n1,")); }),
                        "changed.csv:4: ");
}

TEST_F(SampleFile, CutShortIsRefused) {
  test::expect_contains(test::input_error_of([&] { (void)read_samples(changed("# end 3\n", "")); }),
                        "not complete");
  test::expect_contains(
      test::input_error_of([&] { (void)read_samples(changed("# end 3", "# end 4")); }),
      "not complete");
}

TEST_F(SampleFile, OfTheSameDriveTwiceOrOfTwoAlgorithmsIsRefused) {
  const auto a = write(test::draw_drive("a", 3, 1, 0.01));
  DriveSamples paper = test::draw_drive("b", 3, 1, 0.01);
  paper.algorithm = "paper";
  const auto b = write(paper);
  EXPECT_EQ(read_all_samples({a}).size(), 1U);
  test::expect_contains(test::input_error_of([&] {
                          (void)read_all_samples({a, a});
                        }),
                        "drive a is there twice");
  test::expect_contains(test::input_error_of([&] {
                          (void)read_all_samples({a, b});
                        }),
                        "made with paper");
}

TEST(DriveName, HoldsNoBlanksCommasOrSlashes) {
  EXPECT_TRUE(is_drive_name("2011_09_26-0009.a+b"));
  for (const char* name : {"", "a b", "a,b", "a/b"}) EXPECT_FALSE(is_drive_name(name)) << name;
}

}  // namespace
}  // namespace plumb
