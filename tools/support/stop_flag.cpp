#include "tools/support/stop_flag.hpp"

#include <csignal>

namespace plumb {
namespace {

volatile std::sig_atomic_t stop_flag = 0;

extern "C" void on_stop(int /*signal*/) { stop_flag = 1; }

}  // namespace

void catch_stop_signals() {
  struct sigaction action {};
  action.sa_handler = on_stop;
  action.sa_flags = SA_RESETHAND;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

bool stop_requested() { return stop_flag != 0; }

}  // namespace plumb
