#include "tools/kitti/log_trial.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <optional>
#include <random>
#include <set>
#include <vector>

#include "core/channels.hpp"
#include "core/input_error.hpp"
#include "modules/camera/image_wire.hpp"
#include "modules/datasets/kitti/pose_file.hpp"
#include "modules/datasets/text.hpp"
#include "platform/bounded_decode.hpp"
#include "platform/log_file.hpp"
#include "plumb/ground_truth_t.hpp"

namespace plumb {
namespace {

/// Standard normal numbers by Box and Muller's method: the same on every machine, unlike the
/// standard library's.
class NormalNumbers {
 public:
  explicit NormalNumbers(std::uint64_t seed) : random_(seed) {}

  double next() {
    has_second_ = !has_second_;
    if (!has_second_) return second_;
    constexpr double kUnit = 0x1p-53;
    const double u = static_cast<double>((random_() >> 11U) + 1U) * kUnit;
    const double angle_rad = 2.0 * M_PI * static_cast<double>(random_() >> 11U) * kUnit;
    const double radius = std::sqrt(-2.0 * std::log(u));
    second_ = radius * std::sin(angle_rad);
    return radius * std::cos(angle_rad);
  }

 private:
  std::mt19937_64 random_;
  double second_ = 0.0;
  bool has_second_ = false;
};

class Trial {
 public:
  explicit Trial(const TrialOptions& options) : options_(options), normal_(options.seed) {
    if (!options.out.empty()) log_.emplace(options.out);
  }

  /// Finds which images stay. Every message of an image bears its time in the log.
  void choose_images() {
    std::mt19937_64 random(options_.seed + 1);
    std::set<std::int64_t> seen;
    LogReader reader(options_.log);
    int num_images = 0;
    for (LogEvent event; reader.next(&event);) {
      if (event.channel != kCamera.name) continue;
      const double chance = static_cast<double>(random() >> 11U) * 0x1p-53;
      const bool kept = num_images++ >= options_.skip && chance >= options_.drop;
      if (kept) kept_us_.insert(event.log_us);
    }
    if (reader.num_problems() > 0) throw InputError(reader.problems().front());
    if (num_images == 0) throw InputError(options_.log + " holds no image on CAMERA");
    if (kept_us_.empty()) throw InputError("--skip leaves no image of " + options_.log);
  }

  void take(const LogEvent& event) {
    const bool calibration = event.channel == kCameraCalibration.name;
    if (!calibration && kept_us_.count(event.log_us) == 0) return;
    if (event.channel == kGroundTruth.name) take_truth(event);
    if (event.channel == kCamera.name) {
      seqs_.push_back(seq_of(event));
      if (log_ && options_.noise > 0.0) return write_noisy(event);
    }
    if (log_) log_->write(event.log_us, event.channel, event.data);
    if (calibration) take_calibration(event);
  }

  TrialResult finish() {
    if (log_) log_->close();
    TrialResult result;
    result.num_images = static_cast<std::int64_t>(seqs_.size());
    result.num_poses = static_cast<std::int64_t>(pose_rows_.size());
    result.num_planes = static_cast<std::int64_t>(plane_rows_.size());
    if (!options_.poses.empty() && result.num_poses == result.num_images)
      write_rows("", pose_rows_, options_.poses);
    if (!options_.planes.empty() && result.num_planes > 0)
      write_rows("# frame nx ny nz height_m\n", plane_rows_, options_.planes);
    return result;
  }

 private:
  [[nodiscard]] ImageFrame frame_of(const LogEvent& event) const {
    ImageFrame frame;
    if (const char* why = read_image(event.data, &frame))
      throw InputError(options_.log + ": " + why);
    return frame;
  }
  [[nodiscard]] std::int64_t seq_of(const LogEvent& event) const { return frame_of(event).seq; }

  void take_calibration(const LogEvent& event) {
    camera_calibration_t message;
    CameraModel camera;
    if (decoder_) return;
    const char* why = decode_bounded(event.data, &message) ? from_wire(message, &camera)
                                                           : "a message cannot be decoded";
    if (why != nullptr) throw InputError(options_.log + ": " + why);
    decoder_.emplace(camera.width_px, camera.height_px);
  }

  void take_truth(const LogEvent& event) {
    ground_truth_t truth;
    if (!decode_bounded(event.data, &truth)) throw InputError(options_.log + ": bad GROUND_TRUTH");
    if (truth.has_pose != 0) {
      PoseMatrix T = PoseMatrix::Identity();
      const double* q = truth.q_world_cam;
      T.topLeftCorner<3, 3>() = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
      T.topRightCorner<3, 1>() = Eigen::Vector3d(truth.t_world_cam_m);
      pose_rows_.push_back(pose_row(T));
    }
    if (truth.has_plane == 0) return;
    plane_rows_.push_back(format("%lld %.9f %.9f %.9f %.9f", static_cast<long long>(truth.seq),
                                 truth.normal_cam[0], truth.normal_cam[1], truth.normal_cam[2],
                                 truth.height_m));
  }

  void write_noisy(const LogEvent& event) {
    const ImageFrame frame = frame_of(event);
    ImageView view;
    if (!decoder_) throw InputError(options_.log + ": an image stands before its calibration");
    const char* why = decoder_->check(frame);
    if (why == nullptr) why = decoder_->decode(frame, &view);
    if (why != nullptr) throw InputError(options_.log + ": " + why);
    pixels_.clear();
    for (int v = 0; v < view.height_px; ++v) {
      for (int u = 0; u < view.width_px; ++u) {
        const double grey = view.row(v)[u] + options_.noise * normal_.next();
        pixels_.push_back(static_cast<std::uint8_t>(std::clamp(std::round(grey), 0.0, 255.0)));
      }
    }
    to_wire(frame.capture_us, frame.seq,
            {pixels_.data(), view.width_px, view.height_px, view.width_px}, &message_,
            frame.session);
    buffer_.resize(static_cast<std::size_t>(message_.getEncodedSize()));
    message_.encode(buffer_.data(), 0, static_cast<int>(buffer_.size()));
    log_->write(event.log_us, event.channel, buffer_);
  }

  static void write_rows(const char* head, const std::vector<std::string>& rows,
                         const std::string& path) {
    std::ofstream file(path);
    file << head;
    for (const std::string& row : rows) file << row << '\n';
    file.close();
    if (!file) throw InputError("cannot write " + path);
  }

  const TrialOptions& options_;
  NormalNumbers normal_;
  std::optional<LogWriter> log_;
  std::optional<ImageDecoder> decoder_;
  std::set<std::int64_t> kept_us_;
  std::vector<std::int64_t> seqs_;
  std::vector<std::string> pose_rows_, plane_rows_;
  std::vector<std::uint8_t> pixels_, buffer_;
  image_t message_{};
};

}  // namespace

TrialResult make_trial(const TrialOptions& options) {
  Trial trial(options);
  trial.choose_images();
  LogReader reader(options.log);
  for (LogEvent event; reader.next(&event);) trial.take(event);
  return trial.finish();
}

}  // namespace plumb
