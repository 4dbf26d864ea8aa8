#include "tools/learn/calibrate/mount.hpp"

#include <cmath>
#include <optional>

#include "modules/chain/model_file_source.hpp"
#include "modules/ground/ground.hpp"
#include "modules/vo/vo.hpp"
#include "tools/learn/calibrate/lens_fit.hpp"
#include "tools/learn/train/truth_track.hpp"
#include "tools/support/statistics.hpp"
#include "tools/support/stop_flag.hpp"

namespace plumb {
namespace {

// Neighbouring frames share their error, so this many of them count as one.
constexpr double kFramesPerSight = 10.0;
constexpr int kFewestFrames = 50;
constexpr double kStraight_rad = 0.003;  // turned per image
constexpr double kLeastStepRatio = 0.2;  // in camera heights
constexpr std::size_t kBlockFrames = 20;

/// Results of the chain in the frames from which the mount is found.
struct Sights {
  std::vector<double> pitch_rad, roll_rad, yaw_rad;
  std::vector<double> ln_length_ratios;  ///< true over estimated length of blocks of frames
};

class LengthBlock {
 public:
  void add(double true_m, double estimated_m, std::vector<double>* ratios) {
    true_m_ += true_m;
    estimated_m_ += estimated_m;
    if (++num_ < kBlockFrames) return;
    if (true_m_ > 1.0 && estimated_m_ > 0.0) ratios->push_back(std::log(true_m_ / estimated_m_));
    *this = LengthBlock{};
  }

 private:
  std::size_t num_ = 0;
  double true_m_ = 0.0;
  double estimated_m_ = 0.0;
};

void run_drive(const RecordedDrive& drive, const CameraModel& camera, const PlumbConfig& config,
               std::uint64_t seed, Sights* sights) {
  VisualOdometry vo(config.vo, camera, seed);
  GroundEstimator ground(config.ground, camera, load_models(config.ground.model_file).ground);
  std::optional<TruthTrack> truth;
  if (drive.has_true_poses) truth.emplace(drive.log, "");
  NullProbe probe;
  LengthBlock block;
  for (std::size_t i = 0; i < drive.images.size(); ++i) {
    if (stop_requested()) throw Stopped();
    const RecordedImage& image = drive.images[i];
    const VoOutput& motion = vo.update({image.capture_us, image.seq, drive.view(i)}, probe);
    const GroundOutput& out = ground.update({&motion, drive.view(i)}, probe);
    const bool measured = motion.status == VoStatus::kOk && out.plane.status == GroundStatus::kOk;
    if (!measured) continue;
    sights->pitch_rad.push_back(out.plane.pitch_rad);
    sights->roll_rad.push_back(out.plane.roll_rad);
    const Eigen::Vector3d& t = out.ego.T_prev_cam.t;
    const bool straight = log_so3(motion.T_prev_cam.R).norm() < kStraight_rad;
    if (straight && t.norm() > kLeastStepRatio * out.plane.height_m)
      sights->yaw_rad.push_back(std::atan2(t.x(), t.z()));
    if (!truth) continue;
    if (const auto step = truth->motion(motion.prev_seq, motion.seq))
      block.add(step->t.norm(), t.norm(), &sights->ln_length_ratios);
  }
}

MountValue median_of(const std::vector<double>& values, const char* what) {
  MountValue m;
  m.num_frames = static_cast<int>(values.size());
  if (m.num_frames < kFewestFrames) {
    m.missing = std::to_string(m.num_frames) + " " + what + ", " + std::to_string(kFewestFrames) +
                " are needed";
    return m;
  }
  m.value = median(values);
  // A median of normally distributed values has 1.25 times the standard error of their mean.
  m.std =
      1.25 * robust_std(values) / std::sqrt(static_cast<double>(values.size()) / kFramesPerSight);
  return m;
}

MountValue height_of(const std::vector<double>& ln_ratios, double nominal_m) {
  MountValue m;
  m.num_frames = static_cast<int>(ln_ratios.size() * kBlockFrames);
  if (ln_ratios.size() < 3) {
    m.missing = "no metric reference: true poses of at least 60 measured frames";
    return m;
  }
  m.value = nominal_m * std::exp(median(ln_ratios));
  m.std = 1.25 * m.value * robust_std(ln_ratios) / std::sqrt(static_cast<double>(ln_ratios.size()));
  return m;
}

}  // namespace

Mount find_mount(const std::vector<RecordedDrive>& drives, const CameraModel& camera,
                 const PlumbConfig& config, std::uint64_t seed) {
  Sights sights;
  for (const RecordedDrive& drive : drives) run_drive(drive, camera, config, seed, &sights);
  const double nominal_m = camera_height_of(config.ground, camera).height_m;
  return {median_of(sights.pitch_rad, "frames with a measured road"),
          median_of(sights.roll_rad, "frames with a measured road"),
          median_of(sights.yaw_rad, "straight frames"),
          height_of(sights.ln_length_ratios, nominal_m)};
}

}  // namespace plumb
