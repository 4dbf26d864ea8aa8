/// Measures the time of the ground library per 1242x375 frame of a rendered drive, in total and by
/// stage, and the error of the scale.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <vector>

#include "modules/ground/ground.hpp"
#include "tests/ground/road_scene.hpp"

namespace plumb {
namespace {

constexpr int kNumFrames = 24;

struct Footage {
  Footage() {
    camera.width_px = 1242;
    camera.height_px = 375;
    camera.fx_px = camera.fy_px = 721.5;
    camera.cx_px = 609.6;
    camera.cy_px = 172.9;
    camera.residual_k1 = 0.0256;
    camera.residual_k2 = -0.0076;
    camera.camera_height_m = test::kRoadHeight;
    const std::vector<Se3> poses = test::Drive{}.poses(kNumFrames);
    vo.resize(kNumFrames);
    for (int k = 0; k < kNumFrames; ++k) {
      const auto i = static_cast<std::size_t>(k);
      images.push_back(test::render(camera, poses[i], {.noise_grey = 1.5}, 1));
      test::script_vo(poses, k, script, &vo[i]);
    }
  }
  CameraModel camera;
  test::VoScript script;
  std::vector<test::GreyImage> images;
  std::vector<VoOutput> vo;
};

/// Collects the time of one named stage, or of the frame when the name is empty.
class StageClock final : public StageProbe {
 public:
  explicit StageClock(const char* stage) : stage_(stage) {}
  void begin() override { began_ = last_ = now_us(); }
  void mark(const char* name) override {
    const double now = now_us();
    if (std::strcmp(name, stage_) == 0) samples_.push_back(now - last_);
    last_ = now;
  }
  void end() {
    if (stage_[0] == '\0') samples_.push_back(now_us() - began_);
  }
  [[nodiscard]] double quantile_us(double q) {
    if (samples_.empty()) return 0.0;
    std::sort(samples_.begin(), samples_.end());
    return samples_[static_cast<std::size_t>(q * static_cast<double>(samples_.size() - 1))];
  }

 private:
  static double now_us() {
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    return std::chrono::duration<double, std::micro>(now).count();
  }
  const char* stage_;
  double began_ = 0.0;
  double last_ = 0.0;
  std::vector<double> samples_;
};

void drive(benchmark::State& state, const char* stage) {
  static const Footage footage;
  StageClock clock(stage);
  double log_scale = 0.0;
  for (auto _ : state) {
    GroundEstimator estimator(GroundConfig{}, footage.camera);
    for (std::size_t k = 0; k < kNumFrames; ++k) {
      const GroundInput input{&footage.vo[k], footage.images[k].view()};
      log_scale = estimator.update(input, clock).ego.log_scale;
      clock.end();
    }
  }
  state.counters["median_us"] = clock.quantile_us(0.5);
  state.counters["p99_us"] = clock.quantile_us(0.99);
  const double error = log_scale - std::log(footage.script.metres_per_vo);
  state.counters["scale_error_percent"] = 100.0 * error;
}

BENCHMARK_CAPTURE(drive, whole_frame, "")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(drive, pyramid, "pyramid")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(drive, dense, "dense")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(drive, points, "points")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(drive, fuse, "fuse")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(drive, ego, "ego")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace plumb

BENCHMARK_MAIN();
