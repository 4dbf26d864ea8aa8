// Tests plumb-status as a program, on a network of its own.
#include <gtest/gtest.h>

#include "platform/bus.hpp"
#include "platform/clock.hpp"
#include "platform/health.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/private_network.hpp"

namespace plumb {
namespace {

TEST(PlumbStatus, ItsExitCodeSaysWhetherTheChainIsWell) {
  if (!test::enter_private_network()) GTEST_SKIP() << test::kNoPrivateNetwork;
  Counters counters;
  Bus bus("", &counters);
  Publisher<process_health_t> out(bus, kHealthVo, Health::kMaxBytes);
  process_health_t running{};
  running.process = "vo";
  test::ChildProcess well({"plumb-status", "--need", "vo", "--listen", "0.8"});
  test::ChildProcess ill({"plumb-status", "--need", "vo,can", "--listen", "0.8"});
  while (well.wait(0.05) < 0) out.publish(running);
  EXPECT_EQ(0, well.wait()) << well.output();
  EXPECT_EQ(3, ill.wait()) << ill.output();
  EXPECT_NE(std::string::npos, ill.output().find("NOT WELL: can\n")) << ill.output();
}

TEST(PlumbStatus, NamesTheNearestProcess) {
  test::ChildProcess child({"plumb-status", "--need", "cann"});
  EXPECT_EQ(2, child.wait());
  EXPECT_NE(std::string::npos, child.output().find("did you mean can?")) << child.output();
}

}  // namespace
}  // namespace plumb
