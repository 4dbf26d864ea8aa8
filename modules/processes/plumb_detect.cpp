/// CAMERA -> boxes of vehicles and people -> DETECTIONS, by a network that the user names
#include <optional>

#include "modules/chain/plumb_config.hpp"
#include "modules/detector/detect_node.hpp"
#include "platform/clock.hpp"
#include "platform/process.hpp"

namespace {

constexpr std::size_t kMaxBytes =
    sizeof(plumb::detections_t) + plumb::kMaxDetections * sizeof(plumb::detection_t);

class DetectProcess {
 public:
  DetectProcess(plumb::Process& process, const plumb::DetectConfig& config)
      : process_(process),
        node_(config),
        detections_(process.bus(), plumb::kDetections, kMaxBytes),
        camera_(process.bus(), plumb::kCamera, plumb::Input::kPeriodic,
                [this](plumb::RawSubscriber::Bytes bytes) { return on_image(bytes); }),
        period_us_(static_cast<std::int64_t>(1e6 / config.rate_hz)),
        next_search_(process.loop().timer([this] { search(); })) {}

 private:
  /// Searched as soon as the rate allows; until then a newer image may take its place.
  const char* on_image(plumb::RawSubscriber::Bytes bytes) {
    const char* refused = node_.take_image(bytes);
    process_.counters().num_dropped = node_.num_passed_over();
    if (refused == nullptr) process_.loop().arm_at(next_search_, next_us_);
    return refused;
  }

  void search() {
    next_us_ = plumb::monotonic_us() + period_us_;
    process_.timer().begin();
    const char* refused = nullptr;
    const plumb::detections_t* found = node_.search(&refused);
    if (refused != nullptr) ++process_.counters().num_rejected;
    if (found == nullptr) return;
    process_.timer().mark("detect");
    detections_.publish(*found);
    process_.timer().end();
  }

  plumb::Process& process_;
  plumb::DetectNode node_;
  plumb::Publisher<plumb::detections_t> detections_;
  plumb::RawSubscriber camera_;
  std::int64_t period_us_;
  std::int64_t next_us_ = 0;
  plumb::EventLoop::TimerId next_search_;
};

}  // namespace

int main(int argc, char** argv) {
  plumb::Process process({"detect",
                          "Boxes of vehicles and people by a network of your choice: CAMERA -> "
                          "DETECTIONS",
                          plumb::kHealthDetect});
  plumb::PlumbConfig config;
  std::optional<DetectProcess> detect;
  return process.run(argc, argv, &config, [&] { detect.emplace(process, config.detect); });
}
