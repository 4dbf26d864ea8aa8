/// Measures the time of one update of the object tracker with the largest number of objects: 32
/// cars along a street.
#include <benchmark/benchmark.h>

#include <stdexcept>

#include "modules/objects/objects.hpp"
#include "tests/objects/cuboid_scene.hpp"

namespace plumb {
namespace {

constexpr double kSpeed_m_s = 10.0;
constexpr int kNumFrames = 10;

/// The frames of a drive between two rows of parked cars.
std::vector<DetectionFrame> street() {
  std::vector<DetectionFrame> frames(kNumFrames);
  for (int k = 0; k < kNumFrames; ++k) {
    DetectionFrame& frame = frames[static_cast<std::size_t>(k)];
    frame.seq = k;
    frame.capture_us = 100'000 * k;
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(kMaxObjects); ++i) {
      const double x_m = 20.0 + 4.0 * (i / 2) - 0.1 * kSpeed_m_s * k;
      const StateVector car = test::car_at(x_m, i % 2 == 0 ? 6.0 : -6.0, 0.0);
      if (!frame.detections.push_back(test::detect(car, test::road(0.0), i))) {
        throw std::logic_error("more boxes than a frame holds");
      }
    }
  }
  return frames;
}

void track_32_cars(benchmark::State& state) {
  const std::vector<DetectionFrame> frames = street();
  ObjectsInput input;
  input.plane = test::road(0.0);
  input.plane.cov.diagonal() << 1e-6, 1e-5, 1e-5;
  input.plane_measured = true;
  std::size_t num_objects = 0;
  ObjectTracker tracker(DetectionsConfig{}, ObjectsConfig{}, test::kSceneCamera);
  while (state.KeepRunningBatch(kNumFrames - 1)) {
    state.PauseTiming();
    tracker = ObjectTracker(DetectionsConfig{}, ObjectsConfig{}, test::kSceneCamera);
    input.frame = &frames[0];
    input.motion = {};
    tracker.update(input);  // only the first update of an object tries several headings
    input.motion = {0.1, true, {0.1 * kSpeed_m_s, 0.0}, 0.0};
    state.ResumeTiming();
    for (std::size_t k = 1; k < frames.size(); ++k) {
      input.frame = &frames[k];
      num_objects = tracker.update(input).objects.size();
    }
  }
  state.counters["objects"] = static_cast<double>(num_objects);
}
BENCHMARK(track_32_cars)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace plumb

BENCHMARK_MAIN();
