/// The results of a log, frame by frame, while they are being computed: written by one thread and
/// read by another.
///
/// Memory:
///   About 200 bytes a frame. The results themselves lie in a temporary file that has no name and
///   goes with the process.
/// Errors:
///   The constructor throws std::runtime_error when there is no place for the file, add() when it
///   is full.
#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "tools/monitor/chain_view.hpp"

namespace plumb {

/// Where an image lies in the log; no bytes: there is none.
struct ImagePlace {
  std::int64_t offset = 0;
  std::int64_t bytes = 0;
};

class FrameStore {
 public:
  FrameStore();

  /// Appends a frame. `json` is an object.
  void add(const std::string& json, const Row& row, const ImagePlace& image);
  [[nodiscard]] std::int64_t size() const;
  /// False when there is no frame `index`.
  [[nodiscard]] bool read(std::int64_t index, std::string* json, ImagePlace* image) const;
  /// Up to `max_rows` rows from `first` on.
  [[nodiscard]] std::vector<Row> rows(std::int64_t first, std::size_t max_rows) const;

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  struct Entry {
    std::int64_t offset;
    std::size_t bytes;
    ImagePlace image;
  };
  mutable std::mutex mutex_;
  std::unique_ptr<std::FILE, Close> file_;
  std::int64_t file_bytes_ = 0;
  std::vector<Entry> entries_;
  std::vector<Row> rows_;
};

}  // namespace plumb
