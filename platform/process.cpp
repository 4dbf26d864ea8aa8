#include "platform/process.hpp"

#include <array>
#include <csignal>
#include <cstdio>
#include <deque>
#include <optional>
#include <utility>

#include "platform/clock.hpp"
#include "platform/command_line.hpp"
#include "platform/exit_code.hpp"
#include "platform/log.hpp"
#include "platform/udpm/udpm_url.hpp"

namespace plumb {
namespace {

void check_url(const std::string& url) {
  if (url.empty() || url.rfind("memq://", 0) == 0) return;
  if (url.rfind("udpm://", 0) != 0)
    throw UsageError("--lcm-url " + url + " begins with neither udpm:// nor memq://");
  try {
    (void)parse_udpm_url(url);
  } catch (const UdpmError& error) {
    throw UsageError(error.what());
  }
}

}  // namespace

struct Process::Impl {
  explicit Impl(const ProcessInfo& process_info)
      : info(process_info),
        program(std::string("plumb-") + process_info.name),
        app(process_info.summary, program),
        health(process_info.name) {}

  ProcessInfo info;
  std::string program;
  std::int64_t session = realtime_us();
  CommandLine app;
  std::string url;
  std::string config_path;
  bool print_config = false;
  struct Print {
    bool asked = false;
    std::function<std::string()> text;
  };
  std::deque<Print> prints;  ///< whose flags stay where they are
  std::function<void(CommandLine&)> declare;
  Counters counters;
  StageTimer timer;
  Health health;
  std::optional<EventLoop> loop;
  std::optional<Bus> bus;
};

Process::Process(const ProcessInfo& info) : impl_(std::make_unique<Impl>(info)) {
  block_stop_signals();           // the loop receives a signal that arrives before its construction
  std::signal(SIGPIPE, SIG_IGN);  // a reader of stderr that goes away ends nothing
  set_log_name(impl_->program.c_str());
  CommandLine& app = impl_->app;
  app.add_option("--lcm-url", impl_->url,
                 "LCM network; default $LCM_DEFAULT_URL, else this machine");
  app.add_option("--config", impl_->config_path, "TOML file; every key is optional");
  app.add_flag("--print-config", impl_->print_config,
               "print every setting with its range and the value it would have, then exit");
}

Process::~Process() = default;

void Process::declare_options(std::function<void(CommandLine&)> declare) {
  impl_->declare = std::move(declare);
}

void Process::declare_print(const char* flag, const char* help, std::function<std::string()> text) {
  Impl::Print& print = impl_->prints.emplace_back();
  print.text = std::move(text);
  impl_->app.add_flag(flag, print.asked, help);
}

const std::string& Process::config_path() const { return impl_->config_path; }
std::int64_t Process::session() const { return impl_->session; }
Bus& Process::bus() { return *impl_->bus; }
EventLoop& Process::loop() { return *impl_->loop; }
Health& Process::health() { return impl_->health; }
Counters& Process::counters() { return impl_->counters; }
StageTimer& Process::timer() { return impl_->timer; }

int Process::run_bound(int argc, char** argv, const ConfigBinding& config,
                       const std::function<void()>& setup) {
  try {
    if (impl_->declare) impl_->declare(impl_->app);
    const int done = impl_->app.parse(argc, argv);
    if (done >= 0) return done;
    check_url(impl_->url);
    config.load(impl_->config_path);
    const auto print = [](const std::string& text) {
      std::fputs(text.c_str(), stdout);
      return std::fflush(stdout) == 0 ? kExitOk : kExitMachine;
    };
    if (impl_->print_config) return print(config.render());
    for (const Impl::Print& wanted : impl_->prints) {
      if (wanted.asked) return print(wanted.text());
    }
    serve(setup);
    return kExitOk;
  } catch (const ConfigError& error) {
    log_line("%s", error.what());
    return kExitRefused;
  } catch (const InputError& error) {
    log_line("%s", error.what());
    return kExitRefused;
  } catch (const std::exception& error) {
    log_line("%s", error.what());
    return kExitMachine;
  }
}

void Process::serve(const std::function<void()>& setup) {
  Impl& p = *impl_;
  p.loop.emplace();
  p.bus.emplace(p.url, &p.counters);
  Counters health_counters;  // health messages do not count as output of the process
  Publisher<process_health_t> publisher(*p.bus, p.info.health, Health::kMaxBytes, &health_counters);
  setup();
  if (!p.bus->subscribers().empty()) {
    p.loop->watch(p.bus->fileno(), [&p] { p.bus->handle(); });
  }
  const auto report = [&p, &publisher] {
    publisher.publish(p.health.report(monotonic_us(), p.counters, *p.bus, p.timer));
  };
  p.loop->every(kHealthPeriod_us, report);
  report();
  p.loop->run();

  const int signal = p.loop->stop_signal();
  publisher.publish(p.health.report_stopping(monotonic_us(), signal == SIGINT    ? "SIGINT"
                                                             : signal == SIGTERM ? "SIGTERM"
                                                                                 : "done"));
  const Counters& c = p.counters;
  log_line(
      "stopped; received %lld, rejected %lld, lost %lld, late %lld, skipped %lld, unpaired %lld, "
      "published %lld, unsent %lld",
      static_cast<long long>(c.num_received), static_cast<long long>(c.num_rejected),
      static_cast<long long>(c.num_dropped), static_cast<long long>(c.num_late),
      static_cast<long long>(c.num_skipped), static_cast<long long>(c.num_unpaired),
      static_cast<long long>(c.num_published), static_cast<long long>(c.num_unsent));
}

}  // namespace plumb
