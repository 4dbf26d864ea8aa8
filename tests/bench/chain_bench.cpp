/// Measures the time of vo and ground per frame, beside one OpenCV calcOpticalFlowPyrLK of 1000
/// points on the same frames in the same run, and the memory that both estimators own.
///
///     chain_bench [frames]      takes the whole drive without the argument
///
/// The frames are those of KITTI where it exists (PLUMBLINE_DATA), and else those of a rendered
/// street. Times are the processor time of one thread. The three take turns frame by frame, so that
/// other load affects them alike. Detecting the 1000 points is not counted. Building both of
/// PyrLK's pyramids is, because vo and ground build theirs as well.

#include <cstdio>
#include <cstdlib>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

#include "modules/ground/ground.hpp"
#include "modules/vo/vo.hpp"
#include "tests/bench/bench_frames.hpp"
#include "tests/support/heap_bytes.hpp"

namespace plumb::bench {
namespace {

constexpr int kLkPoints = 1000;
constexpr int kLkLevels = 3;
const cv::Size kLkWindow(21, 21);
constexpr double kMegabyte = 1024.0 * 1024.0;

double heap_mb() { return static_cast<double>(test::heap_bytes()) / kMegabyte; }

double lk_ms(const cv::Mat& from, const cv::Mat& to) {
  std::vector<cv::Point2f> points;
  cv::goodFeaturesToTrack(from, points, kLkPoints, 0.001, 7.0);
  std::vector<cv::Point2f> found;
  std::vector<unsigned char> status;
  std::vector<float> error;
  const double start = thread_ms();
  cv::calcOpticalFlowPyrLK(from, to, points, found, status, error, kLkWindow, kLkLevels - 1);
  return thread_ms() - start;
}

struct Times {
  std::vector<double> vo;
  std::vector<double> ground;
  std::vector<double> sum;
  std::vector<double> lk;
};

Times run(const Frames& frames, VisualOdometry& odometry, GroundEstimator& estimator) {
  Times times;
  NullProbe probe;
  for (std::size_t i = 0; i < frames.images.size(); ++i) {
    const cv::Mat& mat = frames.images[i];
    const ImageView image{mat.data, mat.cols, mat.rows, static_cast<std::ptrdiff_t>(mat.step[0])};
    const auto seq = static_cast<std::int64_t>(i);
    const double start = thread_ms();
    const VoOutput& vo = odometry.update({100'000 * (seq + 1), seq, image}, probe);
    const double between = thread_ms();
    (void)estimator.update({&vo, image}, probe);
    const double end = thread_ms();
    if (i == 0) continue;  // the first frame has nothing to track
    times.vo.push_back(between - start);
    times.ground.push_back(end - between);
    times.sum.push_back(end - start);
    times.lk.push_back(lk_ms(frames.images[i - 1], mat));
  }
  return times;
}

void print_row(const char* name, const std::vector<double>& ms, const std::vector<double>& lk) {
  std::printf("%-28s %9.3f %9.3f %9.3f\n", name, percentile(ms, 0.5), percentile(ms, 0.99),
              percentile(ms, 0.5) / percentile(lk, 0.5));
}

}  // namespace
}  // namespace plumb::bench

int main(int argc, char** argv) {
  using namespace plumb;
  using namespace plumb::bench;
  cv::setNumThreads(1);
  const int wanted = argc > 1 ? std::atoi(argv[1]) : 100'000;
  const Frames frames = load_frames(wanted);
  if (frames.images.size() < 20) {
    std::fprintf(stderr, "chain_bench: too few frames\n");
    return 2;
  }
  const double heap_before = heap_mb();
  VisualOdometry odometry(VoConfig{}, frames.camera, 1);
  const double heap_vo = heap_mb();
  GroundEstimator estimator(GroundConfig{}, frames.camera);
  const double heap_ground = heap_mb();
  const Times times = run(frames, odometry, estimator);

  std::printf("%s, %zu frames of %dx%d\n", frames.name.c_str(), frames.images.size(),
              frames.camera.width_px, frames.camera.height_px);
  std::printf("%-28s %9s %9s %9s\n", "processor time per frame, ms", "median", "p99", "of PyrLK");
  print_row("vo", times.vo, times.lk);
  print_row("ground", times.ground, times.lk);
  print_row("vo + ground", times.sum, times.lk);
  print_row("PyrLK, 1000 points", times.lk, times.lk);
  std::printf("heap owned, MB: vo %.1f, ground %.1f\n", heap_vo - heap_before,
              heap_ground - heap_vo);
}
