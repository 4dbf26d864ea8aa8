#include "tools/monitor/frame_store.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace plumb {

FrameStore::FrameStore() : file_(std::tmpfile()) {
  if (file_ == nullptr)
    throw std::runtime_error(std::string("no temporary file for the results: ") +
                             std::strerror(errno));
}

void FrameStore::add(const std::string& json, const Row& row, const ImagePlace& image) {
  std::size_t written = 0;
  while (written < json.size()) {
    const ssize_t put =
        ::pwrite(::fileno(file_.get()), json.data() + written, json.size() - written,
                 file_bytes_ + static_cast<std::int64_t>(written));
    if (put <= 0)
      throw std::runtime_error(std::string("the temporary file for the results: ") +
                               std::strerror(errno));
    written += static_cast<std::size_t>(put);
  }
  const std::lock_guard lock(mutex_);
  entries_.push_back({file_bytes_, json.size(), image});
  file_bytes_ += static_cast<std::int64_t>(json.size());
  rows_.push_back(row);
}

std::int64_t FrameStore::size() const {
  const std::lock_guard lock(mutex_);
  return static_cast<std::int64_t>(entries_.size());
}

bool FrameStore::read(std::int64_t index, std::string* json, ImagePlace* image) const {
  Entry entry{};
  {
    const std::lock_guard lock(mutex_);
    if (index < 0 || index >= static_cast<std::int64_t>(entries_.size())) return false;
    entry = entries_[static_cast<std::size_t>(index)];
  }
  json->resize(entry.bytes);
  *image = entry.image;
  return ::pread(::fileno(file_.get()), json->data(), entry.bytes, entry.offset) ==
         static_cast<ssize_t>(entry.bytes);
}

std::vector<Row> FrameStore::rows(std::int64_t first, std::size_t max_rows) const {
  const std::lock_guard lock(mutex_);
  std::vector<Row> list;
  const std::size_t begin =
      std::min(static_cast<std::size_t>(std::max<std::int64_t>(first, 0)), entries_.size());
  const std::size_t end = std::min(begin + max_rows, entries_.size());
  for (std::size_t i = begin; i < end; ++i) list.push_back(rows_[i]);
  return list;
}

}  // namespace plumb
