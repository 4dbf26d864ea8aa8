/// GROUND_PLANE, EGO_MOTION, MOUNT, OBJECTS -> can -> CAN interface, trace file
#include <CLI/CLI.hpp>
#include <optional>
#include <stdexcept>
#include <string>

#include "modules/can/can_dbc.hpp"
#include "modules/can/can_wire.hpp"
#include "modules/chain/plumb_config.hpp"
#include "platform/can_trace.hpp"
#include "platform/clock.hpp"
#include "platform/log.hpp"
#include "platform/overwrite_guard.hpp"
#include "platform/process.hpp"
#include "platform/socket_can.hpp"

namespace plumb {
namespace {

constexpr std::int64_t kFlushUs = 500'000;

/// The bus and the file, either of which may be missing.
struct Sinks final : CanSink {
  std::optional<SocketCan> bus;
  std::optional<CanTraceWriter> trace;
  const std::string no_trouble;

  void open(const std::string& interface, const std::string& path) {
    if (!interface.empty()) bus.emplace(interface);
    if (path.empty()) return;
    trace.emplace(path, interface.empty() ? "can0" : interface);
    if (!trace->error().empty()) throw UsageError(trace->error());
    trace->set_time_offset_us(realtime_us() - monotonic_us());
  }
  void send(std::int64_t time_us, const CanFrame& frame) override {
    if (bus) bus->send(time_us, frame);
    if (trace) trace->send(time_us, frame);
  }
  [[nodiscard]] std::int64_t num_sent() const {
    return bus ? bus->counters().num_sent : trace->num_frames();
  }
  [[nodiscard]] std::int64_t num_unsent() const { return bus ? bus->counters().num_unsent : 0; }
  [[nodiscard]] const std::string& trouble() const {
    if (trace && !trace->error().empty()) return trace->error();
    return bus ? bus->state() : no_trouble;
  }
};

class CanProcess {
 public:
  CanProcess(Process& process, const PlumbConfig& config, Sinks& sinks)
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
    process.loop().every(CanGate::kTickUs, [this] { tick(monotonic_us()); });
    if (sinks.trace) process.loop().every(kFlushUs, [this] { sinks_.trace->flush(); });
  }

 private:
  void tick(std::int64_t now_us) {
    Counters& counters = process_.counters();
    if (last_tick_us_ != 0 && now_us - last_tick_us_ > 2 * CanGate::kTickUs) ++counters.num_late;
    last_tick_us_ = now_us;
    if (sinks_.bus) sinks_.bus->service(now_us);
    output_.report(counters.num_rejected - output_.num_rejected(), sinks_.num_unsent());
    output_.tick(now_us, sinks_);
    counters.num_published = sinks_.num_sent();
    counters.num_unsent = sinks_.num_unsent();
    counters.num_dropped = output_.counters().num_missed + output_.counters().num_overflowed +
                           output_.num_objects_overflowed();
    if (sinks_.trouble() != told_) tell(sinks_.trouble());
  }

  void tell(const std::string& trouble) {
    told_ = trouble;
    log_line("%s", trouble.empty() ? "the CAN interface is up" : trouble.c_str());
    if (trouble.empty()) return process_.health().clear_condition();
    process_.health().set_condition(HealthState::kDegraded, trouble.c_str());
    if (!sinks_.bus) throw std::runtime_error("nowhere left to write CAN frames to");
  }

  Process& process_;
  Sinks& sinks_;
  CanOutput output_;
  Subscriber<ground_plane_t> plane_;
  Subscriber<ego_motion_t> ego_;
  Subscriber<mount_t> mount_;
  Subscriber<objects_t> objects_;
  std::int64_t last_tick_us_ = 0;
  std::string told_;
};

}  // namespace
}  // namespace plumb

int main(int argc, char** argv) {
  plumb::Process process(
      {"can", "Ego motion, ground plane, mount and objects onto a CAN bus, as plumbline.dbc says.",
       plumb::kHealthCan});
  std::string interface, path;
  process.declare_options([&](CLI::App& app) {
    app.add_option("--interface", interface, "CAN interface, for example can0");
    app.add_option("--trace", path, "file for every frame, as candump -L writes it");
  });

  plumb::PlumbConfig config;
  process.declare_print("--print-dbc", "print the CAN database of the configuration, then exit",
                        [&] { return render_dbc(config.can, can_messages(config.can)); });
  plumb::Sinks sinks;
  std::optional<plumb::CanProcess> can;
  const int code = process.run(argc, argv, &config, [&] {
    if (interface.empty() && path.empty())
      throw plumb::UsageError("give --interface, --trace or both");
    plumb::OverwriteGuard()
        .reads("--config", process.config_path())
        .writes("--trace", path)
        .check();
    (void)can_addresses(config.can);  // refused before the trace file is created
    sinks.open(interface, path);
    can.emplace(process, config, sinks);
  });
  if (sinks.trace && !sinks.trace->flush() && code == 0) {
    plumb::log_line("%s", sinks.trace->error().c_str());
    return 1;
  }
  return code;
}
