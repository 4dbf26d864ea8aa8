#include "tools/evaluate/faults/fault_judge.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "core/channels.hpp"
#include "modules/camera/image_wire.hpp"
#include "modules/datasets/text.hpp"
#include "tools/run/replay/names.hpp"

namespace plumb {
namespace {

constexpr double kLeastError_m_s = 0.3;
constexpr std::int64_t kCalibrationPeriod = 10;  // images

/// What the chain said of one image.
struct Verdict {
  double true_s = 0.0;
  bool faulty = false;
  bool valid = false;
  bool wrong = false;
  double error_m_s = 0.0;
};

Verdict judge(const Shot& shot, const ego_motion_t& ego) {
  Verdict verdict{1e-6 * static_cast<double>(shot.true_us), shot.faulty, is_speed_valid(ego)};
  if (!verdict.valid) return verdict;
  verdict.error_m_s = std::abs(ego.velocity_ground_m_s[0] - shot.true_speed_m_s);
  verdict.wrong = is_speed_wrong(verdict.error_m_s, ego.speed_std_m_s);
  return verdict;
}

template <typename Message>
std::vector<std::uint8_t> encoded(const Message& message) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

/// Time from the first faulty image to the last wrong result that a faulty image brought.
double time_to_detect(const std::vector<Verdict>& verdicts) {
  std::optional<double> began;
  double detect_s = 0.0;
  for (const Verdict& verdict : verdicts) {
    if (verdict.faulty && !began) began = verdict.true_s;
    if (began && verdict.faulty && verdict.wrong) detect_s = verdict.true_s - *began;
  }
  return detect_s;
}

/// Time from the last faulty image until results are valid and right for the rest of the drive, a
/// hundredth of them aside.
double time_to_recover(const std::vector<Verdict>& verdicts) {
  const auto last = std::find_if(verdicts.rbegin(), verdicts.rend(),
                                 [](const Verdict& verdict) { return verdict.faulty; });
  if (last == verdicts.rend() || last == verdicts.rbegin()) return 0.0;
  for (auto it = last.base(); it != verdicts.end(); ++it) {
    const auto good = [](const Verdict& verdict) { return verdict.valid && !verdict.wrong; };
    const auto num_good = std::count_if(it, verdicts.end(), good);
    if (good(*it) && 100 * num_good >= 99 * (verdicts.end() - it)) return it->true_s - last->true_s;
  }
  return -1.0;
}

FaultResult summarise(const std::vector<Verdict>& verdicts, std::int64_t num_images,
                      std::string last_reason) {
  FaultResult result;
  result.num_images = num_images;
  result.num_results = static_cast<std::int64_t>(verdicts.size());
  for (const Verdict& verdict : verdicts) {
    if (!verdict.valid) continue;
    ++result.num_valid;
    if (verdict.wrong) ++result.num_wrong;
    result.worst_error_m_s = std::max(result.worst_error_m_s, verdict.error_m_s);
  }
  result.detect_s = time_to_detect(verdicts);
  result.recover_s = time_to_recover(verdicts);
  result.last_reason = std::move(last_reason);
  return result;
}

}  // namespace

bool is_speed_valid(const ego_motion_t& ego) {
  return ego.status != ego_motion_t::STATUS_INITIALIZING &&
         ego.status != ego_motion_t::STATUS_LOST && !std::isnan(ego.velocity_ground_m_s[0]);
}

bool is_speed_wrong(double error_m_s, double std_m_s) {
  return !(std::abs(error_m_s) <= std::max(3.0 * std_m_s, kLeastError_m_s));
}

double FaultResult::wrong_ratio() const {
  return num_valid > 0 ? static_cast<double>(num_wrong) / static_cast<double>(num_valid) : 0.0;
}

void FaultResult::add(const FaultResult& other) {
  num_images += other.num_images;
  num_results += other.num_results;
  num_valid += other.num_valid;
  num_wrong += other.num_wrong;
  worst_error_m_s = std::max(worst_error_m_s, other.worst_error_m_s);
  detect_s = std::max(detect_s, other.detect_s);
  const bool never = recover_s < 0.0 || other.recover_s < 0.0;
  recover_s = never ? -1.0 : std::max(recover_s, other.recover_s);
  if (!other.last_reason.empty()) last_reason = other.last_reason;
}

void run_chain(const FaultRun& run, const PlumbConfig& config, const ShotSink& sink) {
  const Shot* shot = nullptr;
  Chain chain(config, 1, nullptr, [&](const FrameRecord& record) { sink(*shot, record); });
  std::int64_t count = 0;
  for (const Shot& next : run.shots) {
    shot = &next;
    if (count++ % kCalibrationPeriod == 0) {
      const auto bytes = encoded(to_wire(run.camera, next.stamp_us));
      chain.take({0, next.true_us, kCameraCalibration.name, bytes});
    }
    image_t message;
    to_wire(next.stamp_us, next.seq,
            ImageView{next.pixels->data(), run.camera.width_px, run.camera.height_px,
                      run.camera.width_px},
            &message);
    const auto bytes = encoded(message);
    chain.take({0, next.true_us, kCamera.name, bytes});
  }
  chain.finish();
}

FaultResult run_fault(const FaultRun& run, const PlumbConfig& config) {
  std::vector<Verdict> verdicts;
  std::string last_reason;
  run_chain(run, config, [&](const Shot& shot, const FrameRecord& record) {
    if (record.refused != nullptr) last_reason = record.refused;
    if (record.ego == nullptr) return;
    verdicts.push_back(judge(shot, *record.ego));
    if (!verdicts.back().valid) last_reason = vo_reason_name(record.ego->reason);
  });
  return summarise(verdicts, static_cast<std::int64_t>(run.shots.size()), std::move(last_reason));
}

std::string fault_table_head() {
  return "| kind | fault | drive | what is injected | valid | wrong while valid | worst error | "
         "time to detect | "
         "time to recover | reason |\n|---|---|---|---|---|---|---|---|---|---|\n";
}

std::string fault_table_row(const Fault& fault, const std::string& drive,
                            const FaultResult& result) {
  const std::string recover = result.recover_s < 0.0 ? "never" : format("%.1f s", result.recover_s);
  return format(
      "| %c | %s | %s | %s | %lld of %lld | %lld (%.1f %%) | %.1f m/s | %.1f s | %s | %s |\n",
      fault.kind, fault.name.c_str(), drive.c_str(), fault.injected.c_str(),
      static_cast<long long>(result.num_valid), static_cast<long long>(result.num_images),
      static_cast<long long>(result.num_wrong), 100.0 * result.wrong_ratio(),
      result.worst_error_m_s, result.detect_s, recover.c_str(), result.last_reason.c_str());
}

}  // namespace plumb
