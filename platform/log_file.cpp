#include "platform/log_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

namespace plumb {
namespace {

constexpr std::uint32_t kSync = 0xEDA1DA01U;
constexpr std::int64_t kHeaderBytes = 28;
constexpr std::size_t kFlushBytes = 1U << 20U;

std::uint64_t load_be(const std::uint8_t* bytes, int count) {
  std::uint64_t value = 0;
  for (int i = 0; i < count; ++i) value = (value << 8U) | bytes[i];
  return value;
}

void store_be(std::vector<std::uint8_t>* out, std::uint64_t value, int count) {
  for (int i = count - 1; i >= 0; --i)
    out->push_back(static_cast<std::uint8_t>(value >> static_cast<unsigned>(8 * i)));
}

std::string with_errno(const std::string& path, const char* what) {
  return path + ": " + what + ": " + std::strerror(errno);
}

}  // namespace

struct LogReader::Header {
  std::int64_t number = 0;
  std::int64_t log_us = 0;
  std::int32_t channel_bytes = 0;
  std::int32_t data_bytes = 0;
  std::int64_t event_bytes = 0;
  std::string flaw;  ///< empty when plausible
};

LogReader::LogReader(const std::string& path) : path_(path) {
  struct stat info {};
  fd_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd_ < 0 || ::fstat(fd_, &info) != 0) throw LogError(with_errno(path, "cannot read"));
  if (!S_ISREG(info.st_mode)) {
    ::close(fd_);
    throw LogError(path + ": cannot read: not a regular file");
  }
  file_bytes_ = info.st_size;
}

LogReader::~LogReader() { ::close(fd_); }

bool LogReader::next(LogEvent* event) {
  while (offset_ < file_bytes_) {
    Header header;
    if (!read_header(offset_, &header)) {
      skip_damage(header.flaw);
      continue;
    }
    const std::int64_t end = offset_ + header.event_bytes;
    if (end < file_bytes_ && !sync_at(end) && find_event(offset_ + 4, end) < end) {
      skip_damage("the lengths of this event are damaged");
      continue;
    }
    const auto payload = static_cast<std::size_t>(header.event_bytes - kHeaderBytes);
    buffer_.resize(std::max(buffer_.size(), payload));
    if (!read_at(offset_ + kHeaderBytes, buffer_.data(), payload)) {
      throw LogError(path_ + ": byte " + std::to_string(offset_) +
                     ": the file shrank while reading");
    }
    const auto channel_bytes = static_cast<std::size_t>(header.channel_bytes);
    event->number = header.number;
    event->log_us = header.log_us;
    event->channel = {reinterpret_cast<const char*>(buffer_.data()), channel_bytes};
    event->data = {buffer_.data() + channel_bytes, payload - channel_bytes};
    offset_ = end;
    ++num_events_;
    return true;
  }
  if (file_bytes_ == 0 && num_problems_ == 0) report(0, "the file is empty");
  return false;
}

bool LogReader::read_at(std::int64_t offset, void* out, std::size_t bytes) const {
  auto* cursor = static_cast<std::uint8_t*>(out);
  while (bytes > 0) {
    const ssize_t got = ::pread(fd_, cursor, bytes, offset);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw LogError(with_errno(path_, "cannot read"));
    if (got == 0) return false;
    cursor += got;
    offset += got;
    bytes -= static_cast<std::size_t>(got);
  }
  return true;
}

bool LogReader::read_header(std::int64_t offset, Header* header) const {
  std::array<std::uint8_t, kHeaderBytes> raw{};
  const std::int64_t left = file_bytes_ - offset;
  if (left < kHeaderBytes || !read_at(offset, raw.data(), raw.size())) {
    header->flaw =
        "the last event is cut off: " + std::to_string(left) + " bytes of its header are left";
    return false;
  }
  header->number = static_cast<std::int64_t>(load_be(&raw[4], 8));
  header->log_us = static_cast<std::int64_t>(load_be(&raw[12], 8));
  header->channel_bytes = static_cast<std::int32_t>(load_be(&raw[20], 4));
  header->data_bytes = static_cast<std::int32_t>(load_be(&raw[24], 4));
  header->event_bytes = kHeaderBytes + std::int64_t{header->channel_bytes} + header->data_bytes;
  if (load_be(raw.data(), 4) != kSync) {
    header->flaw = "no event begins here (no sync word)";
  } else if (header->channel_bytes < 1 || header->channel_bytes > kMaxChannelBytes) {
    header->flaw =
        "channel length " + std::to_string(header->channel_bytes) + " is outside [1, 63]";
  } else if (header->data_bytes < 0 || header->data_bytes > kMaxDataBytes) {
    header->flaw =
        "data length " + std::to_string(header->data_bytes) + " is outside [0, 67108864]";
  } else if (header->event_bytes > left) {
    header->flaw = "event of " + std::to_string(header->event_bytes) +
                   " bytes is cut off: " + std::to_string(header->event_bytes - left) +
                   " are missing";
  }
  return header->flaw.empty();
}

bool LogReader::sync_at(std::int64_t offset) const {
  std::array<std::uint8_t, 4> raw{};
  return offset + 4 <= file_bytes_ && read_at(offset, raw.data(), raw.size()) &&
         load_be(raw.data(), 4) == kSync;
}

// Returns the first offset in [from, to) where a plausible event begins, or `to` if there is none.
std::int64_t LogReader::find_event(std::int64_t from, std::int64_t to) const {
  std::array<std::uint8_t, 65536> chunk{};
  while (from < to) {
    const std::int64_t bytes = std::min<std::int64_t>(chunk.size(), file_bytes_ - from);
    if (bytes < kHeaderBytes || !read_at(from, chunk.data(), static_cast<std::size_t>(bytes)))
      return to;
    for (std::int64_t i = 0; i + 4 <= bytes && from + i < to; ++i) {
      Header header;
      if (chunk[static_cast<std::size_t>(i)] == kSync >> 24U &&
          load_be(&chunk[static_cast<std::size_t>(i)], 4) == kSync &&
          read_header(from + i, &header)) {
        return from + i;
      }
    }
    from += bytes - 3;
  }
  return to;
}

void LogReader::report(std::int64_t offset, const std::string& reason) {
  ++num_problems_;
  if (problems_.size() < kMaxProblems)
    problems_.push_back(path_ + ": byte " + std::to_string(offset) + ": " + reason);
}

void LogReader::skip_damage(const std::string& reason) {
  report(offset_, reason);
  offset_ = find_event(offset_ + 1, file_bytes_);
}

LogWriter::LogWriter(const std::string& path) : path_(path) {
  fd_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (fd_ < 0) throw LogError(with_errno(path, "cannot write"));
  buffer_.reserve(2 * kFlushBytes);
}

LogWriter::~LogWriter() {
  try {
    if (fd_ >= 0) flush();
  } catch (const LogError&) {  // a destructor cannot report the error; close() does
  }
  release();
}

void LogWriter::write(std::int64_t log_us, std::string_view channel,
                      std::span<const std::uint8_t> data) {
  if (channel.empty() || channel.size() > LogReader::kMaxChannelBytes ||
      data.size() > LogReader::kMaxDataBytes) {
    throw LogError(path_ + ": event does not fit the format: channel of " +
                   std::to_string(channel.size()) + " bytes, data of " +
                   std::to_string(data.size()));
  }
  store_be(&buffer_, kSync, 4);
  store_be(&buffer_, static_cast<std::uint64_t>(num_events_), 8);
  store_be(&buffer_, static_cast<std::uint64_t>(log_us), 8);
  store_be(&buffer_, channel.size(), 4);
  store_be(&buffer_, data.size(), 4);
  buffer_.insert(buffer_.end(), channel.begin(), channel.end());
  buffer_.insert(buffer_.end(), data.begin(), data.end());
  ++num_events_;
  if (buffer_.size() >= kFlushBytes) flush();
}

void LogWriter::flush() {
  std::size_t done = 0;
  while (done < buffer_.size()) {
    const ssize_t put = ::write(fd_, buffer_.data() + done, buffer_.size() - done);
    if (put < 0 && errno == EINTR) continue;
    if (put < 0) {
      const std::string reason = with_errno(path_, "cannot write");
      // The file is cut back to whole events, so that the events written before stay readable.
      std::size_t whole = 0;
      while (whole + kHeaderBytes <= done) {
        const std::uint64_t next = whole + kHeaderBytes + load_be(&buffer_[whole + 20], 4) +
                                   load_be(&buffer_[whole + 24], 4);
        if (next > done) break;
        whole = next;
      }
      const bool cut = ::ftruncate(fd_, written_bytes_ + static_cast<std::int64_t>(whole)) == 0;
      buffer_.clear();
      release();
      throw LogError(reason + (cut ? "; the events before it are kept" : ""));
    }
    done += static_cast<std::size_t>(put);
  }
  written_bytes_ += static_cast<std::int64_t>(done);
  buffer_.clear();
}

void LogWriter::close() {
  if (fd_ < 0) return;
  flush();
  const int fd = fd_;
  fd_ = -1;
  if (::close(fd) != 0) throw LogError(with_errno(path_, "cannot write"));
}

void LogWriter::release() noexcept {
  if (fd_ >= 0) ::close(fd_);
  fd_ = -1;
}

}  // namespace plumb
