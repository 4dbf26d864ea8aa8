#include "platform/bus.hpp"

#include <netinet/in.h>
#include <sys/socket.h>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <utility>

#include "platform/clock.hpp"
#include "platform/log.hpp"

namespace plumb {
namespace {

constexpr const char* kDefaultUrl = "udpm://239.255.76.67:7667?ttl=0";
constexpr int kMaxDescriptors = 1024;  // liblcm uses select(), which takes no higher ones

std::string resolve_url(const std::string& asked) {
  const char* preset = std::getenv("LCM_DEFAULT_URL");
  std::string url = asked;
  if (url.empty()) url = preset != nullptr && *preset != '\0' ? preset : kDefaultUrl;
  if (url.rfind("udpm://", 0) == 0 && url.find("recv_buf_size=") == std::string::npos) {
    url += url.find('?') == std::string::npos ? "?" : "&";
    url += "recv_buf_size=" + std::to_string(Bus::kReceiveBufferBytes);
  }
  return url;
}

int port_of(const std::string& url) {
  const std::size_t host = url.find("://");
  const std::size_t colon = host == std::string::npos ? host : url.find(':', host + 3);
  return colon == std::string::npos ? 7667 : std::atoi(url.c_str() + colon + 1);
}

// liblcm does not expose its receiving socket (lcm_get_fileno returns a pipe), so the socket is
// found by its port.
std::vector<int> sockets_bound_to(int port) {
  std::vector<int> found;
  for (int fd = 0; fd < kMaxDescriptors; ++fd) {
    sockaddr_in address{};
    socklen_t bytes = sizeof address;
    if (::getsockname(fd, reinterpret_cast<sockaddr*>(&address), &bytes) != 0) continue;
    if (address.sin_family == AF_INET && ntohs(address.sin_port) == port) found.push_back(fd);
  }
  return found;
}

}  // namespace

Bus::Bus(const std::string& url, Counters* counters) : url_(resolve_url(url)), counters_(counters) {
  lcm_ = lcm_create(url_.c_str());
  if (lcm_ == nullptr) throw BusError("cannot use LCM network " + url_);
}

Bus::~Bus() { lcm_destroy(lcm_); }

int Bus::fileno() {
  const int fd = lcm_get_fileno(lcm_);
  if (fd < 0) throw BusError("cannot receive on LCM network " + url_);
  return fd;
}

bool Bus::handle(int timeout_ms, std::int64_t busy_since_us) {
  busy_since_us_ = busy_since_us;
  const int result = lcm_handle_timeout(lcm_, timeout_ms);
  if (result < 0) log_limited("receiving from LCM failed");
  return result > 0;
}

void Bus::grow_receive_buffer() {
  if (receive_buffer_bytes_ > 0 || url_.rfind("udpm://", 0) != 0) return;
  for (const int fd : sockets_bound_to(port_of(url_))) {
    int booked = 0;
    socklen_t bytes = sizeof booked;
    if (::getsockopt(fd, SOL_SOCKET, SO_RCVBUF, &booked, &bytes) != 0) continue;
    if (booked / 2 < kReceiveBufferBytes) {
      // This exceeds net.core.rmem_max, which only an administrator may do. A failed attempt
      // changes nothing.
      const int wanted = kReceiveBufferBytes;
      (void)::setsockopt(fd, SOL_SOCKET, SO_RCVBUFFORCE, &wanted, sizeof wanted);
      bytes = sizeof booked;
      if (::getsockopt(fd, SOL_SOCKET, SO_RCVBUF, &booked, &bytes) != 0) continue;
    }
    receive_buffer_bytes_ = booked / 2;
  }
  if (receive_buffer_bytes_ > 0 && receive_buffer_bytes_ < kReceiveBufferBytes) {
    log_line(
        "the kernel granted a receive buffer of %d bytes instead of %d; images may be lost; "
        "to grant it run: sysctl -w net.core.rmem_max=%d",
        receive_buffer_bytes_, kReceiveBufferBytes, kReceiveBufferBytes);
  }
}

RawSubscriber::RawSubscriber(Bus& bus, const Channel& channel, Input input, Handler handler)
    : bus_(bus), channel_(channel), input_(input), handler_(std::move(handler)) {
  subscription_ = lcm_subscribe(bus.lcm(), channel.name, &RawSubscriber::on_message, this);
  if (subscription_ == nullptr)
    throw BusError("cannot receive " + std::string(channel.name) + " on LCM network " + bus.url());
  lcm_subscription_set_queue_capacity(subscription_, kQueueMessages);
  bus.subscribers_.push_back(this);
  bus.grow_receive_buffer();
}

RawSubscriber::~RawSubscriber() {
  lcm_unsubscribe(bus_.lcm(), subscription_);
  auto& list = bus_.subscribers_;
  list.erase(std::find(list.begin(), list.end(), this));
}

// liblcm calls this from C, so no exception may leave it.
void RawSubscriber::on_message(const lcm_recv_buf_t* raw, const char* /*channel*/, void* self) {
  auto& subscriber = *static_cast<RawSubscriber*>(self);
  try {
    subscriber.dispatch(*raw);
  } catch (const std::exception& error) {
    subscriber.bus_.counters().reject("its handler threw an exception");
    log_limited("%s: %s", subscriber.channel_.name, error.what());
  }
}

void RawSubscriber::dispatch(const lcm_recv_buf_t& raw) {
  last_us_ = monotonic_us();
  Counters& counters = bus_.counters();
  ++counters.num_received;
  const char* refused = handler_({static_cast<const std::uint8_t*>(raw.data), raw.data_size});
  if (refused != nullptr) {
    counters.reject(refused);
    log_limited("a message on %s was refused: %s", channel_.name, refused);
  }
  if (channel_.stale_us > 0 && waited_us(raw) > channel_.stale_us) ++counters.num_late;
}

// Time between the arrival at the socket and now. liblcm stamps the arrival with the calendar
// clock, which may step, and does not renew the stamp of a buffer that it reuses. The stamp is
// therefore trusted only as far back as this thread has been busy.
std::int64_t RawSubscriber::waited_us(const lcm_recv_buf_t& raw) const {
  return std::clamp<std::int64_t>(realtime_us() - raw.recv_utime, 0,
                                  monotonic_us() - bus_.busy_since_us_);
}

}  // namespace plumb
