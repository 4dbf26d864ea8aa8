#include "platform/can_trace.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cinttypes>
#include <cstring>

namespace plumb {
namespace {

constexpr std::size_t kBufferBytes = 1 << 16;
constexpr std::size_t kMaxLineBytes = 256;  // 64 bytes of data are 128 digits
constexpr std::int64_t kSecondUs = 1'000'000;

/// Returns the value of a hexadecimal digit, -1 for any other character.
int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return -1;
}

/// Parses "identifier#data" as candump writes it.
bool parse_frame(const char* text, CanFrame* frame) {
  const char* hash = std::strchr(text, '#');
  if (hash == nullptr) return false;
  const auto id_digits = hash - text;
  if (id_digits != 3 && id_digits != 8) return false;
  *frame = CanFrame{};
  for (const char* p = text; p != hash; ++p) {
    const int digit = hex_digit(*p);
    if (digit < 0) return false;
    frame->id = frame->id << 4U | static_cast<std::uint32_t>(digit);
  }
  frame->extended = id_digits == 8;
  const char* p = hash + 1;
  if (*p == '#') {  // CAN FD: one digit of flags
    frame->fd = true;
    if (hex_digit(*++p) < 0) return false;
    ++p;
  }
  const std::size_t capacity = frame->fd ? 64 : 8;
  while (*p != '\0') {
    const int high = hex_digit(p[0]);
    const int low = high < 0 ? -1 : hex_digit(p[1]);
    if (low < 0 || frame->size == capacity) return false;
    frame->data[frame->size++] = static_cast<std::uint8_t>(high * 16 + low);
    p += 2;
  }
  return true;
}

}  // namespace

CanTraceWriter::CanTraceWriter(const std::string& path, const std::string& interface,
                               Existing existing)
    : path_(path), interface_(interface.substr(0, 15)), buffer_(kBufferBytes) {
  // Who continues a file runs live: a pipe without a reader is refused, not waited for.
  const int kept = existing == Existing::kContinued ? O_APPEND | O_NONBLOCK : O_TRUNC;
  fd_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | kept, 0644);
  if (fd_ < 0) fail("cannot create", errno);
  if (fd_ >= 0 && existing == Existing::kContinued) end_partial_line();
}

/// A power cut may have left half a line, which would spoil the next one.
void CanTraceWriter::end_partial_line() {
  struct stat now {};
  if (::fstat(fd_, &now) != 0 || !S_ISREG(now.st_mode) || now.st_size == 0) return;
  const int reader = ::open(path_.c_str(), O_RDONLY | O_CLOEXEC);
  char last = '\n';
  if (reader < 0) return;
  const bool is_read = ::pread(reader, &last, 1, now.st_size - 1) == 1;
  ::close(reader);
  if (is_read && last != '\n') buffer_[used_++] = '\n';
}

CanTraceWriter::~CanTraceWriter() {
  flush();
  if (fd_ >= 0) ::close(fd_);
}

void CanTraceWriter::fail(const char* what, int error_number) {
  error_ = path_ + ": " + what + ": " + std::strerror(error_number);
}

void CanTraceWriter::send(std::int64_t time_us, const CanFrame& frame) {
  if (!error_.empty()) return;
  if (kBufferBytes - used_ < kMaxLineBytes && !flush()) return;
  const std::int64_t stamp_us = time_us + offset_us_;
  char* out = buffer_.data() + used_;
  int n = std::snprintf(
      out, kMaxLineBytes,
      frame.extended ? "(%010" PRId64 ".%06d) %s %08X%s" : "(%010" PRId64 ".%06d) %s %03X%s",
      stamp_us / kSecondUs, static_cast<int>(std::abs(stamp_us % kSecondUs)), interface_.c_str(),
      frame.id, frame.fd ? "##1" : "#");
  constexpr char kDigits[] = "0123456789ABCDEF";
  for (std::size_t i = 0; i < frame.size; ++i) {
    out[n++] = kDigits[frame.data[i] >> 4U];
    out[n++] = kDigits[frame.data[i] & 0xFU];
  }
  out[n++] = '\n';
  used_ += static_cast<std::size_t>(n);
  ++num_frames_;
}

bool CanTraceWriter::flush() {
  std::size_t done = 0;
  while (error_.empty() && done < used_) {
    const ssize_t n = ::write(fd_, buffer_.data() + done, used_ - done);
    if (n >= 0) {
      done += static_cast<std::size_t>(n);
    } else if (errno == EAGAIN) {
      if (gives_up_) break;
      wait_for_room();
    } else if (errno != EINTR) {
      fail("cannot write", errno);
    }
  }
  used_ = 0;
  return error_.empty();
}

void CanTraceWriter::wait_for_room() const {
  constexpr int kWaitMs = 50;
  pollfd room{fd_, POLLOUT, 0};
  (void)::poll(&room, 1, kWaitMs);
}

CanTraceReader::CanTraceReader(const std::string& path)
    : path_(path), file_(std::fopen(path.c_str(), "re")) {
  if (!file_) error_ = path + ": cannot read: " + std::strerror(errno);
}

bool read_trace_line(const char* line, std::int64_t* time_us, CanFrame* frame) {
  std::int64_t seconds = 0;
  std::int64_t micros = 0;
  char text[256];
  char rest = '\0';
  if (std::sscanf(line, "(%" SCNd64 ".%6" SCNd64 ") %*15s %255s %c", &seconds, &micros, text,
                  &rest) != 3 ||
      !parse_frame(text, frame)) {
    return false;
  }
  *time_us = seconds * kSecondUs + micros;
  return true;
}

bool CanTraceReader::next(std::int64_t* time_us, CanFrame* frame) {
  char line[512];
  while (error_.empty() && std::fgets(line, sizeof line, file_.get()) != nullptr) {
    ++line_;
    if (line[0] == '\n') continue;
    if (read_trace_line(line, time_us, frame)) return true;
    error_ = path_ + ":" + std::to_string(line_) + ": not a CAN frame";
  }
  return false;
}

}  // namespace plumb
