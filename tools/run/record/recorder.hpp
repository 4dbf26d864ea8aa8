/// Receives messages from an LCM network and records them, and counts what was lost on the way.
///
/// Threads:
///   run() receives in its own thread and writes in the caller's.
/// Memory:
///   All of it is taken in the constructor: slots for the messages of each channel, and a ring that
///   holds what the disk has not taken yet.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "platform/udpm/udpm_receiver.hpp"
#include "tools/run/record/message_ring.hpp"
#include "tools/run/record/recording.hpp"

namespace plumb {

/// Every channel of core/channels.hpp.
[[nodiscard]] const std::vector<std::string>& plumbline_channels();

/// Counts gaps in the numbers of images. A source that starts anew begins a new count.
class ImageCount {
 public:
  void take(std::int64_t session, std::int64_t seq);
  [[nodiscard]] std::int64_t num_images() const { return num_images_; }
  [[nodiscard]] std::int64_t num_lost() const { return num_lost_; }

 private:
  std::int64_t session_ = 0;
  std::int64_t last_seq_ = 0;
  std::int64_t num_images_ = 0;
  std::int64_t num_lost_ = 0;
};

struct RecorderOptions {
  std::vector<std::string> channels;
  std::size_t max_message_bytes = 0;
  std::size_t ring_bytes = 0;
  std::int64_t duration_us = 0;  ///< 0: until it is stopped
};

struct RecorderReport {
  ImageCount images;
  std::vector<std::int64_t> num_per_channel;  ///< in the order of the options
  std::int64_t num_overflowed = 0;            ///< packets for which the kernel had no room
  std::int64_t num_incomplete = 0;            ///< messages whose packets did not all arrive
  std::int64_t num_too_large = 0;             ///< messages larger than max_message_bytes
  std::size_t ring_peak_bytes = 0;
  const char* ended = nullptr;  ///< why the recording ended by itself; null when it was stopped
};

class Recorder {
 public:
  using Progress = std::function<void(const RecorderReport&)>;

  /// Joins the network. Throws UdpmError, and std::system_error when there are no descriptors left.
  Recorder(const UdpmUrl& url, RecorderOptions options);

  /// Records until stop_requested(), the duration or a limit of the recording. `progress`, which
  /// may be empty, is called a few times a second. Throws LogError.
  RecorderReport run(Recording* recording, const Progress& progress);

  [[nodiscard]] int receive_buffer_bytes() const { return receiver_.receive_buffer_bytes(); }

 private:
  void receive();

  RecorderOptions options_;
  MessageRing ring_;
  UdpmReceiver receiver_;
};

}  // namespace plumb
