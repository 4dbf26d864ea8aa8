/// A small client of HTTP and WebSocket that can also misbehave.
#pragma once

#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace plumb::test {

class WebClient {
 public:
  static constexpr int kPatience_ms = 3000;

  explicit WebClient(int port) : fd_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    connected_ = ::connect(fd_, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0;
    host_ = "127.0.0.1:" + std::to_string(port);
  }
  ~WebClient() { close(); }
  WebClient(const WebClient&) = delete;
  WebClient& operator=(const WebClient&) = delete;

  void close() {
    if (fd_ >= 0) ::close(fd_);
    fd_ = -1;
  }
  bool send_bytes(std::string_view bytes) {
    return ::send(fd_, bytes.data(), bytes.size(), MSG_NOSIGNAL) ==
           static_cast<ssize_t>(bytes.size());
  }
  /// The answer's first line and head; empty when the server closed the connection or is silent.
  std::string request(const std::string& line, const std::string& headers = {},
                      const std::string& host = {}) {
    send_bytes(line + "\r\nHost: " + (host.empty() ? host_ : host) + "\r\n" + headers + "\r\n");
    return read_head();
  }
  std::string get(const std::string& path) { return request("GET " + path + " HTTP/1.1"); }
  /// The `size` bytes that follow the head, or what comes of them.
  std::string body(std::size_t size) {
    while (buffer_.size() < size && read_some(kPatience_ms)) {
    }
    return std::exchange(buffer_, {});
  }
  /// Upgrades to a WebSocket. Returns the answer's head.
  std::string open_page(const std::string& headers = {}, const std::string& host = {}) {
    return request("GET / HTTP/1.1",
                   "Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
                   "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n"
                   "Sec-WebSocket-Protocol: plumb-monitor\r\n" +
                       headers,
                   host);
  }
  /// Sends a text frame with a mask, as browsers do.
  bool say(const std::string& text, std::uint8_t head = 0x81) {
    std::string frame{static_cast<char>(head)};
    if (text.size() < 126) {
      frame += static_cast<char>(0x80U | text.size());
    } else {
      frame += static_cast<char>(0xFE);
      frame += static_cast<char>(text.size() >> 8U);
      frame += static_cast<char>(text.size() & 0xFFU);
    }
    frame += std::string(4, '\0') + text;  // a mask of zeros changes nothing
    return send_bytes(frame);
  }
  /// The next message's payload; nothing after `timeout_ms` or at the end of the connection.
  std::optional<std::string> hear(int timeout_ms = kPatience_ms) {
    for (;;) {
      std::size_t head = 2;
      const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(buffer_[i]); };
      while (buffer_.size() < 10 && !whole_frame(&head) && read_some(timeout_ms)) {
      }
      if (!whole_frame(&head)) {
        if (!read_some(timeout_ms)) return std::nullopt;
        continue;
      }
      const std::size_t size = frame_bytes(&head);
      const int opcode = byte(0) & 0x0FU;
      std::string payload = buffer_.substr(head, size);
      buffer_.erase(0, head + size);
      if (opcode == 8) return std::nullopt;
      if (opcode == 1 || opcode == 2) return payload;
    }
  }
  /// The JSON of the next message that is a packet of `type`.
  std::optional<nlohmann::json> hear_packet(const std::string& type,
                                            int timeout_ms = kPatience_ms) {
    while (auto payload = hear(timeout_ms)) {
      std::uint32_t length = 0;
      std::memcpy(&length, payload->data(), sizeof length);
      auto json = nlohmann::json::parse(payload->substr(4, length));
      jpeg_ = payload->substr(4 + length);
      if (json["type"] == type) return json;
    }
    return std::nullopt;
  }
  /// Behind the JSON of the newest packet.
  [[nodiscard]] const std::string& jpeg() const { return jpeg_; }
  [[nodiscard]] bool is_connected() const { return connected_; }
  /// Whether the server ends the connection within `timeout_ms`.
  bool is_ended(int timeout_ms = kPatience_ms) {
    while (read_some(timeout_ms)) {
    }
    return ended_;
  }

 private:
  bool read_some(int timeout_ms) {
    pollfd wait{fd_, POLLIN, 0};
    if (fd_ < 0 || ::poll(&wait, 1, timeout_ms) <= 0) return false;
    std::vector<char> bytes(1 << 16);
    const ssize_t got = ::recv(fd_, bytes.data(), bytes.size(), 0);
    ended_ = got <= 0;
    if (got > 0) buffer_.append(bytes.data(), static_cast<std::size_t>(got));
    return got > 0;
  }
  std::string read_head() {
    std::size_t end = 0;
    while ((end = buffer_.find("\r\n\r\n")) == std::string::npos)
      if (!read_some(kPatience_ms)) return std::exchange(buffer_, {});
    std::string head = buffer_.substr(0, end);
    buffer_.erase(0, end + 4);
    return head;
  }
  /// Length of the payload, and of the head in front of it.
  std::size_t frame_bytes(std::size_t* head) const {
    const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(buffer_[i]); };
    std::size_t size = byte(1) & 0x7FU;
    const std::size_t extra = size == 127 ? 8 : size == 126 ? 2 : 0;
    *head = 2 + extra;
    if (extra == 0) return size;
    if (buffer_.size() < *head) return SIZE_MAX / 2;
    size = 0;
    for (std::size_t i = 0; i < extra; ++i) size = size << 8U | byte(2 + i);
    return size;
  }
  bool whole_frame(std::size_t* head) const {
    return buffer_.size() >= 2 && frame_bytes(head) + *head <= buffer_.size();
  }

  int fd_;
  bool connected_ = false;
  bool ended_ = false;
  std::string host_;
  std::string buffer_;
  std::string jpeg_;
};

}  // namespace plumb::test
