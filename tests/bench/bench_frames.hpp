/// Frames and clocks that the benchmarks share.
#pragma once

#include <benchmark/benchmark.h>
#include <time.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "core/camera_model.hpp"
#include "core/stage_probe.hpp"
#include "tests/support/kitti_data.hpp"
#include "tests/support/scene.hpp"

namespace plumb::bench {

inline constexpr int kMaxFrames = 160;

/// Processor time that this thread has used.
inline double thread_ms() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

inline double percentile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

struct Frames {
  std::string name;
  CameraModel camera;
  std::vector<cv::Mat> images;
};

/// Loads up to `max_frames` of the real drive or, where that is missing, renders a street.
inline Frames load_frames(int max_frames = kMaxFrames) {
  Frames frames;
  const auto folder = test::kitti_sequence("raw/drive0039_024-400");
  if (!folder.empty()) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "image_0")) {
      files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    files.resize(std::min(files.size(), static_cast<std::size_t>(std::max(0, max_frames))));
    for (const auto& f : files)
      frames.images.push_back(cv::imread(f.string(), cv::IMREAD_GRAYSCALE));
    std::ifstream calib(folder / "calib.txt");
    std::string key;
    double p[12];
    calib >> key;
    for (double& x : p) calib >> x;
    frames.camera = {frames.images[0].cols,
                     frames.images[0].rows,
                     p[0],
                     p[5],
                     p[2],
                     p[6],
                     0.0256,
                     -0.0076,
                     1.65};
    frames.name = "KITTI drive0039";
    return frames;
  }
  frames.camera = {1242, 375, 721.5, 721.5, 609.6, 172.9, 0.0, 0.0, 1.65};
  frames.name = "rendered street";
  const test::Scene scene(frames.camera);
  unsigned seed = 0;
  for (const Se3& T_world_cam : test::drive(std::min(max_frames, kMaxFrames), 0.7)) {
    const test::RenderedImage image = scene.render(T_world_cam, 1.5, ++seed);
    frames.images.push_back(
        cv::Mat(375, 1242, CV_8U, const_cast<unsigned char*>(image.pixels.data())).clone());
  }
  return frames;
}

/// Collects the stage times of every frame.
class StageClock final : public StageProbe {
 public:
  void begin() override {
    frame_.clear();
    total_ms_ = 0.0;
    last_ms_ = thread_ms();
  }
  void mark(const char* name) override {
    const double now = thread_ms();
    frame_[name] += now - last_ms_;
    total_ms_ += now - last_ms_;
    last_ms_ = now;
  }
  /// Ends the frame and returns its total time.
  double end() {
    for (const auto& [name, ms] : frame_) stages_[name].push_back(ms);
    totals_.push_back(total_ms_);
    return total_ms_;
  }
  [[nodiscard]] double median_ms() const { return percentile(totals_, 0.5); }
  void report(benchmark::State& state, const std::string& prefix) const {
    state.counters[prefix + "_median_ms"] = median_ms();
    state.counters[prefix + "_p99_ms"] = percentile(totals_, 0.99);
    for (const auto& [name, ms] : stages_) {
      state.counters[prefix + "/" + name + "_median_ms"] = percentile(ms, 0.5);
      state.counters[prefix + "/" + name + "_p99_ms"] = percentile(ms, 0.99);
    }
  }

 private:
  std::map<std::string, double> frame_;
  std::map<std::string, std::vector<double>> stages_;
  std::vector<double> totals_;
  double total_ms_ = 0.0;
  double last_ms_ = 0.0;
};

}  // namespace plumb::bench
