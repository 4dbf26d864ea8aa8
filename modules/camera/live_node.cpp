#include "modules/camera/live_node.hpp"

#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "platform/clock.hpp"
#include "platform/log.hpp"

namespace plumb {
namespace {

std::int64_t to_us(double seconds) { return std::llround(seconds * 1e6); }

}  // namespace

LiveNode::LiveNode(Process& process, DeviceSource& source, PublishNode& output,
                   const CameraConfig& config)
    : process_(process),
      source_(source),
      output_(output),
      exits_on_loss_(config.on_loss == "exit"),
      timeout_us_(to_us(config.timeout_s)),
      back_off_(to_us(config.retry_min_s), to_us(config.retry_max_s)),
      exit_timer_(process.loop().timer([this] { on_exit(); })),
      alive_us_(monotonic_us()) {
  process_.loop().watch(source_.fileno(), [this] { on_ready(); });
  process_.loop().every(kTick_us, [this] { on_tick(); });
  process_.health().set_condition(HealthState::kWaiting, "no frame yet");
}

void LiveNode::on_ready() {
  if (!source_.is_open()) return;
  Counters& counters = process_.counters();
  GreyFrame frame;
  process_.timer().begin();
  const DeviceStep step = source_.take(&frame);
  if (step == DeviceStep::kNothing) return;
  if (step == DeviceStep::kLost) return on_loss();
  alive_us_ = monotonic_us();
  ++counters.num_received;
  counters.num_dropped = source_.num_missing();
  if (step == DeviceStep::kRejected) return counters.reject(source_.rejection());
  back_off_.reset();
  process_.timer().mark("take");
  output_.publish(frame);
  process_.timer().end();
  source_.release();
  if (alive_us_ >= shown_until_us_) output_.show_fault();
}

void LiveNode::on_tick() {
  const std::int64_t now_us = monotonic_us();
  if (source_.is_open()) return check_silence(now_us);
  if (!exits_on_loss_ && now_us >= retry_us_) try_again();
}

void LiveNode::check_silence(std::int64_t now_us) {
  const std::int64_t silent_us = now_us - alive_us_;
  if (silent_us <= timeout_us_) return;
  char sentence[96];
  std::snprintf(sentence, sizeof sentence, "no frame from the camera for %.1f s",
                static_cast<double>(silent_us) * 1e-6);
  process_.health().set_condition(HealthState::kDegraded, sentence, Health::Output::kExcused);
  if (silent_us <= 3 * timeout_us_) return;
  source_.give_up(sentence);
  on_loss();
}

void LiveNode::on_loss() {
  log_warning("%s", source_.why().c_str());
  const std::int64_t now_us = monotonic_us();
  if (exits_on_loss_) {
    process_.health().set_condition(HealthState::kDegraded, source_.why().c_str(),
                                    Health::Output::kExcused);
    process_.loop().arm_at(exit_timer_, now_us + Process::kHealthPeriod_us + kTick_us);
    return;
  }
  text_ = source_.why() + "; opening it again";
  process_.health().set_condition(HealthState::kDegraded, text_.c_str(), Health::Output::kExcused);
  shown_until_us_ = now_us + kLossShown_us;
  retry_us_ = now_us + back_off_.next_us();
}

void LiveNode::on_exit() const { throw std::runtime_error(source_.why()); }

void LiveNode::try_again() {
  if (!source_.reopen()) return on_loss();
  alive_us_ = monotonic_us();
}

}  // namespace plumb
