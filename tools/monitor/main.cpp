/// plumb-monitor: shows a running chain, or a log, on a page in the browser.

#include <csignal>
#include <cstdio>
#include <memory>
#include <string>

#include "core/input_error.hpp"
#include "modules/datasets/text.hpp"
#include "platform/command_line.hpp"
#include "platform/config.hpp"
#include "platform/event_loop.hpp"
#include "platform/log.hpp"
#include "tools/monitor/live_monitor.hpp"
#include "tools/monitor/log_monitor.hpp"
#include "tools/monitor/page_files.hpp"
#include "tools/support/tool_main.hpp"

namespace plumb {
namespace {

constexpr const char* kFooter =
    R"(Without LOG it watches the chain that runs: it listens, and publishes nothing. With LOG it shows the results that
the log holds, or runs the chain on its images when it holds none. It shows nothing to other machines unless --bind
says so; whoever can reach the address can see the camera.

Examples
  plumb-monitor --interface can0
  plumb-monitor --lcm-url udpm://239.255.76.67:7667 --trace drive.can --port 8080
  plumb-monitor drive.lcm)";

struct Arguments {
  std::string log, config;
  LiveOptions live;
  WebAddress address;
  bool recompute = false;
};

void say_address(const WebServer& server, const Arguments& arguments) {
  const std::string& host =
      arguments.address.host == "0.0.0.0" ? "127.0.0.1" : arguments.address.host;
  std::printf("plumb-monitor: http://%s:%d\n", host.c_str(), server.port());
  std::fflush(stdout);
}

int watch_bus(const Arguments& arguments, const PlumbConfig& config) {
  block_stop_signals();  // before the server's thread starts
  EventLoop loop;
  LiveMonitor monitor(arguments.live, config);
  WebServer server(arguments.address, page_files(), &monitor);
  say_address(server, arguments);
  monitor.run(&loop, &server);
  return 0;
}

int show_log(const Arguments& arguments, const PlumbConfig& config) {
  block_stop_signals();
  EventLoop loop;
  LogMonitor monitor(arguments.log, config, arguments.recompute);
  WebServer server(arguments.address, page_files(), &monitor);
  say_address(server, arguments);
  bool stopped = false;
  monitor.run([&] { return stopped = stopped || !loop.step(0); }, [&] { server.notify(); });
  std::fputs(monitor.trouble().c_str(), stderr);
  if (!stopped) loop.run();
  return 0;
}

int run(const Arguments& arguments) {
  if (page_files().empty())
    throw InputError(
        "this program was built without its page, because npm could not fetch its packages");
  PlumbConfig config;
  load_config(arguments.config, &config);
  return arguments.log.empty() ? watch_bus(arguments, config) : show_log(arguments, config);
}

void add_options(CommandLine* app, Arguments* arguments) {
  app->footer(kFooter);
  const auto log = app->add_option("LOG", arguments->log, "LCM log to show in place of the bus");
  app->add_flag("--recompute", arguments->recompute,
                "run the chain on LOG although it holds results");
  app->add_option("--config", arguments->config, "TOML configuration, as for the chain");
  app->add_option("--lcm-url", arguments->live.lcm_url, "LCM network [$LCM_DEFAULT_URL]")
      .excludes(log);
  const auto interface =
      app->add_option("--interface", arguments->live.interface, "CAN interface to read")
          .excludes(log);
  app->add_option("--trace", arguments->live.trace, "trace that plumb-can writes, to read on")
      .excludes(log)
      .excludes(interface);
  app->add_option("--rate", arguments->live.rate_hz, "frames a second for a page")
      .check(within(0.5, 60.0))
      .capture_default_str();
  app->add_option("--bind", arguments->address.host, "IPv4 address to listen on")
      .capture_default_str();
  app->add_option("--port", arguments->address.port, "port to listen on; 0 takes a free one")
      .check(within(0, 65535))
      .capture_default_str();
  app->add_option("--listen-fd", arguments->address.listening_fd,
                  "socket that listens already, from the program that starts this one")
      .type_name("FD");
}

}  // namespace
}  // namespace plumb

int main(int argc, char** argv) {
  plumb::set_log_name("plumb-monitor");
  plumb::Arguments arguments;
  plumb::CommandLine app("Shows the chain, or a log, on a page in the browser", "plumb-monitor");
  plumb::add_options(&app, &arguments);
  return plumb::tool_main(&app, argc, argv, [&] { return plumb::run(arguments); });
}
