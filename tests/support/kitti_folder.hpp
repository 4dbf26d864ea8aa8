/// Writes small KITTI sequences to disk.
#pragma once

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "modules/datasets/text.hpp"
#include "tests/support/temp_folder.hpp"

namespace plumb::test {

/// All images differ, so that a wrong order is detected.
inline cv::Mat test_image(int frame, int width_px = 96, int height_px = 72) {
  cv::Mat image(height_px, width_px, CV_8UC1);
  for (int v = 0; v < height_px; ++v)
    for (int u = 0; u < width_px; ++u)
      image.at<std::uint8_t>(v, u) = static_cast<std::uint8_t>(u * 2 + v * 3 + frame * 7);
  return image;
}

inline void write_image(const TempFolder& folder, const std::string& name, const cv::Mat& image) {
  std::filesystem::create_directories((folder / name).parent_path());
  cv::imwrite((folder / name).string(), image);
}

/// Writes times.txt with one row per image at intervals of 0.1 s from `first_s` on.
inline void write_times(const TempFolder& folder, const std::string& name, int num_rows,
                        double first_s = 0.0) {
  std::string rows;
  for (int i = 0; i < num_rows; ++i) rows += format("%.6e\n", first_s + 0.1 * i);
  folder.write(name, rows);
}

inline constexpr const char* kCalibration =
    "P0: 80 0 48 0 0 80 36 0 0 0 1 0\n"
    "P2: 80 0 48 4.8 0 80 36 0 0 0 1 0\n";

/// Writes seq/image_0/NNNNNN.png from `first` on, calib.txt, and times.txt with one row per image
/// at intervals of 0.1 s.
inline std::filesystem::path write_odometry(const TempFolder& folder, int num_frames,
                                            int first = 0) {
  for (int i = first; i < first + num_frames; ++i)
    write_image(folder, format("seq/image_0/%06d.png", i), test_image(i));
  write_times(folder, "seq/times.txt", num_frames);
  folder.write("seq/calib.txt", kCalibration);
  return folder / "seq";
}

inline constexpr const char* kRawCalibration =
    "calib_time: 09-Jan-2012 13:57:47\n"
    "R_rect_00: 1 0 0 0 1 0 0 0 1\n"
    "S_rect_00: 9.600000e+01 7.200000e+01\n"
    "P_rect_00: 80 0 48 0 0 80 36 0 0 0 1 0\n";

/// Writes date/drive/image_00/data/NNNNNNNNNN.png, the time stamps and, one folder above, the
/// camera calibration.
inline std::filesystem::path write_raw(const TempFolder& folder, int num_frames) {
  std::string times;
  for (int i = 0; i < num_frames; ++i) {
    write_image(folder, format("date/drive/image_00/data/%010d.png", i), test_image(i));
    times += format("2011-09-26 13:02:%02d.%09d\n", 25 + i / 10, i % 10 * 100'000'000);
  }
  folder.write("date/drive/image_00/timestamps.txt", times);
  folder.write("date/calib_cam_to_cam.txt", kRawCalibration);
  return folder / "date/drive";
}

/// An odometry sequence whose files a test changes one at a time. Focal lengths and principal point
/// differ from each other.
class KittiFolder {
 public:
  static constexpr int kWidth = 96;
  static constexpr int kHeight = 64;

  KittiFolder() {
    folder_.write("calib.txt",
                  "P0: 80.5 0 47.25 0 0 81.5 31.75 0 0 0 1 0\n"
                  "P2: 90.5 0 48.25 4.5 0 91.5 32.75 0 0 0 1 0\n");
  }
  [[nodiscard]] std::string path() const { return folder_.path().string(); }
  [[nodiscard]] std::string file(int number) const { return (folder_ / name_of(number)).string(); }
  [[nodiscard]] static cv::Mat image(int number) { return test_image(number, kWidth, kHeight); }

  void write(const std::string& name, const std::string& text) const { folder_.write(name, text); }
  void write_image(int number, const cv::Mat& pixels) const {
    test::write_image(folder_, name_of(number), pixels);
  }
  void write_image(int number) const { write_image(number, image(number)); }
  /// Writes `count` images from number `first` on; the time of the first is `first` / 10 s.
  void fill(int first, int count) const {
    for (int i = first; i < first + count; ++i) write_image(i);
    write_times(folder_, "times.txt", count, 0.1 * first);
  }

 private:
  static std::string name_of(int number) { return format("image_0/%06d.png", number); }
  TempFolder folder_;
};

}  // namespace plumb::test
