/// plumb-status: prints the health of the chain in one screen and says by its exit code whether all
/// is well.
#include <cstdio>
#include <exception>
#include <memory>
#include <string>
#include <vector>

#include "platform/bus.hpp"
#include "platform/clock.hpp"
#include "platform/command_line.hpp"
#include "platform/exit_code.hpp"
#include "tools/status/status_board.hpp"

namespace {

constexpr int kExitNotWell = 3;
constexpr const char* kFooter =
    R"(Exit code: 0 when all processes of --need run, 3 when one is silent, waits or is degraded, 2 for a wrong
option, 1 when the network cannot be used.

Examples
  plumb-status
  plumb-status --need vo,ground,can || systemctl restart plumbline.target)";

struct Arguments {
  std::string url;
  std::vector<std::string> needed = {"camera", "vo", "ground", "can"};
  double listen_s = 1.2;
};

std::vector<std::string> process_names() {
  std::vector<std::string> names;
  for (const plumb::Channel* channel : plumb::StatusBoard::kProcesses)
    names.emplace_back(channel->publisher);
  return names;
}

void add_options(plumb::CommandLine* app, Arguments* arguments) {
  app->footer(kFooter);
  app->add_option("--lcm-url", arguments->url,
                  "LCM network; default $LCM_DEFAULT_URL, else this machine");
  app->add_option("--need", arguments->needed, "processes that have to run")
      .one_each()
      .delimiter(',')
      .check(plumb::one_of(process_names()))
      .capture_default_str();
  app->add_option("--listen", arguments->listen_s, "seconds to listen; health comes twice a second")
      .check(plumb::within(0.1, 60.0))
      .capture_default_str();
}

int show(const Arguments& arguments) {
  plumb::Counters counters;
  plumb::Bus bus(arguments.url, &counters);
  plumb::StatusBoard board(arguments.needed);
  const auto keep = [&board](const auto& message) -> const char* {
    board.take(message, plumb::monotonic_us());
    return nullptr;
  };
  std::vector<std::unique_ptr<plumb::Subscriber<plumb::process_health_t>>> health;
  for (const plumb::Channel* channel : plumb::StatusBoard::kProcesses) {
    health.push_back(std::make_unique<plumb::Subscriber<plumb::process_health_t>>(
        bus, *channel, plumb::Input::kOccasional, keep));
  }
  const plumb::Subscriber<plumb::ego_motion_t> motion(bus, plumb::kEgoMotion,
                                                      plumb::Input::kOccasional, keep);
  const std::int64_t end_us =
      plumb::monotonic_us() + static_cast<std::int64_t>(arguments.listen_s * 1e6);
  while (plumb::monotonic_us() < end_us) bus.handle(20);
  const std::int64_t now_us = plumb::monotonic_us();
  std::fputs(board.text(now_us).c_str(), stdout);
  return board.is_well(now_us) ? 0 : kExitNotWell;
}

}  // namespace

int main(int argc, char** argv) {
  plumb::CommandLine app("Health of the chain in one screen.", "plumb-status");
  Arguments arguments;
  add_options(&app, &arguments);
  const int done = app.parse(argc, argv);
  if (done >= 0) return done;
  try {
    return show(arguments);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "plumb-status: %s\n", error.what());
    return plumb::kExitMachine;
  }
}
