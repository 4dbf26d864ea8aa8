#include "platform/service_manager.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "tests/support/notify_socket.hpp"
#include "tests/support/temp_folder.hpp"

namespace plumb {
namespace {

TEST(ServiceManager, IsToldInItsOwnWords) {
  const test::TempFile path(".socket", "");
  std::filesystem::remove(path.path());
  using test::NotifySocket;
  for (const std::string& name : {path.path(), "@plumb-test-" + std::to_string(::getpid())}) {
    NotifySocket manager(name);
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
