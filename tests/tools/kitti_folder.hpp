/// Small KITTI sequences on disk.
#pragma once

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "tests/tools/temp_folder.hpp"
#include "tools/support/text.hpp"

namespace plumb::test {

/// Every image differs, so that none can stand for another.
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

inline constexpr const char* kCalibration =
    "P0: 80 0 48 0 0 80 36 0 0 0 1 0\n"
    "P2: 80 0 48 4.8 0 80 36 0 0 0 1 0\n";

/// seq/image_0/NNNNNN.png from `first` on, calib.txt and times.txt (0.1 s apart) with one row per
/// image.
inline std::filesystem::path write_odometry(const TempFolder& folder, int num_frames,
                                            int first = 0) {
  std::string times;
  for (int i = 0; i < num_frames; ++i) {
    write_image(folder, format("seq/image_0/%06d.png", first + i), test_image(first + i));
    times += format("%.6e\n", 0.1 * i);
  }
  folder.write("seq/times.txt", times);
  folder.write("seq/calib.txt", kCalibration);
  return folder / "seq";
}

inline constexpr const char* kRawCalibration =
    "calib_time: 09-Jan-2012 13:57:47\n"
    "R_rect_00: 1 0 0 0 1 0 0 0 1\n"
    "S_rect_00: 9.600000e+01 7.200000e+01\n"
    "P_rect_00: 80 0 48 0 0 80 36 0 0 0 1 0\n";

/// date/drive/image_00/data/NNNNNNNNNN.png, time stamps and, one folder up, the camera calibration.
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

}  // namespace plumb::test
