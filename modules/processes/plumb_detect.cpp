/// plumb-detect: CAMERA -> boxes of vehicles and people,
/// by a network of the user's choice -> DETECTIONS
#include <optional>

#include "modules/chain/plumb_config.hpp"
#include "modules/detector/detector_node.hpp"
#include "platform/clock.hpp"
#include "platform/process.hpp"

namespace {

constexpr std::size_t kMaxBytes =
    sizeof(plumb::detections_t) + plumb::kMaxDetections * sizeof(plumb::detection_t);

class DetectorProcess {
 public:
  DetectorProcess(plumb::Process& process, const plumb::DetectorConfig& config, int max_pixels)
      : process_(process),
        node_(config),
        detections_(process.bus(), plumb::kDetections, kMaxBytes),
        camera_(
            process.bus(), plumb::kCamera, plumb::Input::kPeriodic,
            [this](plumb::RawSubscriber::Bytes bytes) { return on_image(bytes); },
            plumb::image_memory(max_pixels)),
        period_us_(static_cast<std::int64_t>(1e6 / config.rate_hz)),
        next_search_(process.loop().timer([this] { search(); })) {}

 private:
  /// Schedules a search for the earliest time that the rate allows. Until then a newer image
  /// replaces this one.
  const char* on_image(plumb::RawSubscriber::Bytes bytes) {
    const char* refused = node_.take_image(bytes);
    process_.counters().num_skipped = node_.num_skipped();
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
  plumb::DetectorNode node_;
  plumb::Publisher<plumb::detections_t> detections_;
  plumb::RawSubscriber camera_;
  std::int64_t period_us_;
  std::int64_t next_us_ = 0;
  plumb::EventLoop::TimerId next_search_;
};

}  // namespace

int main(int argc, char** argv) {
  plumb::Process process({"detect",
                          "Detects vehicles and people with a network of your choice: CAMERA -> "
                          "DETECTIONS",
                          plumb::kHealthDetect});
  plumb::PlumbConfig config;
  std::optional<DetectorProcess> detector;
  return process.run(argc, argv, &config,
                     [&] { detector.emplace(process, config.detect, config.images.max_pixels); });
}
