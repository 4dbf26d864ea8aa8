// Load for measurements by hand: images of KITTI's size through our endpoint or through liblcm.
//
//   udpm_load send ours|stock IMAGES_PER_S NUM_IMAGES
//   udpm_load receive ours|stock SECONDS
//
// Prints processor time per image and what was lost. Run it in a private network (unshare -n).
#include <lcm/lcm.h>
#include <poll.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "platform/clock.hpp"
#include "platform/udpm/udpm_receiver.hpp"
#include "platform/udpm/udpm_sender.hpp"

namespace {

using plumb::MessageQueues;
using plumb::monotonic_us;

constexpr const char* kUrl = "udpm://239.255.76.67:7667?ttl=0&recv_buf_size=8388608";
constexpr std::size_t kImageBytes = 466'616;

/// Counts images by the number at their beginning.
struct Tally {
  std::int64_t num_images = 0;
  std::int64_t num_lost = 0;
  std::int64_t next = 0;

  void take(const std::uint8_t* bytes, std::size_t size) {
    std::int64_t number = 0;
    if (size != kImageBytes) return;
    std::memcpy(&number, bytes, sizeof number);
    num_lost += number - next;
    next = number + 1;
    ++num_images;
  }
  void print(const char* who) const {
    std::printf("%s: %lld images, %lld lost, %.1f us of processor time per image\n", who,
                static_cast<long long>(num_images), static_cast<long long>(num_lost),
                static_cast<double>(plumb::process_cpu_us()) /
                    static_cast<double>(num_images > 0 ? num_images : 1));
  }
};

template <typename Publish>
void send(double images_per_s, std::int64_t count, Publish publish) {
  std::vector<std::uint8_t> image(kImageBytes, 1);
  const std::int64_t start_us = monotonic_us();
  Tally tally;
  for (std::int64_t i = 0; i < count; ++i) {
    const std::int64_t due_us =
        start_us + static_cast<std::int64_t>(1e6 * static_cast<double>(i) / images_per_s);
    const std::int64_t early_us = due_us - monotonic_us();
    if (early_us > 0) ::usleep(static_cast<useconds_t>(early_us));
    std::memcpy(image.data(), &i, sizeof i);
    if (publish(image)) tally.take(image.data(), image.size());
  }
  tally.print("sent");
}

void receive_ours(std::int64_t end_us) {
  plumb::UdpmReceiver receiver(plumb::parse_udpm_url(kUrl));
  receiver.subscribe({"CAMERA", kImageBytes, 3});
  receiver.subscribe({"VO_MOTION", 4'096, 8});
  Tally tally;
  while (monotonic_us() < end_us) {
    const MessageQueues::View message = receiver.take();
    if (message.subscription == 0) tally.take(message.bytes.data(), message.bytes.size());
    if (message.subscription != MessageQueues::kNone) continue;
    pollfd watched{receiver.fileno(), POLLIN, 0};
    (void)::poll(&watched, 1, 100);
  }
  tally.print("received by ours");
  for (std::size_t i = 0; i < plumb::kNumUdpmOutcomes; ++i) {
    const auto outcome = static_cast<plumb::UdpmOutcome>(i);
    const std::int64_t count = receiver.inbox().outcomes()[outcome];
    if (count > 0) std::printf("  %lld x %s\n", static_cast<long long>(count), describe(outcome));
  }
  std::printf("  %lld given up, %lld found the kernel's buffer of %d bytes full\n",
              static_cast<long long>(receiver.inbox().num_given_up()),
              static_cast<long long>(receiver.num_overflowed()), receiver.receive_buffer_bytes());
}

void receive_stock(std::int64_t end_us) {
  lcm_t* lcm = lcm_create(kUrl);
  Tally tally;
  const auto handler = [](const lcm_recv_buf_t* raw, const char* /*channel*/, void* to) {
    static_cast<Tally*>(to)->take(static_cast<const std::uint8_t*>(raw->data), raw->data_size);
  };
  lcm_subscription_set_queue_capacity(lcm_subscribe(lcm, "CAMERA", handler, &tally), 64);
  while (monotonic_us() < end_us) lcm_handle_timeout(lcm, 100);
  tally.print("received by stock");
  lcm_destroy(lcm);
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  if (words.size() == 4 && words[0] == "send") {
    const double rate = std::atof(words[2].c_str());
    const std::int64_t count = std::atoll(words[3].c_str());
    if (words[1] == "ours") {
      plumb::UdpmSender sender(plumb::parse_udpm_url(kUrl));
      send(rate, count, [&](const auto& image) { return sender.publish("CAMERA", image); });
    } else {
      lcm_t* lcm = lcm_create(kUrl);
      send(rate, count, [&](const auto& image) {
        return lcm_publish(lcm, "CAMERA", image.data(), static_cast<unsigned>(image.size())) == 0;
      });
      lcm_destroy(lcm);
    }
    return 0;
  }
  if (words.size() == 3 && words[0] == "receive") {
    const auto end_us =
        monotonic_us() + static_cast<std::int64_t>(1e6 * std::atof(words[2].c_str()));
    if (words[1] == "ours") {
      receive_ours(end_us);
    } else {
      receive_stock(end_us);
    }
    return 0;
  }
  std::fprintf(stderr,
               "usage: udpm_load send ours|stock RATE COUNT | receive ours|stock SECONDS\n");
  return 2;
}
