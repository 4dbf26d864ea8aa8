/// GROUND_PLANE, EGO_MOTION, MOUNT, OBJECTS -> can -> CAN interface, trace file
#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>

#include "modules/can/can_c_header.hpp"
#include "modules/can/can_dbc.hpp"
#include "modules/can/can_wire.hpp"
#include "modules/chain/plumb_config.hpp"
#include "platform/can_sinks.hpp"
#include "platform/clock.hpp"
#include "platform/command_line.hpp"
#include "platform/log.hpp"
#include "platform/overwrite_guard.hpp"
#include "platform/process.hpp"

namespace plumb {
namespace {

class CanProcess {
 public:
  CanProcess(Process& process, const PlumbConfig& config, CanSinks& sinks)
      : process_(process),
        sinks_(sinks),
        output_(config.can, config.vehicle),
        plane_(process.bus(), kGroundPlane, Input::kPeriodic,
               [this](const ground_plane_t& message) {
                 return output_.on_ground_plane(message, monotonic_us());
               }),
        ego_(process.bus(), kEgoMotion, Input::kPeriodic,
             [this](const ego_motion_t& message) {
               return output_.on_ego_motion(message, monotonic_us());
             }),
        mount_(
            process.bus(), kMount, Input::kOccasional,
            [this](const mount_t& message) { return output_.on_mount(message, monotonic_us()); }),
        objects_(process.bus(), kObjects, Input::kOccasional, [this](const objects_t& message) {
          return output_.on_objects(message, monotonic_us());
        }) {
    output_.set_session(process.session());
    process.loop().every(CanGate::kTickUs, [this] { tick(monotonic_us()); });
  }

 private:
  void tick(std::int64_t now_us) {
    if (last_tick_us_ != 0 && now_us - last_tick_us_ > 2 * CanGate::kTickUs) ++num_late_ticks_;
    last_tick_us_ = now_us;
    sinks_.service(now_us);
    output_.report(process_.counters().num_rejected - output_.num_rejected(), sinks_.num_unsent());
    output_.tick(now_us, sinks_);
    count();
    if (sinks_.trouble_changed()) tell(sinks_.trouble());
    tell_refusals();
  }

  void count() {
    Counters& counters = process_.counters();
    // A message that waited too long here is also too old, so the two counts overlap.
    const std::int64_t num_waited = counters.num_late - num_added_late_;
    num_added_late_ = std::max<std::int64_t>(output_.num_late() - num_waited, 0) + num_late_ticks_;
    counters.num_late = num_waited + num_added_late_;
    counters.num_published = sinks_.num_sent();
    counters.num_unsent = sinks_.num_unsent() + sinks_.num_dropped();
    counters.num_dropped = output_.counters().num_missed + output_.counters().num_overflowed +
                           output_.counters().num_passed + output_.num_objects_overflowed();
  }

  void tell(const char* trouble) {
    if (*trouble == '\0') {
      log_line("%s", sinks_.has_bus() ? "the CAN interface is up" : "the trace keeps up again");
      return process_.health().clear_condition();
    }
    log_warning("%s", trouble);
    process_.health().set_condition(HealthState::kDegraded, trouble, Health::Output::kExcused);
    if (sinks_.is_useless()) throw std::runtime_error("nowhere left to write CAN frames to");
  }

  void tell_refusals() {
    if (output_.num_implausible() == num_told_) return;
    num_told_ = output_.num_implausible();
    for (const PlausibilityReason why : {output_.motion_refusal(), output_.plane_refusal()}) {
      if (is_about_vehicle(why)) log_limited("a value is not sent: %s", describe(why));
    }
  }

  /// At the start and after a gap values are refused without being wrong.
  static bool is_about_vehicle(PlausibilityReason why) {
    return why == PlausibilityReason::kOutOfRange || why == PlausibilityReason::kTooFast ||
           why == PlausibilityReason::kInconsistent;
  }

  Process& process_;
  CanSinks& sinks_;
  CanOutput output_;
  Subscriber<ground_plane_t> plane_;
  Subscriber<ego_motion_t> ego_;
  Subscriber<mount_t> mount_;
  Subscriber<objects_t> objects_;
  std::int64_t last_tick_us_ = 0;
  std::int64_t num_late_ticks_ = 0;
  std::int64_t num_added_late_ = 0;  ///< part of the counter that the bus did not count
  std::int64_t num_told_ = 0;
};

}  // namespace
}  // namespace plumb

int main(int argc, char** argv) {
  plumb::Process process(
      {"can", "Ego motion, ground plane, mount and objects onto a CAN bus, as plumbline.dbc says.",
       plumb::kHealthCan, /*is_cyclic=*/true});
  std::string interface, path;
  process.declare_options([&](plumb::CommandLine& app) {
    app.add_option("--interface", interface, "CAN interface, for example can0");
    app.add_option("--trace", path,
                   "file for every frame, as candump -L writes it; it is continued");
  });

  plumb::PlumbConfig config;
  process.declare_print("--print-dbc", "print the CAN database of the configuration, then exit",
                        [&] { return render_dbc(config.can, can_messages(config.can)); });
  process.declare_print("--print-c-header", "print a C header for receivers, then exit",
                        [&] { return render_c_header(config.can, can_messages(config.can)); });
  plumb::CanSinks sinks;
  std::optional<plumb::CanProcess> can;
  const int code = process.run(argc, argv, &config, [&] {
    if (interface.empty() && path.empty())
      throw plumb::UsageError("give --interface, --trace or both");
    plumb::OverwriteGuard guard;
    for (const std::string& file : process.config_paths()) guard.reads("--config", file);
    guard.writes("--trace", path).check();
    (void)can_addresses(config.can);  // refused before the trace file is created
    const std::int64_t offset_us = plumb::realtime_us() - plumb::monotonic_us();
    const std::string& error = sinks.open(interface, path, offset_us);
    if (!error.empty()) throw plumb::UsageError(error);
    can.emplace(process, config, sinks);
  });
  if (!sinks.close() && code == 0) {
    plumb::log_error("%s", sinks.trace_error().empty() ? "the trace is not complete"
                                                       : sinks.trace_error().c_str());
    return 1;
  }
  return code;
}
