#include "platform/process.hpp"

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <deque>
#include <optional>
#include <utility>

#include "platform/clock.hpp"
#include "platform/command_line.hpp"
#include "platform/exit_code.hpp"
#include "platform/log.hpp"
#include "platform/output_watch.hpp"
#include "platform/realtime.hpp"
#include "platform/service_manager.hpp"
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
        health(process_info.name),
        output(process_info.is_cyclic) {}

  ProcessInfo info;
  std::string program;
  std::int64_t session = realtime_us();
  CommandLine app;
  std::string url;
  std::vector<std::string> config_paths;
  RealtimeRequest realtime;
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
  ServiceManager manager;
  OutputWatch output;
  std::optional<EventLoop> loop;
  std::optional<Bus> bus;
  bool is_ready = false;

  void report(Publisher<process_health_t>& publisher);
};

Process::Process(const ProcessInfo& info) : impl_(std::make_unique<Impl>(info)) {
  block_stop_signals();           // the loop receives a signal that arrives before its construction
  std::signal(SIGPIPE, SIG_IGN);  // a reader of stderr that goes away ends nothing
  std::signal(SIGHUP, SIG_IGN);   // nor does a terminal
  set_log_name(impl_->program.c_str());
  CommandLine& app = impl_->app;
  app.add_option("--lcm-url", impl_->url,
                 "LCM network; default $LCM_DEFAULT_URL, else this machine");
  app.add_option("--config", impl_->config_paths,
                 "TOML file; every key is optional. Given again, its keys replace earlier ones")
      .one_each();
  app.add_flag("--print-config", impl_->print_config,
               "print every setting with its range and the value it would have, then exit");
  app.add_flag("--lock-memory", impl_->realtime.lock_memory,
               "keep everything in RAM, taken before the first message");
  app.add_option("--priority", impl_->realtime.priority,
                 "real-time priority (SCHED_FIFO); default: the ordinary scheduler")
      .check(within(1, 99));
  app.add_option("--cpus", impl_->realtime.cpus, "CPUs to run on, as 2,3")
      .one_each()
      .delimiter(',')
      .check(within(0, 1023));
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

const std::vector<std::string>& Process::config_paths() const { return impl_->config_paths; }

std::string Process::config_path_of(const char* key) const {
  const std::vector<std::string>& paths = impl_->config_paths;
  const auto last = std::find_if(paths.rbegin(), paths.rend(), [key](const std::string& path) {
    return ConfigFile::load(path).has(key);
  });
  return last == paths.rend() ? std::string() : *last;
}

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
    for (const std::string& path : impl_->config_paths) config.read(path);
    if (!impl_->config_paths.empty()) config.judge(impl_->config_paths.back());
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
    log_error("%s", error.what());
    return kExitRefused;
  } catch (const InputError& error) {
    log_error("%s", error.what());
    return kExitRefused;
  } catch (const std::exception& error) {
    log_error("%s", error.what());
    return kExitMachine;
  }
}

/// Publishes the health, and tells the service manager of it.
void Process::Impl::report(Publisher<process_health_t>& publisher) {
  const std::int64_t now_us = monotonic_us();
  const process_health_t& message = health.report(now_us, counters, *bus, timer);
  publisher.publish(message);
  const char* status = message.state_reason.empty() ? "running" : message.state_reason.c_str();
  const bool is_well = output.judge(now_us, *bus, counters, health.is_output_excused());
  if (!is_ready) {
    manager.ready(status);  // nothing can have been published yet
    is_ready = true;
  } else if (is_well) {
    manager.alive(status);
  } else {
    manager.show("there is no output, though there should be");
  }
}

void Process::serve(const std::function<void()>& setup) {
  Impl& p = *impl_;
  const auto warn = [](const std::vector<std::string>& sentences) {
    for (const std::string& sentence : sentences) log_warning("%s", sentence.c_str());
  };
  warn(prepare_realtime(p.realtime));
  p.loop.emplace();
  p.bus.emplace(p.url, &p.counters);
  Counters health_counters;  // health messages do not count as output of the process
  Publisher<process_health_t> publisher(*p.bus, p.info.health, Health::kMaxBytes, &health_counters);
  setup();
  if (!p.bus->subscribers().empty()) {
    p.loop->watch(p.bus->fileno(), [&p] { p.bus->handle(); });
  }
  p.loop->every(kHealthPeriod_us, [&p, &publisher] { p.report(publisher); });
  warn(enter_realtime(p.realtime));
  p.report(publisher);
  p.loop->run();

  const int signal = p.loop->stop_signal();
  const char* reason = signal == SIGINT ? "SIGINT" : signal == SIGTERM ? "SIGTERM" : "done";
  publisher.publish(p.health.report_stopping(monotonic_us(), reason));
  p.manager.stopping(reason);
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
