/// Writes small KITTI folders, sound and broken.
#pragma once

#include <cstdio>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "tests/camera/pattern.hpp"
#include "tests/tools/temp_folder.hpp"

namespace plumb::test {

class KittiFolder {
 public:
  static constexpr int kWidth = 96;
  static constexpr int kHeight = 64;
  static constexpr const char* kCalibration =
      "P0: 80.5 0 47.25 0 0 81.5 31.75 0 0 0 1 0\nP2: 90.5 0 48.25 4.5 0 91.5 32.75 0 0 0 1 0\n";

  KittiFolder() { folder_.write("calib.txt", kCalibration); }

  [[nodiscard]] std::string path() const { return folder_.path().string(); }
  [[nodiscard]] std::string file(int number) const {
    char name[32];
    std::snprintf(name, sizeof name, "image_0/%06d.png", number);
    return (folder_ / name).string();
  }
  void write(const std::string& name, const std::string& text) const { folder_.write(name, text); }
  void write_image(int number, const cv::Mat& image) const {
    std::filesystem::create_directories(folder_ / "image_0");
    cv::imwrite(file(number), image);
  }
  void write_image(int number) const {
    write_image(number, noise(kHeight, kWidth, static_cast<unsigned>(number) + 1));
  }
  /// `count` images from `first` on, 0.1 s apart, the first at `first` / 10 s.
  void fill(int first, int count) const {
    std::string times;
    for (int i = first; i < first + count; ++i) {
      write_image(i);
      char row[32];
      std::snprintf(row, sizeof row, "%.6e\n", 0.1 * i);
      times += row;
    }
    write("times.txt", times);
  }

 private:
  TempFolder folder_;
};

}  // namespace plumb::test
