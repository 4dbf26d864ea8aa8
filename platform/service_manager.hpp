/// Tells systemd, or whoever speaks its protocol, how this process is: sd_notify(3) without its
/// library.
///
/// Waiting:
///   Nothing here waits. A message that the manager's socket does not take at once is lost.
/// Memory:
///   Nothing is allocated; a text is cut at 200 characters.
#pragma once

#include <sys/socket.h>
#include <sys/un.h>

#include "platform/udpm/file_descriptor.hpp"

namespace plumb {

class ServiceManager {
 public:
  /// Uses the socket that $NOTIFY_SOCKET names. Without one all functions do nothing.
  ServiceManager();

  [[nodiscard]] bool is_there() const { return socket_.get() >= 0; }
  /// It serves from now on. `status` is shown by systemctl.
  void ready(const char* status);
  /// All is as it should be: the watchdog waits anew.
  void alive(const char* status);
  /// It runs, but the watchdog keeps waiting.
  void show(const char* status);
  void stopping(const char* status);

 private:
  void tell(const char* what, const char* status);

  FileDescriptor socket_;
  sockaddr_un address_{};
  socklen_t address_bytes_ = 0;
};

}  // namespace plumb
