/// plumb-record: records the messages of an LCM network without losing images.

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include "core/input_error.hpp"
#include "modules/datasets/text.hpp"
#include "platform/bus.hpp"
#include "platform/command_line.hpp"
#include "platform/log.hpp"
#include "platform/nearest_word.hpp"
#include "tools/run/record/recorder.hpp"
#include "tools/support/stop_flag.hpp"
#include "tools/support/tool_main.hpp"

namespace plumb {
namespace {

constexpr const char* kRecordFooter =
    R"(Without --channels, every channel of Plumbline is recorded. --split-mb and --split-s cut the recording into parts:
drive.lcm becomes drive_0000.lcm, drive_0001.lcm and so on, each with the calibration of the camera at its head, so that
each can be replayed. With them --keep-mb deletes the oldest parts, and without them it ends the recording.

At its end, plumb-record says how many images are missing by their numbers; the exit code is 1 when any is.

Examples
  plumb-record drive.lcm
  plumb-record drive.lcm --channels CAMERA,CAMERA_CALIBRATION,DETECTIONS --duration 60
  plumb-record ring.lcm --split-s 60 --keep-mb 20000)";

constexpr int kBufferBytes = 64 << 20;  ///< that is asked of the kernel
constexpr double kMegabyte = 1e6;

struct RecordArguments {
  std::filesystem::path out;
  std::string url;
  std::vector<std::string> channels;
  double split_mb = 0.0, split_s = 0.0, keep_mb = 0.0, free_mb = 500.0, duration_s = 0.0;
  double buffer_mb = 64.0, largest_mb = 9.0;
  bool force = false;
};

std::int64_t bytes_of(double megabytes) { return static_cast<std::int64_t>(kMegabyte * megabytes); }
std::int64_t microseconds(double seconds) { return static_cast<std::int64_t>(1e6 * seconds); }

UdpmUrl url_of(const RecordArguments& arguments) {
  UdpmUrl url = parse_udpm_url(lcm_url(arguments.url));
  if (url.receive_buffer_bytes == 0) url.receive_buffer_bytes = kBufferBytes;
  return url;
}

/// A misspelt channel would be an empty one.
void warn_of_strangers(const std::vector<std::string>& channels) {
  const std::vector<std::string>& known = plumbline_channels();
  for (const std::string& channel : channels) {
    if (std::find(known.begin(), known.end(), channel) != known.end()) continue;
    log_line("warning: %s is no channel of Plumbline%s", channel.c_str(),
             did_you_mean(channel, known).c_str());
  }
}

std::string counts_text(const RecorderReport& report) {
  return format("%lld images, %lld lost", static_cast<long long>(report.images.num_images()),
                static_cast<long long>(report.images.num_lost()));
}

void print_report(const RecordArguments& arguments, const Recording& recording,
                  const RecorderReport& report) {
  std::cout << format("%s: %s; %lld messages, %.1f MB in %lld %s\n", arguments.out.c_str(),
                      counts_text(report).c_str(), static_cast<long long>(recording.num_messages()),
                      static_cast<double>(recording.num_bytes()) / kMegabyte,
                      static_cast<long long>(recording.num_parts()),
                      recording.num_parts() == 1 ? "part" : "parts");
  for (std::size_t i = 0; i < arguments.channels.size(); ++i) {
    if (report.num_per_channel[i] > 0) {
      std::cout << format("  %-20s %lld\n", arguments.channels[i].c_str(),
                          static_cast<long long>(report.num_per_channel[i]));
    }
  }
  std::cout << format("  at most %.1f MB waited for the disk\n",
                      static_cast<double>(report.ring_peak_bytes) / kMegabyte);
  if (recording.num_deleted() > 0) {
    std::cout << format("  %lld parts deleted to keep within --keep-mb\n",
                        static_cast<long long>(recording.num_deleted()));
  }
  std::cout.flush();
  if (report.ended != nullptr) log_line("ended early: %s", report.ended);
  if (report.num_overflowed > 0) {
    log_line("the kernel had no room for %lld packets: run sysctl -w net.core.rmem_max=%d",
             static_cast<long long>(report.num_overflowed), kBufferBytes);
  }
  if (report.num_incomplete > 0)
    log_line("%lld messages arrived in part", static_cast<long long>(report.num_incomplete));
  if (report.num_too_large > 0)
    log_line("messages larger than --largest-mb were left out: %lld packets",
             static_cast<long long>(report.num_too_large));
}

void refuse_existing(const RecordArguments& arguments, const RecordingLimits& limits) {
  const std::filesystem::path first = Recording::first_part(arguments.out, limits);
  if (!arguments.force && std::filesystem::exists(first))
    throw InputError(first.string() + " exists; --force overwrites it");
  if (limits.keep_bytes > 0 && limits.split_bytes > limits.keep_bytes / 2)
    throw InputError("--keep-mb holds fewer than two parts of --split-mb");
}

int run(RecordArguments* arguments) {
  if (arguments->channels.empty()) arguments->channels = plumbline_channels();
  warn_of_strangers(arguments->channels);
  const RecordingLimits limits{bytes_of(arguments->split_mb), microseconds(arguments->split_s),
                               bytes_of(arguments->keep_mb), bytes_of(arguments->free_mb)};
  refuse_existing(*arguments, limits);
  catch_stop_signals();
  Recorder recorder(url_of(*arguments),
                    {arguments->channels, static_cast<std::size_t>(bytes_of(arguments->largest_mb)),
                     static_cast<std::size_t>(
                         bytes_of(std::max(arguments->buffer_mb, 2.0 * arguments->largest_mb))),
                     microseconds(arguments->duration_s)});
  log_line("recording %zu channels to %s, receive buffer %.1f MB", arguments->channels.size(),
           Recording::first_part(arguments->out, limits).c_str(),
           static_cast<double>(recorder.receive_buffer_bytes()) / kMegabyte);
  if (recorder.receive_buffer_bytes() < kBufferBytes / 8)
    log_line("warning: images may be lost; run sysctl -w net.core.rmem_max=%d", kBufferBytes);
  Recording recording(arguments->out, limits);
  const bool is_terminal = isatty(STDERR_FILENO) == 1;
  const RecorderReport report = recorder.run(&recording, [&](const RecorderReport& now) {
    if (!is_terminal) return;
    std::cerr << format("\r%s, %.1f MB ", counts_text(now).c_str(),
                        static_cast<double>(recording.num_bytes()) / kMegabyte);
  });
  if (is_terminal) std::cerr << "\n";
  print_report(*arguments, recording, report);
  return report.images.num_lost() > 0 || report.ended != nullptr ? kExitMachine : 0;
}

void add_options(CommandLine* app, RecordArguments* arguments) {
  app->footer(kRecordFooter);
  app->add_option("LOG", arguments->out, "log to write").required();
  app->add_option("--channels", arguments->channels, "channels to record [all of Plumbline]")
      .delimiter(',');
  app->add_option("--lcm-url", arguments->url,
                  "LCM network [$LCM_DEFAULT_URL, else multicast on this machine]");
  app->add_option("--split-mb", arguments->split_mb, "begin a new part after so many MB")
      .check(at_least(1));
  app->add_option("--split-s", arguments->split_s, "begin a new part after so many seconds")
      .check(at_least(1));
  app->add_option("--keep-mb", arguments->keep_mb, "keep at most so many MB on the disk")
      .check(at_least(1));
  app->add_option("--free-mb", arguments->free_mb, "end when the disk has less than this free")
      .check(at_least(0))
      .capture_default_str();
  app->add_option("--duration", arguments->duration_s, "end after so many seconds")
      .check(at_least(0));
  app->add_option("--buffer-mb", arguments->buffer_mb, "memory for what the disk has not taken yet")
      .check(within(1, 100'000))
      .capture_default_str();
  app->add_option("--largest-mb", arguments->largest_mb, "size of the largest image")
      .check(within(0.1, 64))
      .capture_default_str();
  app->add_flag("--force", arguments->force, "overwrite a log that exists");
}

}  // namespace
}  // namespace plumb

int main(int argc, char** argv) {
  plumb::set_log_name("plumb-record");
  plumb::RecordArguments arguments;
  plumb::CommandLine app("Records the messages of an LCM network", "plumb-record");
  plumb::add_options(&app, &arguments);
  return plumb::tool_main(&app, argc, argv, [&] {
    try {
      return plumb::run(&arguments);
    } catch (const plumb::UdpmError& error) {
      plumb::log_line("%s", error.what());
      return plumb::kExitMachine;
    }
  });
}
