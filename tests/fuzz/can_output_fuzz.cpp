// A fuzz target for all of plumb-can between a message and the bus.
//
// The input is a list of orders: the time goes on, a good message is sent, or one of which bytes
// were changed. Every frame must be readable, and a frame that says "valid" must rest on a message
// that was young enough at that time.
#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "modules/can/can_codec.hpp"
#include "modules/can/can_time.hpp"
#include "modules/can/can_wire.hpp"
#include "platform/bounded_decode.hpp"
#include "tests/can/drive.hpp"
#include "tests/fuzz/fuzz_input.hpp"

namespace plumb {
namespace {

using fuzz::require;

const Messages& sent_messages() {
  static const Messages kMessages = can_messages(CanConfig{});
  return kMessages;
}

/// Reads every frame and holds it against what was received.
class JudgingSink final : public CanSink {
 public:
  void received(std::int64_t capture_us) { newest_us_.push_back(capture_us); }

  void send(std::int64_t time_us, const CanFrame& frame) override {
    const auto message =
        std::find_if(sent_messages().begin(), sent_messages().end(),
                     [&frame](const Message& m) { return m.address.id == frame.id; });
    require(message != sent_messages().end());
    MessageValues values;
    require(decode(*message, frame, &values));
    for (std::size_t i = 0; i < message->signals.size(); ++i)
      judge(*message, message->signals[i], values[i], time_us);
  }

 private:
  void judge(const Message& message, const Signal& signal, double value,
             std::int64_t time_us) const {
    if (std::isnan(value)) return;
    require(value >= min_physical(signal.layout) && value <= max_physical(signal.layout) + 1e-9);
    const bool is_of_image = message.row->trigger == CanTrigger::kCameraFrame ||
                             std::string_view(message.row->name).starts_with("EgoMotion") ||
                             std::string_view(message.row->name).starts_with("GroundPlane");
    if (!is_of_image || signal.value.need != Need::kIsValidity || value < 1.0) return;
    const auto stale_us = static_cast<std::int64_t>(CanConfig{}.stale_s * 1e6);
    require(std::any_of(newest_us_.begin(), newest_us_.end(), [&](std::int64_t capture_us) {
      return capture_us != 0 && capture_us - time_us <= kMaxAheadUs &&
             time_us - capture_us <= stale_us;
    }));
  }

  std::vector<std::int64_t> newest_us_;
};

class DriveOfOrders {
 public:
  DriveOfOrders() { output_.set_session(1); }

  void run(fuzz::Orders orders) {
    for (int n = 0; n < kMaxOrders && !orders.is_empty(); ++n) {
      const std::uint8_t order = orders.byte();
      if ((order & 0x80U) != 0) next_image();
      switch (order & 7U) {
        case 0:
          go_on(orders.byte() % 32);
          break;
        case 1:
          take(drive_.plane(), &orders);
          break;
        case 2:
          take(drive_.ego(), &orders);
          break;
        case 3:
          take(mount(), &orders);
          break;
        case 4:
          take(objects(order >> 3U & 15U), &orders);
          break;
        case 5:
          now_us_ += static_cast<std::int64_t>(orders.byte()) * 10'000;
          break;
        case 6:
          drive_.speed_m_s = orders.byte();
          break;
        default:
          drive_.session = orders.byte();
          break;
      }
    }
    go_on(10);
  }

 private:
  static constexpr int kMaxOrders = 200;
  static constexpr std::int64_t kProcessing_us = 30'000;

  void next_image() {
    drive_.step();
    now_us_ = std::max(now_us_, drive_.utime + kProcessing_us);
  }

  void go_on(int num_ticks) {
    for (int i = 0; i < num_ticks; ++i) {
      now_us_ += CanGate::kTickUs;
      output_.tick(now_us_, sink_);
    }
  }

  /// Changes bytes behind the fingerprint, and hands on what decodes.
  template <typename M>
  void take(const M& good, fuzz::Orders* orders) {
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(good.getEncodedSize()));
    good.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
    const std::uint8_t num_changes = orders->byte() % 8;
    for (std::uint8_t i = 0; i < num_changes; ++i) {
      const std::size_t at = orders->byte() + 256U * orders->byte();
      bytes[8 + at % (bytes.size() - 8)] = orders->byte();
    }
    M message;
    if (!decode_bounded(bytes, &message)) return;
    hand_on(message);
  }
  void hand_on(const ground_plane_t& message) {
    sink_.received(message.capture_mono_us);
    (void)output_.on_ground_plane(message, now_us_);
  }
  void hand_on(const ego_motion_t& message) {
    sink_.received(message.capture_mono_us);
    (void)output_.on_ego_motion(message, now_us_);
  }
  void hand_on(const mount_t& message) { (void)output_.on_mount(message, now_us_); }
  void hand_on(const objects_t& message) { (void)output_.on_objects(message, now_us_); }

  [[nodiscard]] mount_t mount() const {
    mount_t message{};
    message.utime = drive_.utime;
    message.status = mount_t::STATUS_STEADY;
    message.num_stretches = 12;
    message.progress = 1.0;
    message.height_m = 1.65;
    message.height_std_m = 0.01;
    return message;
  }
  [[nodiscard]] objects_t objects(std::uint8_t count) const {
    objects_t message{};
    message.utime = message.capture_mono_us = drive_.utime;
    message.seq = drive_.seq;
    message.num_objects = count;
    message.objects.resize(count);
    for (std::uint8_t i = 0; i < count; ++i) {
      object_t& object = message.objects[i];
      object = {};
      object.track_id = i;
      object.position_ground_m[0] = 10.0 + 5.0 * i;
      object.position_cov_m2[0][0] = object.position_cov_m2[1][1] = 0.1;
      object.size_m[0] = object.size_m[1] = object.size_m[2] = 2.0;
    }
    return message;
  }

  test::Drive drive_;
  std::int64_t now_us_ = 1'000'000;
  CanOutput output_{CanConfig{}};
  JudgingSink sink_;
};

}  // namespace
}  // namespace plumb

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer's name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  plumb::DriveOfOrders().run(plumb::fuzz::Orders({data, size}));
  return 0;
}
