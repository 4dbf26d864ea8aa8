/// The shell of every plumb-* process: options, configuration, signals, health and exit codes.
///
/// Use:
///   Construct the Process first in main(), call declare_options(), then call run(), whose `setup`
///   creates the endpoints.
/// Threads:
///   Everything runs in the thread that calls run(), callbacks included.
/// Signals:
///   SIGINT and SIGTERM are blocked from construction on, and they end run() normally. SIGHUP is
///   ignored: a terminal that closes does not end a process of the vehicle.
/// Supervision:
///   With $NOTIFY_SOCKET the process tells systemd when it serves, how it is, and that its output
///   is what it should be (output_watch.hpp).
/// Errors:
///   run() prints one sentence and returns the exit code. 0 follows --help, --version,
///   --print-config, SIGINT and SIGTERM. 2 follows a refused option, key, value or file. 1 follows
///   a failure of the machine, such as a missing network.
/// Memory:
///   `setup` may allocate. The shell allocates nothing after it. With --lock-memory everything is
///   touched and locked after `setup`.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/channels.hpp"
#include "core/counters.hpp"
#include "core/input_error.hpp"
#include "platform/bus.hpp"
#include "platform/command_line.hpp"
#include "platform/config.hpp"
#include "platform/event_loop.hpp"
#include "platform/health.hpp"
#include "platform/stage_timer.hpp"

namespace CLI {  // NOLINT(readability-identifier-naming): a library's name
class App;
}

namespace plumb {

/// The exception for refused options. Like every InputError it leads to one line and exit code 2.
class UsageError : public InputError {
 public:
  using InputError::InputError;
};

struct ProcessInfo {
  const char* name;        ///< "vo" when the program is plumb-vo
  const char* summary;     ///< sentence for --help
  const Channel& health;   ///< channel of its process_health_t
  bool is_cyclic = false;  ///< it publishes whether or not anything arrives
};

class Process {
 public:
  static constexpr std::int64_t kHealthPeriod_us = 500'000;

  explicit Process(const ProcessInfo& info);
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  /// Adds options of this program. `declare` runs within run().
  void declare_options(std::function<void(CommandLine&)> declare);

  /// Adds a flag that, like --print-config, prints a text made from the configuration and ends the
  /// program. Of several the one declared first is printed. `text` may throw InputError.
  void declare_print(const char* flag, const char* help, std::function<std::string()> text);

  /// Parses the options, fills `config`, joins the LCM network, calls `setup` and serves until a
  /// stop signal. Returns the exit code.
  template <typename Config>
  int run(int argc, char** argv, Config* config, const std::function<void()>& setup) {
    return run_bound(argc, argv,
                     {[config](const std::string& path) { read_config(path, config); },
                      [config](const std::string& last) { refuse_contradiction(last, *config); },
                      [config] { return render_config(*config); }},
                     setup);
  }

  // The following are valid inside `setup` and in callbacks.
  /// The files of --config, in their order: later ones replace values of earlier ones.
  [[nodiscard]] const std::vector<std::string>& config_paths() const;
  /// The last of them that has a dotted key; empty when none has.
  [[nodiscard]] std::string config_path_of(const char* key) const;
  /// [us] Calendar time at which the process started: names this run in the messages it sends.
  [[nodiscard]] std::int64_t session() const;
  [[nodiscard]] Bus& bus();
  [[nodiscard]] EventLoop& loop();
  [[nodiscard]] Health& health();
  [[nodiscard]] Counters& counters();
  [[nodiscard]] StageTimer& timer();

 private:
  struct ConfigBinding {
    std::function<void(const std::string& path)> read;
    std::function<void(const std::string& last_path)> judge;  ///< what all files together say
    std::function<std::string()> render;
  };
  int run_bound(int argc, char** argv, const ConfigBinding& config,
                const std::function<void()>& setup);
  void serve(const std::function<void()>& setup);

  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace plumb
