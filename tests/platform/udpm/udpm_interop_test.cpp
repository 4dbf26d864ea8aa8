// Our endpoint and stock LCM on one network: library, logger and log player.
#include <gtest/gtest.h>

#include <thread>

#include "platform/udpm/udpm_receiver.hpp"
#include "platform/udpm/udpm_sender.hpp"
#include "tests/platform/udpm/packets.hpp"
#include "tests/platform/udpm/stock_lcm.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/private_network.hpp"
#include "tests/support/temp_folder.hpp"

namespace plumb {
namespace {

using test::Bytes;
using test::kTestUrl;
using test::pattern;
using test::Received;
using test::StockLcm;
using test::wait_for_message;

constexpr std::size_t kImageBytes = 466'616;
const std::string kChannel = "CAMERA";  // NOLINT(cert-err58-cpp)
/// Around the sizes at which liblcm begins to fragment and adds a fragment.
const std::vector<std::size_t> kSizes{0,       1,       2'000,   65'491,  65'492,      65'493,
                                      130'966, 130'967, 130'968, 458'402, kImageBytes, 1'000'000};

class UdpmInterop : public testing::Test {
 protected:
  static void SetUpTestSuite() { is_private_ = test::enter_private_network(); }
  void SetUp() override {
    if (!is_private_) GTEST_SKIP() << test::kNoPrivateNetwork;
  }
  static inline bool is_private_ = false;
};

void expect_message(UdpmReceiver* receiver, const Bytes& payload) {
  const MessageQueues::View message = wait_for_message(receiver);
  ASSERT_NE(MessageQueues::kNone, message.subscription) << payload.size();
  ASSERT_EQ(payload.size(), message.bytes.size());
  ASSERT_TRUE(std::equal(payload.begin(), payload.end(), message.bytes.begin())) << payload.size();
}

TEST_F(UdpmInterop, HearsTheStockLibrary) {
  UdpmReceiver receiver(parse_udpm_url(kTestUrl));
  receiver.subscribe({kChannel, 1'000'000, 4});
  StockLcm stock;
  for (const std::size_t size : kSizes) {
    const Bytes payload = pattern(size, 1);
    ASSERT_TRUE(stock.publish(kChannel, payload));
    expect_message(&receiver, payload);
  }
  EXPECT_EQ(0, receiver.inbox().outcomes().num_refused());
  EXPECT_EQ(0, receiver.num_overflowed());
}

TEST_F(UdpmInterop, IsHeardByTheStockLibrary) {
  StockLcm stock;
  stock.subscribe(kChannel);
  UdpmSender sender(parse_udpm_url(kTestUrl));
  std::size_t count = 0;
  for (const std::size_t size : kSizes) {
    const Bytes payload = pattern(size, 2);
    ASSERT_TRUE(sender.publish(kChannel, payload));
    ++count;
    ASSERT_EQ(count, stock.receive(count).size()) << size;
    ASSERT_EQ((Received{kChannel, payload}), stock.receive(count).back()) << size;
  }
  EXPECT_EQ(static_cast<std::int64_t>(count), sender.num_sent());
}

TEST_F(UdpmInterop, LosesNoneOfAThousandMessagesEachWay) {
  UdpmReceiver receiver(parse_udpm_url(kTestUrl));
  const int image = receiver.subscribe({kChannel, kImageBytes, 4});
  const int motion = receiver.subscribe({"VO_MOTION", 500, 16});
  StockLcm stock;
  stock.subscribe("EGO_MOTION");
  UdpmSender sender(parse_udpm_url(kTestUrl));
  for (std::uint32_t i = 0; i < 1'000; ++i) {
    const bool is_image = i % 10 == 0;
    const Bytes payload = pattern(is_image ? kImageBytes : i % 500, i);
    ASSERT_TRUE(stock.publish(is_image ? kChannel : "VO_MOTION", payload));
    const MessageQueues::View message = wait_for_message(&receiver);
    ASSERT_EQ(is_image ? image : motion, message.subscription) << i;
    ASSERT_TRUE(
        std::equal(payload.begin(), payload.end(), message.bytes.begin(), message.bytes.end()))
        << i;
    ASSERT_TRUE(sender.publish("EGO_MOTION", message.bytes));
    ASSERT_EQ(i + 1, stock.receive(i + 1).size());
    ASSERT_EQ(payload, stock.receive(i + 1).back().bytes);
  }
  EXPECT_EQ(0, receiver.inbox().outcomes().num_refused());
  EXPECT_EQ(0, receiver.inbox().num_given_up());
}

TEST_F(UdpmInterop, TwoProgramsHearEachMessage) {
  UdpmReceiver first(parse_udpm_url(kTestUrl));
  UdpmReceiver second(parse_udpm_url(kTestUrl));
  first.subscribe({kChannel, 100, 4});
  second.subscribe({kChannel, 100, 4});
  StockLcm stock;
  stock.subscribe(kChannel);
  UdpmSender sender(parse_udpm_url(kTestUrl));
  ASSERT_TRUE(sender.publish(kChannel, Bytes{1, 2, 3}));
  expect_message(&first, {1, 2, 3});
  expect_message(&second, {1, 2, 3});
  EXPECT_EQ(1U, stock.receive(1).size());
}

std::vector<Received> read_log(const std::string& path) {
  std::vector<Received> events;
  lcm_eventlog_t* log = lcm_eventlog_create(path.c_str(), "r");
  if (log == nullptr) return events;
  while (lcm_eventlog_event_t* event = lcm_eventlog_read_next_event(log)) {
    const auto* bytes = static_cast<const std::uint8_t*>(event->data);
    events.push_back({event->channel, {bytes, bytes + event->datalen}});
    lcm_eventlog_free_event(event);
  }
  lcm_eventlog_destroy(log);
  return events;
}

/// What was logged beside the words that keep the logger writing.
std::vector<Received> logged_messages(const std::string& path) {
  std::vector<Received> events = read_log(path);
  std::erase_if(events, [](const Received& event) { return event.channel == "HELLO"; });
  return events;
}

/// Sends words to the logger until `is_done`: it writes what it has when the next message comes.
template <typename Done>
void wait_for_logger(UdpmSender* sender, Done is_done) {
  for (int i = 0; i < 1'000; ++i) {
    sender->publish("HELLO", Bytes{1});
    if (is_done()) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  ADD_FAILURE() << "lcm-logger does not write";
}

TEST_F(UdpmInterop, TheStockLoggerRecordsAndTheStockPlayerPlaysUnchanged) {
  const test::TempFolder folder;
  const std::string path = (folder / "out.lcm").string();
  std::vector<Received> sent;
  for (std::uint32_t i = 0; i < 60; ++i) {
    if (i % 4 == 0)
      sent.push_back({kChannel, pattern(kImageBytes, i)});
    else
      sent.push_back({"VO_MOTION", pattern(100 + i, i)});
  }
  {
    test::ChildProcess logger({"lcm-logger", "--flush-interval=1", "-q",
                               "--channel=HELLO|CAMERA|VO_MOTION",
                               std::string("--lcm-url=") + kTestUrl, path});
    UdpmSender sender(parse_udpm_url(kTestUrl));
    std::error_code error;
    wait_for_logger(&sender, [&] {
      const std::uintmax_t size = std::filesystem::file_size(path, error);
      return !error && size > 0;
    });
    for (std::size_t i = 0; i < sent.size(); ++i) {
      ASSERT_TRUE(sender.publish(sent[i].channel, sent[i].bytes));
      // On a busy machine the logger waits, and it loses what its buffer cannot hold.
      if (i % 4 == 3) wait_for_logger(&sender, [&] { return logged_messages(path).size() > i; });
    }
    logger.signal(SIGINT);
    EXPECT_EQ(0, logger.wait()) << logger.output();
  }
  const std::vector<Received> logged = logged_messages(path);
  ASSERT_EQ(sent.size(), logged.size());
  EXPECT_TRUE(sent == logged);

  UdpmReceiver receiver(parse_udpm_url(kTestUrl));
  receiver.subscribe({kChannel, kImageBytes, 4});
  receiver.subscribe({"VO_MOTION", 200, 64});
  test::ChildProcess player({"lcm-logplayer", "-l", kTestUrl, path});
  for (const Received& message : sent) expect_message(&receiver, message.bytes);
  EXPECT_EQ(0, player.wait());
  EXPECT_EQ(0, receiver.inbox().outcomes().num_refused());
}

}  // namespace
}  // namespace plumb
