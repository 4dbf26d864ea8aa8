#include "tools/run/record/recording.hpp"

#include "core/channels.hpp"
#include "modules/datasets/text.hpp"

namespace plumb {
namespace {

constexpr std::int64_t kEventHeaderBytes = 28;
constexpr std::int64_t kCheckDiskBytes = 8 << 20;  ///< the disk is looked at so often

}  // namespace

Recording::Recording(std::filesystem::path path, const RecordingLimits& limits)
    : path_(std::move(path)), limits_(limits) {}

std::filesystem::path Recording::first_part(const std::filesystem::path& path,
                                            const RecordingLimits& limits) {
  return Recording(path, limits).part_path(0);
}

std::filesystem::path Recording::part_path(std::int64_t number) const {
  if (!is_split()) return path_;
  std::filesystem::path part = path_.parent_path() / path_.stem();
  part += format("_%04lld", static_cast<long long>(number)) + path_.extension().string();
  return part;
}

const char* Recording::write(std::int64_t log_us, std::string_view channel,
                             std::span<const std::uint8_t> bytes) {
  if (!log_ || part_is_over(log_us)) begin_part(log_us);
  if (channel == kCameraCalibration.name) calibration_.assign(bytes.begin(), bytes.end());
  append(log_us, channel, bytes);
  ++num_messages_;
  return keep_limits();
}

bool Recording::part_is_over(std::int64_t log_us) const {
  return (limits_.split_bytes > 0 && parts_.back().bytes >= limits_.split_bytes) ||
         (limits_.split_us > 0 && log_us - part_begin_us_ >= limits_.split_us);
}

void Recording::begin_part(std::int64_t log_us) {
  if (log_) log_->close();
  parts_.push_back({part_path(num_parts_), 0});
  log_.emplace(parts_.back().path.string());
  ++num_parts_;
  part_begin_us_ = log_us;
  if (!calibration_.empty()) append(log_us, kCameraCalibration.name, calibration_);
}

void Recording::append(std::int64_t log_us, std::string_view channel,
                       std::span<const std::uint8_t> bytes) {
  log_->write(log_us, channel, bytes);
  const auto size = kEventHeaderBytes + static_cast<std::int64_t>(channel.size() + bytes.size());
  parts_.back().bytes += size;
  kept_bytes_ += size;
  num_bytes_ += size;
}

const char* Recording::keep_limits() {
  while (limits_.keep_bytes > 0 && kept_bytes_ > limits_.keep_bytes) {
    if (parts_.size() < 2) return "the disk limit is reached";
    std::error_code ignored;  // A part that somebody has taken away need not be deleted.
    std::filesystem::remove(parts_.front().path, ignored);
    kept_bytes_ -= parts_.front().bytes;
    parts_.pop_front();
    ++num_deleted_;
  }
  if (limits_.free_bytes == 0 || num_bytes_ - bytes_at_check_ < kCheckDiskBytes) return nullptr;
  bytes_at_check_ = num_bytes_;
  std::error_code error;
  const auto space = std::filesystem::space(parts_.back().path, error);
  const bool is_full = !error && space.available < static_cast<std::uintmax_t>(limits_.free_bytes);
  return is_full ? "the disk is nearly full" : nullptr;
}

void Recording::flush() {
  if (log_) log_->flush();
}

void Recording::close() {
  if (log_) log_->close();
}

}  // namespace plumb
