/// Receives the frames of one identifier from a CAN interface through SocketCAN.
///
/// The interface may be absent or down: it is tried again every second, and state() says why. Its
/// functions never block and never throw.
#pragma once

#include <cstdint>
#include <string>

#include "core/can_frame.hpp"

namespace plumb {

class CanReader {
 public:
  static constexpr std::int64_t kReopenUs = 1'000'000;

  /// Non-blocking socket for an interface, or -1 and one sentence why. Tests bring their own.
  using Opener = int (*)(const std::string& interface, std::string* why);

  CanReader(std::string interface, std::uint32_t id, bool extended);
  CanReader(std::string interface, std::uint32_t id, bool extended, Opener opener);
  ~CanReader();
  CanReader(const CanReader&) = delete;
  CanReader& operator=(const CanReader&) = delete;

  /// Opens the interface when it is time to.
  void service(std::int64_t now_us);
  /// Takes the next frame that waits. Returns false when there is none.
  [[nodiscard]] bool read(CanFrame* frame);

  [[nodiscard]] bool is_up() const { return fd_ >= 0; }
  /// One sentence; empty while all is well.
  [[nodiscard]] const std::string& state() const { return state_; }

 private:
  void go_down(int error_number);

  std::string interface_;
  std::uint32_t id_;
  bool extended_;
  Opener opener_;
  int fd_ = -1;
  std::int64_t next_open_us_ = INT64_MIN;
  std::string state_;
};

}  // namespace plumb
