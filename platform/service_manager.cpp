#include "platform/service_manager.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace plumb {

ServiceManager::ServiceManager() {
  const char* path = std::getenv("NOTIFY_SOCKET");
  if (path == nullptr || (path[0] != '/' && path[0] != '@')) return;
  const std::size_t length = std::strlen(path);
  if (length >= sizeof address_.sun_path) return;
  address_.sun_family = AF_UNIX;
  std::memcpy(address_.sun_path, path, length);
  if (path[0] == '@') address_.sun_path[0] = '\0';  // a name outside the file system
  address_bytes_ = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + length);
  socket_ = FileDescriptor(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
}

void ServiceManager::ready(const char* status) { tell("READY=1\nWATCHDOG=1\n", status); }
void ServiceManager::alive(const char* status) { tell("WATCHDOG=1\n", status); }
void ServiceManager::show(const char* status) { tell("", status); }
void ServiceManager::stopping(const char* status) { tell("STOPPING=1\n", status); }

void ServiceManager::tell(const char* what, const char* status) {
  if (!is_there()) return;
  std::array<char, 256> text{};
  const int size = std::snprintf(text.data(), text.size(), "%sSTATUS=%.200s\n", what, status);
  const auto bytes = std::min(static_cast<std::size_t>(size), text.size() - 1);
  (void)::sendto(socket_.get(), text.data(), bytes, MSG_NOSIGNAL,
                 reinterpret_cast<const sockaddr*>(&address_), address_bytes_);
}

}  // namespace plumb
