#include "tools/synth/writer.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <cstdio>
#include <exception>
#include <fstream>
#include <mutex>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <thread>
#include <vector>

#include "platform/overwrite_guard.hpp"
#include "tools/synth/codec.hpp"

namespace plumb::synth {
namespace {

namespace fs = std::filesystem;

constexpr int kMinLabelPixels = 25;
constexpr const char* kImageFolder = "image_0";
constexpr std::array kTextFiles = {"calib.txt",           "times.txt",   "poses.txt",
                                   "gt_ground_plane.txt", "vehicle.txt", "label_02.txt"};

/// A text file that throws std::runtime_error when it cannot be written.
class TextFile {
 public:
  explicit TextFile(const fs::path& path) : path_(path), out_(path) { check(); }
  ~TextFile() = default;
  TextFile(const TextFile&) = delete;
  TextFile& operator=(const TextFile&) = delete;

  void line(const std::string& text) { out_ << text << '\n'; }
  void finish() {
    out_.flush();
    check();
  }

 private:
  void check() const {
    if (!out_) throw std::runtime_error("cannot write " + path_.string());
  }
  fs::path path_;
  std::ofstream out_;
};

template <typename... Values>
std::string format(const char* pattern, Values... values) {
  std::array<char, 512> text{};
  std::snprintf(text.data(), text.size(), pattern, values...);
  return text.data();
}

std::string projection_row(const char* name, const CameraModel& c, double baseline_m) {
  return format(
      "%s: %.12e 0.000000000000e+00 %.12e %.12e 0.000000000000e+00 %.12e %.12e 0.000000000000e+00 "
      "0.000000000000e+00 0.000000000000e+00 1.000000000000e+00 0.000000000000e+00",
      name, c.fx_px, c.cx_px, -c.fx_px * baseline_m, c.fy_px, c.cy_px);
}

void write_calibration(const fs::path& folder, const SynthConfig& config) {
  TextFile file(folder / "calib.txt");
  const CameraModel& camera = config.render.camera;
  file.line(projection_row("P0", camera, 0.0));
  file.line(projection_row("P1", camera, 0.54));
  file.line(projection_row("P2", camera, 0.0));
  file.line(projection_row("P3", camera, 0.54));
  file.line(format("residual_k1: %.9g", camera.residual_k1));
  file.line(format("residual_k2: %.9g", camera.residual_k2));
  const double stated_m =
      config.stated_height_m > 0.0 ? config.stated_height_m : config.drive.mount.height_m;
  file.line(format("camera_height_m: %.9g", stated_m));
  if (config.render.readout_s > 0.0) file.line(format("readout_s: %.9g", config.render.readout_s));
  file.finish();
}

std::string pose_row(const Se3& T) {
  std::string row;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) row += format("%.12e ", T.R(r, c));
    row += format(r < 2 ? "%.12e " : "%.12e", T.t[r]);
  }
  return row;
}

void write_truth(const Studio& studio, int frames, const std::vector<std::string>& labels) {
  const fs::path& folder = studio.config().out;
  TextFile times(folder / "times.txt");
  TextFile poses(folder / "poses.txt");
  TextFile planes(folder / "gt_ground_plane.txt");
  TextFile vehicle(folder / "vehicle.txt");
  TextFile objects(folder / "label_02.txt");
  planes.line(
      "# frame nx ny nz height_m n_points n_candidates rms_m ; plane n.X=h in the rendered "
      "camera's coords (x right,y down,z "
      "fwd), least squares through the road at 5<Z<20m, |X|<1.8m");
  vehicle.line(
      "# frame time_s speed_m_s accel_m_s2 yaw_rate_rad_s pitch_rad roll_rad heave_m s_m ; body "
      "against the map (pitch nose "
      "down, roll right side down), heave against the road");
  const Se3 T_first_map = studio.drive().T_map_cam(studio.time_s(0)).inverse();
  for (int i = 0; i < frames; ++i) {
    const double t = studio.time_s(i);
    const Se3 T_map_cam = studio.drive().T_map_cam(t);
    times.line(format("%.6e", t - studio.time_s(0)));
    poses.line(pose_row(T_first_map * T_map_cam));
    const PlaneTruth p = road_plane(studio.terrain(), T_map_cam);
    planes.line(format("%d %.9f %.9f %.9f %.6f %d %d %.5f", i, p.n_cam.x(), p.n_cam.y(),
                       p.n_cam.z(), p.height_m, p.num_points, p.num_candidates, p.rms_m));
    const VehicleState s = studio.drive().state(t);
    vehicle.line(format("%d %.6f %.5f %.5f %.6f %.6f %.6f %.5f %.4f", i, t - studio.time_s(0),
                        s.speed_m_s, s.accel_m_s2, s.yaw_rate_rad_s, s.pitch_rad, s.roll_rad,
                        s.heave_m, s.s_m));
    if (!labels[static_cast<std::size_t>(i)].empty())
      objects.line(labels[static_cast<std::size_t>(i)]);
  }
  for (TextFile* file : {&times, &poses, &planes, &vehicle, &objects}) file->finish();
}

/// Prints the time in tenths of a second, as dashcams do.
void print_stamp(double time_s, cv::Mat& image) {
  const double size = image.rows / 480.0;
  const std::string text = format("2024-05-17 14:%02d:%04.1f", 21 + static_cast<int>(time_s) / 60,
                                  std::fmod(time_s, 60.0));
  const cv::Point at(static_cast<int>(0.03 * image.cols), static_cast<int>(0.965 * image.rows));
  const int stroke = std::max(1, static_cast<int>(std::lround(1.6 * size)));
  cv::putText(image, text, at, cv::FONT_HERSHEY_SIMPLEX, 0.7 * size, cv::Scalar(0), stroke + 2);
  cv::putText(image, text, at, cv::FONT_HERSHEY_SIMPLEX, 0.7 * size, cv::Scalar(250), stroke);
}

/// The codec that all workers share. It takes the pictures in order.
class CodecQueue {
 public:
  explicit CodecQueue(const SynthConfig& config)
      : used_(config.compression > 0.0),
        codec_(config.compression, config.render.camera.width_px, config.render.camera.height_px) {}

  /// Codes a picture as soon as those before it are coded. Returns without, once `abandon` was
  /// called.
  void pass(int frame, std::vector<std::uint8_t>& picture) {
    if (!used_) return;
    std::unique_lock lock(mutex_);
    turn_.wait(lock, [&] { return next_ == frame || abandoned_; });
    if (abandoned_) return;
    codec_.pass(frame, picture);
    ++next_;
    turn_.notify_all();
  }
  void abandon() {
    const std::lock_guard lock(mutex_);
    abandoned_ = true;
    turn_.notify_all();
  }

 private:
  bool used_;
  Codec codec_;
  std::mutex mutex_;
  std::condition_variable turn_;
  int next_ = 0;
  bool abandoned_ = false;
};

/// Renders and writes single frames. Every thread has one.
class Worker {
 public:
  Worker(const Studio& studio, CodecQueue& codec)
      : studio_(studio),
        codec_(codec),
        renderer_(studio.world(), studio.config().render),
        sensor_(studio.config().sensor) {}

  std::string write(int frame) {
    const SynthConfig& config = studio_.config();
    const double t = studio_.time_s(frame);
    const double since_start = t - studio_.time_s(0);
    renderer_.render(t, rendered_);
    studio_.attached().lay_over(rendered_);
    const double light = config.tunnel.factor(since_start) * config.covered.factor(since_start) *
                         studio_.tube_exposure(since_start);
    sensor_.develop(rendered_, since_start, static_cast<std::uint64_t>(frame), light, bytes_);
    const fs::path path = config.out / kImageFolder / format("%06d.png", frame);
    cv::Mat image(rendered_.height_px, rendered_.width_px, CV_8UC1, bytes_.data());
    if (config.stamp) print_stamp(since_start, image);
    codec_.pass(frame, bytes_);
    if (!cv::imwrite(path.string(), image))
      throw std::runtime_error("cannot write " + path.string());
    std::string rows;
    const Se3 T_map_cam = studio_.drive().T_map_cam(t);
    for (const Label& label : make_labels(rendered_, renderer_.visible(), config.render.camera,
                                          T_map_cam, kMinLabelPixels)) {
      if (!rows.empty()) rows.push_back('\n');
      rows.append(label_row(frame, label));
    }
    return rows;
  }

 private:
  const Studio& studio_;
  CodecQueue& codec_;
  FrameRenderer renderer_;
  Sensor sensor_;
  RenderedFrame rendered_;
  std::vector<std::uint8_t> bytes_;
};

}  // namespace

void prepare_folder(const fs::path& folder, bool force) {
  std::error_code error;
  if (fs::exists(folder, error)) {
    if (!fs::is_directory(folder, error)) throw UsageError(folder.string() + " is not a folder");
    if (!fs::is_empty(folder, error) && !force)
      throw UsageError(folder.string() + " is not empty: give another --out or --force");
    fs::remove_all(folder / kImageFolder, error);
    for (const char* name : kTextFiles) fs::remove(folder / name, error);
  }
  fs::create_directories(folder / kImageFolder, error);
  if (error)
    throw UsageError("cannot create " + (folder / kImageFolder).string() + ": " + error.message());
}

void refuse_overwriting(const SynthConfig& config) {
  OverwriteGuard guard;
  guard.reads("--poses", config.poses);
  for (const char* name : kTextFiles) guard.writes("--out", config.out / name);
  guard.check();
}

WriteResult write_drive(const Studio& studio, int num_threads, const std::atomic<bool>& stop,
                        const std::function<void(int)>& progress) {
  const int frames = studio.num_frames();
  write_calibration(studio.config().out, studio.config());
  std::vector<std::string> labels(static_cast<std::size_t>(frames));
  std::atomic<int> next{0};
  int finished = 0;
  std::exception_ptr failure;
  std::mutex mutex;
  CodecQueue codec(studio.config());
  const auto work = [&] {
    Worker worker(studio, codec);
    while (!stop) {
      const int frame = next++;
      if (frame >= frames) return;
      try {
        labels[static_cast<std::size_t>(frame)] = worker.write(frame);
      } catch (...) {
        codec.abandon();
        const std::lock_guard lock(mutex);
        failure = std::current_exception();
        next = frames;
        return;
      }
      const std::lock_guard lock(mutex);
      progress(++finished);
    }
  };
  const auto begin = std::chrono::steady_clock::now();
  std::vector<std::thread> threads;
  for (int i = 0; i < num_threads; ++i) threads.emplace_back(work);
  for (std::thread& thread : threads) thread.join();
  if (failure) std::rethrow_exception(failure);
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  write_truth(studio, finished, labels);
  return {finished, seconds};
}

}  // namespace plumb::synth
