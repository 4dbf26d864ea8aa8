#include "modules/datasets/folder/image_folder.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/expect_throw.hpp"
#include "tests/support/temp_folder.hpp"

namespace plumb {
namespace {

using test::expect_contains;
using test::input_error_of;

struct Listed {
  std::string name;
  std::int64_t seq = 0;
  std::int64_t capture_us = 0;

  bool operator==(const Listed&) const = default;
};

std::ostream& operator<<(std::ostream& out, const Listed& image) {
  return out << image.name << " " << image.seq << " " << image.capture_us;
}

/// A folder "images" of empty files: the list depends on names alone.
class ImageFolderTest : public ::testing::Test {
 protected:
  void add(std::initializer_list<const char*> names) const {
    for (const char* name : names) folder_.write(std::string("images/") + name, "");
  }
  [[nodiscard]] ImageFolder list(double rate_hz = 0.0,
                                 const std::filesystem::path& times = {}) const {
    return list_image_folder({folder_ / "images", rate_hz, times});
  }
  [[nodiscard]] std::vector<Listed> images(double rate_hz = 0.0) const {
    std::vector<Listed> found;
    for (const FolderImage& image : list(rate_hz).images)
      found.push_back({image.path.filename().string(), image.seq, image.capture_us});
    return found;
  }
  [[nodiscard]] std::vector<std::string> names(double rate_hz = 10.0) const {
    std::vector<std::string> found;
    for (const Listed& image : images(rate_hz)) found.push_back(image.name);
    return found;
  }
  [[nodiscard]] std::string error(double rate_hz = 0.0,
                                  const std::filesystem::path& times = {}) const {
    return input_error_of([&] { (void)list(rate_hz, times); });
  }
  test::TempFolder folder_;
};

TEST_F(ImageFolderTest, ComparesNumbersByTheirValue) {
  add({"frame_10.jpg", "frame_9.jpg", "frame_11.jpg"});
  EXPECT_EQ(images(20.0), (std::vector<Listed>{{"frame_9.jpg", 9, 0},
                                               {"frame_10.jpg", 10, 50'000},
                                               {"frame_11.jpg", 11, 100'000}}));
  EXPECT_TRUE(list(20.0).notes.empty());
}

TEST_F(ImageFolderTest, TakesImagesInAnyCaseAndPassesOverTheRest) {
  add({"img-0002.JPG", "img-0001.Jpeg", "notes.txt", "._img-0001.Jpeg", "img-0003", "3.png/x.txt"});
  EXPECT_EQ(names(), (std::vector<std::string>{"img-0001.Jpeg", "img-0002.JPG"}));
}

TEST_F(ImageFolderTest, FindsTheCounterWhereverItStands) {
  add({"run2_frame_9_cam0.png", "run2_frame_10_cam0.png"});
  EXPECT_EQ(images(10.0), (std::vector<Listed>{{"run2_frame_9_cam0.png", 9, 0},
                                               {"run2_frame_10_cam0.png", 10, 100'000}}));
}

TEST_F(ImageFolderTest, MissingNumbersLeaveTheirGap) {
  add({"1.jpg", "2.jpg", "5.jpg"});
  EXPECT_EQ(images(10.0),
            (std::vector<Listed>{{"1.jpg", 1, 0}, {"2.jpg", 2, 100'000}, {"5.jpg", 5, 400'000}}));
  EXPECT_EQ(list(10.0).notes, std::vector<std::string>{"2 images are missing before 5.jpg"});
}

TEST_F(ImageFolderTest, TellsGapsButNotForever) {
  add({"00.png", "01.png", "03.png", "05.png", "07.png", "09.png", "11.png", "13.png"});
  const std::vector<std::string> notes = list(10.0).notes;
  ASSERT_EQ(notes.size(), 6U);
  EXPECT_EQ(notes[0], "1 image is missing before 03.png");
  EXPECT_EQ(notes[5], "1 further gaps");
}

TEST_F(ImageFolderTest, CountsEveryNthFrame) {
  add({"a0.jpg", "a10.jpg", "a20.jpg", "a40.jpg"});
  EXPECT_EQ(images(10.0), (std::vector<Listed>{{"a0.jpg", 0, 0},
                                               {"a10.jpg", 1, 100'000},
                                               {"a20.jpg", 2, 200'000},
                                               {"a40.jpg", 4, 400'000}}));
  expect_contains(list(10.0).notes.front(), "multiples of 10 apart");
}

TEST_F(ImageFolderTest, NamesThatDoNotCountGiveConsecutiveImages) {
  add({"bend.jpg", "avenue.jpg", "crossing.jpg"});
  EXPECT_EQ(images(10.0),
            (std::vector<Listed>{
                {"avenue.jpg", 0, 0}, {"bend.jpg", 1, 100'000}, {"crossing.jpg", 2, 200'000}}));
  expect_contains(list(10.0).notes.front(), "taken as consecutive");
}

TEST_F(ImageFolderTest, NumbersOfWhichNearlyAllAreMissingDoNotCount) {
  add({"20240501_120000_137.jpg", "20240501_120000_90212.jpg", "20240501_120000_734421.jpg"});
  const ImageFolder listed = list(10.0);
  EXPECT_EQ(listed.images.back().seq, 2);
  EXPECT_EQ(listed.images.back().capture_us, 200'000);
  expect_contains(listed.notes.front(), "taken as consecutive");
}

TEST_F(ImageFolderTest, RefusesTwoImagesOfOneFrame) {
  add({"frame_1.jpg", "frame_01.png", "frame_2.jpg"});
  expect_contains(error(10.0), "frame_01.png and frame_1.jpg name the same frame");
}

TEST_F(ImageFolderTest, NanosecondsMicrosecondsAndMillisecondsInNamesAreTimes) {
  add({"1403636579863555584.png", "1403636579763555584.png"});
  EXPECT_EQ(images(), (std::vector<Listed>{{"1403636579763555584.png", 0, 1'403'636'579'763'555},
                                           {"1403636579863555584.png", 1, 1'403'636'579'863'555}}));
  EXPECT_EQ(list().notes, std::vector<std::string>{"times from the names of the images"});

  std::filesystem::remove_all(folder_ / "images");
  add({"n015_CAM_FRONT__1532402927612460.jpg", "n015_CAM_FRONT__1532402927662460.jpg"});
  EXPECT_EQ(images().back().capture_us, 1'532'402'927'662'460);

  std::filesystem::remove_all(folder_ / "images");
  add({"1532402927612.jpg", "1532402927662.jpg"});
  EXPECT_EQ(images().back().capture_us, 1'532'402'927'662'000);
}

TEST_F(ImageFolderTest, SecondsInNamesAreInTheOrderOfTheTimes) {
  add({"1305031102.5.png", "1305031102.175304.png", "1305031102.25.png"});
  EXPECT_EQ(images(), (std::vector<Listed>{{"1305031102.175304.png", 0, 1'305'031'102'175'304},
                                           {"1305031102.25.png", 1, 1'305'031'102'250'000},
                                           {"1305031102.5.png", 2, 1'305'031'102'500'000}}));
}

TEST_F(ImageFolderTest, CountersOfThirteenDigitsAndTimesOfTwoCamerasAreNoTimes) {
  add({"0000000000001.png", "0000000000002.png"});
  expect_contains(error(), "state --rate");
  EXPECT_EQ(images(10.0).front().seq, 1);

  std::filesystem::remove_all(folder_ / "images");
  add({"left_1532402927612.jpg", "right_1532402927612.jpg"});
  expect_contains(error(), "state --rate");
}

TEST_F(ImageFolderTest, TakesTheFileOfTimesInTheFolderBeforeTheOneAboveIt) {
  add({"a.jpg", "b.jpg"});
  folder_.write("times.txt", "0\n0.2\n");
  EXPECT_EQ(images().back().capture_us, 200'000);
  expect_contains(list().notes.front(), "times from");
  folder_.write("images/times.txt", "0\n0.3\n");
  EXPECT_EQ(images().back().capture_us, 300'000);
  const auto own = folder_.write("own.txt", "# s\n1700000000.25\n1700000000.5\n");
  EXPECT_EQ(list(0.0, own).images.back().capture_us, 1'700'000'000'500'000);
  EXPECT_EQ(images(10.0).back().capture_us, 100'000) << "a stated rate comes first";
}

TEST_F(ImageFolderTest, TakesTheRowsThatTheNumbersName) {
  add({"000002.png", "000004.png"});
  folder_.write("times.txt", "0\n0.1\n0.2\n0.35\n0.4\n0.5\n");
  EXPECT_EQ(images(), (std::vector<Listed>{{"000002.png", 1, 200'000}, {"000004.png", 2, 400'000}}))
      << "of the whole sequence";
  folder_.write("times.txt", "0.2\n0.35\n0.4\n");
  EXPECT_EQ(images().back().capture_us, 400'000) << "from the first image on";
  folder_.write("times.txt", "0.2\n0.4\n");
  EXPECT_EQ(images().back().capture_us, 400'000) << "one per image";
}

TEST_F(ImageFolderTest, RefusesTimesThatDoNotFit) {
  add({"1.jpg", "2.jpg", "3.jpg"});
  const auto error_of = [&](const std::string& rows) {
    return error(0.0, folder_.write("t.txt", rows));
  };
  expect_contains(error_of("0\n1\n"), "t.txt has 2 rows for 3 images numbered 1 to 3");
  expect_contains(error_of("0\n1\n1\n"), "3.jpg is not after that of 2.jpg");
  expect_contains(error_of("0\n1\nsoon\n"), "t.txt:3: 'soon' is not a finite number");
  expect_contains(error_of("0\n1\n-2\n"), "t.txt:3: time is outside [0, 4e9] s");
  expect_contains(error_of("1403636579763555584\n1\n2\n"), "t.txt:1: time is outside");
  expect_contains(error(0.0, folder_ / "none.txt"), "cannot read");
  add({"first.jpg"});
  expect_contains(error_of("0\n1\n2\n"), "t.txt has 3 times for 4 images");
}

TEST_F(ImageFolderTest, RefusesAFolderWithoutImagesOrTimes) {
  expect_contains(error(), "no image folder");
  folder_.write("images/notes.txt", "");
  expect_contains(error(), "has no image (jpg, png, ...)");
  add({"1.jpg", "2.jpg"});
  expect_contains(error(), "neither times.txt nor the names tell when the images were taken");
}

}  // namespace
}  // namespace plumb
