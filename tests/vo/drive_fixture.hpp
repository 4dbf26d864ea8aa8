/// Runs a VisualOdometry on rendered images and keeps its results.
#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "modules/vo/vo.hpp"
#include "tests/support/scene.hpp"

namespace plumb::test {

/// The parts of VoOutput that tests compare after a drive.
struct Result {
  VoStatus status;
  VoReason reason;
  std::int32_t scale_epoch;
  double scale_carry_std;
  std::int64_t prev_seq;
  Se3 T_prev_cam;
  Matrix6d cov;
  int num_new;
};

class Drive {
 public:
  explicit Drive(const CameraModel& camera = scene_camera(), std::uint64_t seed = 1)
      : scene_(camera), odometry_(config(), camera, seed) {}

  static VoConfig config() {
    VoConfig c;
    c.max_tracks = 300;
    return c;
  }

  const VoOutput& see(const Se3& T_world_cam, double noise_std_grey = 1.0) {
    const RenderedImage image = scene_.render(T_world_cam, noise_std_grey, ++noise_seed_);
    return show(image);
  }
  const VoOutput& show(const RenderedImage& image, VoReason unusable = VoReason::kNone) {
    VoInput input;
    input.capture_us = 1'000'000 + 100'000 * next_;
    input.seq = next_;
    input.image = image.view();
    input.interval_s = 0.1 * static_cast<double>(next_ - last_shown_);
    input.unusable = unusable;
    last_shown_ = next_;
    ++next_;
    return show(input);
  }
  const VoOutput& show(const VoInput& input) {
    last_ = &odometry_.update(input, probe_);
    results_.push_back({last_->status, last_->reason, last_->scale_epoch, last_->scale_carry_std,
                        last_->prev_seq, last_->T_prev_cam, last_->cov_prev_cam, last_->num_new});
    return *last_;
  }
  void skip(int frames) { next_ += frames; }

  [[nodiscard]] const VoOutput& last() const { return *last_; }
  [[nodiscard]] const std::vector<Result>& results() const { return results_; }
  [[nodiscard]] const Scene& scene() const { return scene_; }
  [[nodiscard]] std::int64_t next_seq() const { return next_; }

 private:
  Scene scene_;
  VisualOdometry odometry_;
  NullProbe probe_;
  unsigned noise_seed_ = 100;
  std::int64_t next_ = 0;
  std::int64_t last_shown_ = -1;
  const VoOutput* last_ = nullptr;
  std::vector<Result> results_;
};

/// Returns the mean length of the translations in results [from, to), in [vo].
inline double mean_step(const Drive& drive, std::size_t from, std::size_t to) {
  double sum = 0.0;
  for (std::size_t i = from; i < to; ++i) sum += drive.results()[i].T_prev_cam.t.norm();
  return sum / static_cast<double>(to - from);
}

}  // namespace plumb::test
