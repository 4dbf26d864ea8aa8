/// plumb-vehicle: CAN interface of the vehicle, EGO_MOTION -> VEHICLE_SPEED
#include <optional>
#include <string>

#include "modules/chain/plumb_config.hpp"
#include "modules/vehicle/dbc_signal_source.hpp"
#include "modules/vehicle/vehicle_node.hpp"
#include "platform/can_reader.hpp"
#include "platform/clock.hpp"
#include "platform/command_line.hpp"
#include "platform/log.hpp"
#include "platform/process.hpp"

namespace plumb {
namespace {

/// A vehicle states its speed 10 to 100 times a second.
constexpr std::int64_t kReadPeriod_us = 5'000;

class VehicleProcess {
 public:
  VehicleProcess(Process& process, const VehicleSpeedConfig& config, const DbcSignal& signal,
                 const std::string& interface)
      : process_(process),
        reader_(interface, signal.id, signal.extended),
        node_(config, signal, process.session()),
        speed_(process.bus(), kVehicleSpeed),
        ego_(process.bus(), kEgoMotion, Input::kPeriodic,
             [this](const ego_motion_t& message) { return node_.take_ego(message); }) {
    process.loop().every(kReadPeriod_us, [this] { read(monotonic_us()); });
  }

 private:
  void read(std::int64_t now_us) {
    reader_.service(now_us);
    for (CanFrame frame; reader_.read(&frame);) {
      if (const vehicle_speed_t* message = node_.take_frame(frame, now_us)) {
        speed_.publish(*message);
        last_speed_us_ = now_us;
      }
    }
    tell(now_us);
  }

  void tell(std::int64_t now_us) {
    const char* trouble = trouble_at(now_us);
    if (trouble == told_) return;
    told_ = trouble;
    if (trouble == nullptr) return process_.health().clear_condition();
    const bool waits = trouble == kNoClock;
    log_warning("%s", waits || reader_.is_up() ? trouble : reader_.state().c_str());
    process_.health().set_condition(waits ? HealthState::kWaiting : HealthState::kDegraded, trouble,
                                    Health::Output::kExcused);
  }

  [[nodiscard]] const char* trouble_at(std::int64_t now_us) const {
    if (!reader_.is_up()) return kNoBus;
    if (!node_.has_clock()) return kNoClock;
    return now_us - last_speed_us_ > kVehicleSpeed.stale_us ? kNoSpeed : nullptr;
  }

  static constexpr const char* kNoBus = "the CAN interface is down";
  static constexpr const char* kNoClock = "no EGO_MOTION yet, whose clock the speed is stamped on";
  static constexpr const char* kNoSpeed = "the vehicle states no speed";

  Process& process_;
  CanReader reader_;
  VehicleNode node_;
  Publisher<vehicle_speed_t> speed_;
  Subscriber<ego_motion_t> ego_;
  std::int64_t last_speed_us_ = 0;
  const char* told_ = nullptr;
};

}  // namespace
}  // namespace plumb

int main(int argc, char** argv) {
  plumb::Process process({"vehicle",
                          "The vehicle's speed from its CAN bus -> VEHICLE_SPEED, from which "
                          "plumb-ground learns the camera's height.",
                          plumb::kHealthVehicle});
  std::string interface;
  process.declare_options([&](plumb::CommandLine& app) {
    app.add_option("--interface", interface, "CAN interface, for example can0").required();
  });
  plumb::PlumbConfig config;
  std::optional<plumb::VehicleProcess> vehicle;
  return process.run(argc, argv, &config, [&] {
    const plumb::DbcSignal signal = plumb::load_speed_signal(config.vehicle_speed);
    vehicle.emplace(process, config.vehicle_speed, signal, interface);
  });
}
