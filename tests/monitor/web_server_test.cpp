/// The web server against browsers, strangers and clients that misbehave.
#include "tools/monitor/web_server.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <mutex>

#include "tests/monitor/web_client.hpp"

namespace plumb {
namespace {

using test::WebClient;

/// A source that remembers what pages asked for.
class RecordingSource final : public MonitorSource {
 public:
  std::string hello() override { return R"({"type":"hello"})"; }
  std::shared_ptr<const Packet> news(NewsCursor* cursor) override {
    const std::lock_guard lock(mutex_);
    if (cursor->event >= num_events_) return nullptr;
    cursor->event = num_events_;
    return make_packet(R"({"type":"news"})");
  }
  std::shared_ptr<const Packet> frame(std::int64_t index) override {
    if (index >= 10) return nullptr;
    return make_packet(R"({"type":"frame","index":)" + std::to_string(index) + "}", {}, index);
  }
  void acknowledge(std::int64_t id) override {
    const std::lock_guard lock(mutex_);
    acknowledged_.push_back(id);
  }
  void add_event() {
    const std::lock_guard lock(mutex_);
    ++num_events_;
  }
  std::vector<std::int64_t> acknowledged() {
    const std::lock_guard lock(mutex_);
    return acknowledged_;
  }

 private:
  std::mutex mutex_;
  std::int64_t num_events_ = 0;
  std::vector<std::int64_t> acknowledged_;
};

class WebServerTest : public ::testing::Test {
 protected:
  void publish(std::int64_t id, std::size_t jpeg_bytes = 0) {
    const std::vector<std::uint8_t> jpeg(jpeg_bytes, 7);
    server_.publish(make_packet(R"({"type":"frame","id":)" + std::to_string(id) + "}", jpeg, id));
  }
  bool wait_for_pages(int count) {
    for (int i = 0; i < 300 && server_.num_pages() != count; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return server_.num_pages() == count;
  }
  /// The page still comes, so the server is well.
  void expect_well() {
    WebClient client(server_.port());
    EXPECT_EQ(client.get("/").rfind("HTTP/1.1 200", 0), 0U);
    EXPECT_EQ(client.body(kPage.size()), kPage);
  }

  static constexpr std::string_view kPage = "<p>page";
  RecordingSource source_;
  std::string script_ = std::string(100'000, 's');
  WebServer server_{{"127.0.0.1", 0, -1},
                    {{"/", "text/html", kPage},
                     {"/page.js", "text/javascript", {script_.data(), script_.size()}}},
                    &source_};
};

TEST_F(WebServerTest, ServesItsFilesAndNothingElse) {
  WebClient client(server_.port());
  const std::string head = client.get("/page.js");
  EXPECT_NE(head.find("content-type: text/javascript"), std::string::npos) << head;
  EXPECT_NE(head.find("content-security-policy: default-src 'none'"), std::string::npos);
  EXPECT_EQ(client.body(script_.size()), script_);
  for (const char* path : {"/nothing", "/../etc/passwd", "/%2e%2e/etc/passwd", "/page.js/x"}) {
    WebClient other(server_.port());
    EXPECT_EQ(other.get(path).rfind("HTTP/1.1 200", 0), std::string::npos) << path;
  }
  for (const char* method : {"POST", "PUT", "DELETE", "OPTIONS"}) {
    WebClient other(server_.port());
    const std::string answer =
        other.request(std::string(method) + " / HTTP/1.1", "Content-Length: 0\r\n");
    EXPECT_EQ(answer.rfind("HTTP/1.1 200", 0), std::string::npos) << method;
  }
  expect_well();
}

TEST_F(WebServerTest, GreetsAPageThenSendsTheNewestFrame) {
  publish(3);
  WebClient page(server_.port());
  ASSERT_EQ(page.open_page().rfind("HTTP/1.1 101", 0), 0U);
  ASSERT_TRUE(page.hear_packet("hello"));
  EXPECT_EQ((*page.hear_packet("frame"))["id"], 3);
  publish(4, 50'000);
  EXPECT_EQ((*page.hear_packet("frame"))["id"], 4);
  EXPECT_EQ(page.jpeg(), std::string(50'000, 7));
  source_.add_event();
  server_.notify();
  EXPECT_TRUE(page.hear_packet("news"));
}

TEST_F(WebServerTest, SlowPageSkipsToTheNewestFrame) {
  WebClient page(server_.port());
  page.open_page();
  ASSERT_TRUE(page.hear_packet("hello"));
  for (std::int64_t id = 0; id < 2; ++id) {
    publish(id);
    ASSERT_EQ((*page.hear_packet("frame"))["id"], id);
  }
  for (std::int64_t id = 2; id < 50; ++id) publish(id, 10'000);
  EXPECT_FALSE(page.hear_packet("frame", 300)) << "two frames are not acknowledged";
  page.say("ack 0");
  EXPECT_EQ((*page.hear_packet("frame"))["id"], 49);
  page.say("ack 1");
  page.say("ack 49");
  EXPECT_FALSE(page.hear_packet("frame", 200)) << "there is no newer one";
  EXPECT_EQ(source_.acknowledged(), (std::vector<std::int64_t>{0, 1, 49}));
}

TEST_F(WebServerTest, AnswersTheNewestQuestionForAFrame) {
  WebClient page(server_.port());
  page.open_page();
  ASSERT_TRUE(page.hear_packet("hello"));
  page.say("frame 7");
  EXPECT_EQ((*page.hear_packet("frame"))["index"], 7);
  page.say("frame 5000");
  EXPECT_FALSE(page.hear_packet("frame", 200));
}

TEST_F(WebServerTest, RefusesOtherOriginsAndHosts) {
  const std::string own = "127.0.0.1:" + std::to_string(server_.port());
  const std::string foreign[] = {"Origin: http://evil.example\r\n", "Origin: null\r\n",
                                 "Origin: https://" + own + "\r\n"};
  for (const std::string& origin : foreign) {
    WebClient page(server_.port());
    EXPECT_EQ(page.open_page(origin).rfind("HTTP/1.1 101", 0), std::string::npos) << origin;
  }
  // A name that a stranger's server resolves to this machine.
  WebClient rebound(server_.port());
  EXPECT_EQ(
      rebound.open_page("Origin: http://evil.example\r\n", "evil.example").rfind("HTTP/1.1 101", 0),
      std::string::npos);
  WebClient page(server_.port());
  EXPECT_EQ(page.request("GET / HTTP/1.1", {}, "evil.example").rfind("HTTP/1.1 403", 0), 0U);
  WebClient own_page(server_.port());
  EXPECT_EQ(own_page.open_page("Origin: http://" + own + "\r\n").rfind("HTTP/1.1 101", 0), 0U);
}

TEST_F(WebServerTest, RefusesWhoeverComesAfterTheLastPlace) {
  std::vector<std::unique_ptr<WebClient>> pages;
  for (int i = 0; i < WebServer::kMaxPages; ++i) {
    pages.push_back(std::make_unique<WebClient>(server_.port()));
    pages.back()->open_page();
    ASSERT_TRUE(pages.back()->hear_packet("hello"));
  }
  EXPECT_EQ(server_.num_pages(), WebServer::kMaxPages);
  WebClient late(server_.port());
  late.open_page();
  EXPECT_FALSE(late.hear_packet("hello", 500));
  EXPECT_GE(server_.num_refused(), 1);
  pages.pop_back();
  ASSERT_TRUE(wait_for_pages(WebServer::kMaxPages - 1));
  WebClient next(server_.port());
  next.open_page();
  EXPECT_TRUE(next.hear_packet("hello"));
}

TEST_F(WebServerTest, SurvivesManyConnections) {
  // Each closed one gives its place back, and a crowd that says nothing leaves the pages alone.
  for (int round = 0; round < 4 * WebServer::kMaxConnections; ++round) {
    WebClient client(server_.port());
    if (round % 3 == 0) client.open_page();
    if (round % 3 == 1) client.get("/");
  }
  ASSERT_TRUE(wait_for_pages(0));
  expect_well();
  WebClient page(server_.port());
  page.open_page();
  ASSERT_TRUE(page.hear_packet("hello"));
  std::vector<std::unique_ptr<WebClient>> crowd;
  for (int i = 0; i < 2 * WebServer::kMaxConnections; ++i)
    crowd.push_back(std::make_unique<WebClient>(server_.port()));
  publish(1);
  EXPECT_TRUE(page.hear_packet("frame"));
  EXPECT_GE(server_.num_refused(), WebServer::kMaxConnections);
  crowd.clear();
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  expect_well();
}

TEST_F(WebServerTest, MalformedRequestsDoNoHarm) {
  const std::string long_line(20'000, 'a');
  const std::string requests[] = {
      "\r\n\r\n",
      "GET\r\n\r\n",
      "GET / HTTP/9.9\r\n\r\n",
      "GET / HTTP/1.1\r\n\r\n",
      "GET /" + long_line + " HTTP/1.1\r\n\r\n",
      "GET / HTTP/1.1\r\nHost: x\r\nX: " + long_line + "\r\n\r\n",
      std::string("\0\x01\x02\xff\xfe\x80", 6),
      "GET / HTTP/1.1\r\nContent-Length: -1\r\n\r\n",
      "GET / HTTP/1.1\r\nHost: 127.0.0.1\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n\r\n",
      "GET /%00%ff%zz HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n",
      "PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n"};
  for (const std::string& request : requests) {
    WebClient client(server_.port());
    client.send_bytes(request);
    client.is_ended(50);
  }
  expect_well();
}

TEST_F(WebServerTest, MalformedMessagesEndThePageAlone) {
  WebClient good(server_.port());
  good.open_page();
  ASSERT_TRUE(good.hear_packet("hello"));
  const std::pair<std::string, std::uint8_t> messages[] = {{"", 0x81},
                                                           {"ack", 0x81},
                                                           {"ack -1", 0x81},
                                                           {"ack 1x", 0x81},
                                                           {"frame 1e9", 0x81},
                                                           {"frame 99999999999999999999", 0x81},
                                                           {"reset all", 0x81},
                                                           {std::string(300, 'a'), 0x81},
                                                           {std::string(60'000, 'a'), 0x81},
                                                           {"ack 1", 0x01 /* a fragment */}};
  for (const auto& [text, head] : messages) {
    WebClient page(server_.port());
    page.open_page();
    ASSERT_TRUE(page.hear_packet("hello"));
    page.say(text, head);
    EXPECT_TRUE(page.is_ended()) << text.substr(0, 40) << " " << int{head};
  }
  for (const std::uint8_t head :
       {std::uint8_t{0xF1}, std::uint8_t{0x83}}) {  // reserved bits, opcode
    WebClient page(server_.port());
    page.open_page();
    page.say("ack 1", head);
    page.is_ended(100);
  }
  publish(9);
  EXPECT_TRUE(good.hear_packet("frame"));
  EXPECT_TRUE(source_.acknowledged().empty());
  expect_well();
}

TEST(WebServerAddress, SaysWhatCannotBeUsed) {
  RecordingSource source;
  EXPECT_THROW(WebServer({"no address", 0, -1}, {}, &source), std::runtime_error);
  EXPECT_THROW(WebServer({"192.0.2.1", 0, -1}, {}, &source), std::runtime_error);
  EXPECT_THROW(WebServer({"127.0.0.1", 0, 0}, {}, &source), std::runtime_error);
}

}  // namespace
}  // namespace plumb
