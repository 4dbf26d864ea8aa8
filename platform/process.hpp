/// What every plumb-* process shares: options, configuration, signals, health, exit codes.
///
/// Use      construct first thing in main; declare_options(); run(), whose setup makes the endpoints.
/// Signals  SIGINT and SIGTERM are held from construction on and end run() in order.
/// Exit     0 after --help, --version, --print-config, SIGINT and SIGTERM; 2 for an option, key,
/// value or file that
///          is refused, with one sentence; 1 when the machine fails us (no network, no
///          descriptors).
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "core/channels.hpp"
#include "core/counters.hpp"
#include "core/input_error.hpp"
#include "platform/bus.hpp"
#include "platform/config.hpp"
#include "platform/event_loop.hpp"
#include "platform/health.hpp"
#include "platform/stage_timer.hpp"

namespace CLI {  // NOLINT(readability-identifier-naming): a library's name
class App;
}

namespace plumb {

/// Options that a program refuses. Process turns it, as any InputError, into one line and exit code 2.
class UsageError : public InputError {
 public:
  using InputError::InputError;
};

struct ProcessInfo {
  const char* name;       ///< "vo": the program is plumb-vo
  const char* summary;    ///< for --help
  const Channel& health;  ///< where process_health_t goes
};

class Process {
 public:
  static constexpr std::int64_t kHealthPeriod_us = 500'000;

  explicit Process(const ProcessInfo& info);
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  /// Options of this program's own; `declare` needs <CLI/CLI.hpp> and runs within run().
  void declare_options(std::function<void(CLI::App&)> declare);

  /// A flag that, like --print-config, prints a text made from the configuration and ends the
  /// program. `text` may throw InputError.
  void declare_print(const char* flag, const char* help, std::function<std::string()> text);

  /// Everything after the options: reads them, fills `config`, joins LCM, calls `setup` (which
  /// creates the endpoints) and serves until a stop signal. Returns the exit code; prints what is
  /// wrong.
  template <typename Config>
  int run(int argc, char** argv, Config* config, const std::function<void()>& setup) {
    return run_bound(argc, argv,
                     {[config](const std::string& path) { load_config(path, config); },
                      [config] { return render_config(*config); }},
                     setup);
  }

  // Inside setup and callbacks:
  [[nodiscard]] const std::string& config_path() const;  ///< as given; empty for none
  [[nodiscard]] Bus& bus();
  [[nodiscard]] EventLoop& loop();
  [[nodiscard]] Health& health();
  [[nodiscard]] Counters& counters();
  [[nodiscard]] StageTimer& timer();

 private:
  struct ConfigBinding {
    std::function<void(const std::string& path)> load;
    std::function<std::string()> render;
  };
  int run_bound(int argc, char** argv, const ConfigBinding& config,
                const std::function<void()>& setup);
  void serve(const std::function<void()>& setup);

  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Parses the command line of any plumb-* program. Returns the exit code when the program is done
/// (--help, --version, a refused option), -1 when it is to go on. `program` as printed before the
/// sentence.
[[nodiscard]] int parse_command_line(CLI::App& app, const char* program, int argc, char** argv);

}  // namespace plumb
