/// Serves the page over HTTP and its messages over a WebSocket, with libwebsockets in one thread.
///
/// Limits:
///   kMaxPages pages and kMaxConnections connections; whoever comes later is refused. A page has at
///   most kMaxInFlight frames that it has not acknowledged, and gets the newest one next: a slow
///   page skips frames, and nothing waits for it. A request of a page has at most kMaxRequestBytes.
/// Safety:
///   Only the files of the page are served, from memory. A page of another origin is refused, and
///   so is a host name that is not this machine's: with it, any page of the web could read along.
/// Threads:
///   Its functions may be called from any thread; the source is called from the server's thread.
/// Errors:
///   The constructor throws std::runtime_error when the address cannot be used.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "tools/monitor/monitor_source.hpp"

namespace plumb {

/// One file of the page. The bytes outlive the server.
struct WebFile {
  std::string path;  ///< "/page.js"
  std::string type;  ///< "text/javascript"
  std::span<const char> bytes;
};

struct WebAddress {
  std::string host = "127.0.0.1";  ///< IPv4 address to listen on
  int port = 8190;                 ///< 0: a free one
  int listening_fd = -1;           ///< a socket that listens already, or -1
};

class WebServer {
 public:
  static constexpr int kMaxPages = 8;
  static constexpr int kMaxConnections = 48;
  static constexpr int kMaxInFlight = 2;
  static constexpr std::size_t kMaxRequestBytes = 256;

  /// Listens and starts the thread. `source` outlives the server.
  WebServer(const WebAddress& address, std::vector<WebFile> files, MonitorSource* source);
  ~WebServer();
  WebServer(const WebServer&) = delete;
  WebServer& operator=(const WebServer&) = delete;

  /// Makes `packet` the newest frame, for every page.
  void publish(std::shared_ptr<const Packet> packet);
  /// Tells the pages that the source has news.
  void notify();

  [[nodiscard]] int port() const { return port_; }
  [[nodiscard]] int num_pages() const { return num_pages_; }
  [[nodiscard]] std::int64_t num_refused() const { return num_refused_; }

 private:
  friend struct WebCallbacks;
  struct Client;
  struct Shared;

  std::unique_ptr<Shared> shared_;
  std::atomic<int> num_pages_ = 0;
  std::atomic<std::int64_t> num_refused_ = 0;
  int port_ = 0;
  std::thread thread_;
};

}  // namespace plumb
