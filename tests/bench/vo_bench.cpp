/// Measures the time of the visual odometry per stage, beside one OpenCV calcOpticalFlowPyrLK on
/// the same frames in the same run.
///
/// The frames are those of KITTI where it exists (PLUMBLINE_DATA), and else those of a rendered
/// street. Times are the processor time of one thread, which other programs affect little.
#include <benchmark/benchmark.h>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

#include "modules/vo/vo.hpp"
#include "tests/bench/bench_frames.hpp"

namespace plumb::bench {
namespace {

constexpr int kLkPoints = 1000;
const cv::Size kLkWindow(21, 21);

double lk_ms(const cv::Mat& from, const cv::Mat& to, const std::vector<cv::Point2f>& points,
             int max_level) {
  std::vector<cv::Point2f> found;
  std::vector<unsigned char> status;
  std::vector<float> error;
  const double start = thread_ms();
  cv::calcOpticalFlowPyrLK(from, to, points, found, status, error, kLkWindow, max_level);
  return thread_ms() - start;
}

void vo_beside_pyrlk(benchmark::State& state) {
  cv::setNumThreads(1);
  const Frames frames = load_frames();
  if (frames.images.size() < kMaxFrames) {
    state.SkipWithError("too few frames");
    return;
  }
  VisualOdometry odometry(VoConfig{}, frames.camera, 1);
  StageClock stages;
  std::vector<double> lk3;
  std::vector<double> lk4;
  std::size_t i = 0;
  for ([[maybe_unused]] auto iteration : state) {
    const cv::Mat& image = frames.images[i];
    const auto seq = static_cast<std::int64_t>(i);
    odometry.update(
        {100'000 * (seq + 1),
         seq,
         {image.data, image.cols, image.rows, static_cast<std::ptrdiff_t>(image.step[0])}},
        stages);
    state.SetIterationTime(1e-3 * stages.end());
    if (i > 0) {
      std::vector<cv::Point2f> points;
      cv::goodFeaturesToTrack(frames.images[i - 1], points, kLkPoints, 0.001, 7.0);
      lk3.push_back(lk_ms(frames.images[i - 1], image, points, 2));
      lk4.push_back(lk_ms(frames.images[i - 1], image, points, 3));
    }
    ++i;
  }
  stages.report(state, "vo");
  state.counters["lk_3_levels_median_ms"] = percentile(lk3, 0.5);
  state.counters["lk_4_levels_median_ms"] = percentile(lk4, 0.5);
  state.counters["vo_over_lk_3_levels"] = stages.median_ms() / percentile(lk3, 0.5);
  state.counters["vo_over_lk_4_levels"] = stages.median_ms() / percentile(lk4, 0.5);
  state.SetLabel(frames.name);
}

BENCHMARK(vo_beside_pyrlk)->Iterations(kMaxFrames)->UseManualTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace plumb::bench

BENCHMARK_MAIN();
