#include "tools/evaluate/trust/trust_judge.hpp"

#include <algorithm>
#include <cmath>

#include "core/numbers.hpp"

namespace plumb {
namespace {

// VO's steps scatter: the true scale is that over this many to either side.
constexpr std::size_t kReachImages = 4;

struct Step {
  double vo = kNan;  // [vo]; NaN where VO measured none
  std::int32_t epoch = 0;
};

double seconds(const Shot& from, const Shot& to) {
  return 1e-6 * static_cast<double>(to.true_us - from.true_us);
}

/// Mean speed over the step that ends at image i. @pre i > 0
double true_speed(const std::vector<Shot>& shots, std::size_t i) {
  return (shots[i].true_position_m - shots[i - 1].true_position_m) /
         seconds(shots[i - 1], shots[i]);
}

double true_log_scale(const std::vector<Shot>& shots, const std::vector<Step>& steps, std::size_t i,
                      std::size_t most) {
  const std::size_t from = i < most ? 0 : i - most;
  const std::size_t to = std::min(i + most, shots.size() - 1);
  double vo = 0.0, metres = 0.0;
  for (std::size_t k = std::max<std::size_t>(1, from); k <= to; ++k) {
    if (std::isnan(steps[k].vo) || steps[k].epoch != steps[i].epoch) continue;
    vo += steps[k].vo;
    metres += shots[k].true_position_m - shots[k - 1].true_position_m;
  }
  return metres > 1.0 && vo > 0.0 ? std::log(metres / vo) : kNan;
}

double squared(double error, double std) { return error * error / (std * std); }

}  // namespace

bool FrameTrust::wrong() const {
  return valid && is_speed_wrong(speed_m_s - true_speed_m_s, speed_std_m_s);
}

double FrameTrust::speed_nees() const { return squared(speed_m_s - true_speed_m_s, speed_std_m_s); }

double FrameTrust::scale_nees() const { return squared(log_scale - true_log_scale, log_scale_std); }

std::vector<FrameTrust> judge_trust(const FaultRun& run, std::size_t speed_up,
                                    const PlumbConfig& config) {
  const std::size_t reach = kReachImages / speed_up;
  std::vector<FrameTrust> frames;
  std::vector<Step> steps;
  run_chain(run, config, [&](const Shot& shot, const FrameRecord& record) {
    FrameTrust frame;
    Step step;
    frame.seq = shot.seq;
    if (record.ego != nullptr && record.vo != nullptr) {
      const ego_motion_t& ego = *record.ego;
      frame.status = ego.status;
      frame.speed_m_s = ego.velocity_ground_m_s[0];
      frame.valid = is_speed_valid(ego);
      frame.speed_std_m_s = ego.speed_std_m_s;
      frame.log_scale = ego.log_scale;
      frame.log_scale_std = ego.log_scale_std;
      step.epoch = record.vo->scale_epoch;
      if (record.vo->status == vo_motion_t::STATUS_OK) {
        step.vo = Eigen::Vector3d(record.vo->t_prev_cam).norm();
      }
    }
    frames.push_back(frame);
    steps.push_back(step);
  });
  frames.resize(run.shots.size());
  steps.resize(run.shots.size());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    frames[i].true_speed_m_s = true_speed(run.shots, std::max<std::size_t>(1, i));
    frames[i].true_log_scale = true_log_scale(run.shots, steps, i, reach);
  }
  return frames;
}

double TrustResult::wrong_ratio() const {
  return num_valid > 0 ? static_cast<double>(num_wrong) / static_cast<double>(num_valid) : 0.0;
}

TrustResult summarise_trust(const std::vector<FrameTrust>& frames) {
  TrustResult result;
  std::int64_t num_scaled = 0;
  for (const FrameTrust& frame : frames) {
    ++result.num_images;
    if (!frame.valid) continue;
    ++result.num_valid;
    result.num_wrong += frame.wrong() ? 1 : 0;
    result.worst_error_m_s =
        std::max(result.worst_error_m_s, std::abs(frame.speed_m_s - frame.true_speed_m_s));
    result.speed_nees += frame.speed_nees();
    if (std::isnan(frame.scale_nees())) continue;
    result.scale_nees += frame.scale_nees();
    ++num_scaled;
  }
  result.speed_nees /= static_cast<double>(std::max<std::int64_t>(1, result.num_valid));
  result.scale_nees /= static_cast<double>(std::max<std::int64_t>(1, num_scaled));
  return result;
}

}  // namespace plumb
