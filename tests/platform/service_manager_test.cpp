#include "platform/service_manager.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>

#include "tests/support/temp_folder.hpp"

namespace plumb {
namespace {

/// The manager's end of the socket.
class Manager {
 public:
  /// A `name` that begins with @ is outside the file system.
  explicit Manager(const std::string& name) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::memcpy(address.sun_path, name.data(), name.size());
    if (name[0] == '@') address.sun_path[0] = '\0';
    socket_ = FileDescriptor(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
    const auto bytes = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name.size());
    EXPECT_EQ(0, ::bind(socket_.get(), reinterpret_cast<const sockaddr*>(&address), bytes));
    ::setenv("NOTIFY_SOCKET", name.c_str(), 1);
  }
  ~Manager() { ::unsetenv("NOTIFY_SOCKET"); }
  Manager(const Manager&) = delete;
  Manager& operator=(const Manager&) = delete;

  std::string heard() {
    std::array<char, 512> text{};
    const ssize_t n = ::recv(socket_.get(), text.data(), text.size(), 0);
    return n > 0 ? std::string(text.data(), static_cast<std::size_t>(n)) : "";
  }

 private:
  FileDescriptor socket_;
};

TEST(ServiceManager, IsToldInItsOwnWords) {
  const test::TempFile path(".socket", "");
  std::filesystem::remove(path.path());
  for (const std::string& name : {path.path(), "@plumb-test-" + std::to_string(::getpid())}) {
    Manager manager(name);
    ServiceManager client;
    ASSERT_TRUE(client.is_there());
    client.ready("running");
    EXPECT_EQ("READY=1\nWATCHDOG=1\nSTATUS=running\n", manager.heard());
    client.alive("no CAMERA for 1.5 s");
    EXPECT_EQ("WATCHDOG=1\nSTATUS=no CAMERA for 1.5 s\n", manager.heard());
    client.show("no output");
    EXPECT_EQ("STATUS=no output\n", manager.heard());
    client.stopping(std::string(1000, 'x').c_str());
    EXPECT_EQ("STOPPING=1\nSTATUS=" + std::string(200, 'x') + "\n", manager.heard());
  }
}

TEST(ServiceManager, MayBeAbsentOrGone) {
  ::unsetenv("NOTIFY_SOCKET");
  ServiceManager nobody;
  EXPECT_FALSE(nobody.is_there());
  nobody.ready("running");
  ::setenv("NOTIFY_SOCKET", "relative/path", 1);
  EXPECT_FALSE(ServiceManager().is_there());
  ::setenv("NOTIFY_SOCKET", ("/" + std::string(200, 'x')).c_str(), 1);
  EXPECT_FALSE(ServiceManager().is_there());
  ::setenv("NOTIFY_SOCKET", "/nonexistent/notify", 1);
  ServiceManager gone;
  gone.ready("running");
  ::unsetenv("NOTIFY_SOCKET");
}

}  // namespace
}  // namespace plumb
