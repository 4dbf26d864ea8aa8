#include "platform/bounded_decode.hpp"

#include "plumb/stage_latency_t.hpp"

namespace plumb {
namespace {

constexpr std::int32_t kMaxStages = 16;  // process_health_t.num_stages

/// Reads the count of a list that begins after `bytes_before`.
bool count_is_valid(std::span<const std::uint8_t> bytes, std::int64_t bytes_before,
                    std::int32_t most) {
  WireCursor cursor(bytes);
  cursor.skip(bytes_before);
  const std::int32_t count = cursor.i32();
  return cursor.ok() && count >= 0 && count <= most;
}

}  // namespace

bool lengths_are_valid(std::span<const std::uint8_t> bytes, const detections_t* /*type*/) {
  // Fingerprint, utime, seq.
  return count_is_valid(bytes, 3 * 8, detections_t::MAX_DETECTIONS);
}

bool lengths_are_valid(std::span<const std::uint8_t> bytes, const ground_plane_t* /*type*/) {
  WireCursor cursor(bytes);
  // Fingerprint, utime, seq, session, capture time, status, reason, normal, height, pitch, roll,
  // covariance.
  cursor.skip(5 * 8 + 2 * 1 + 3 * 8 + 3 * 8 + 9 * 8);
  const auto count = cursor.take(1);
  return cursor.ok() && count[0] <= ground_plane_t::MAX_CUES;
}

bool lengths_are_valid(std::span<const std::uint8_t> bytes, const objects_t* /*type*/) {
  // Fingerprint, utime, seq, capture time.
  return count_is_valid(bytes, 4 * 8, objects_t::MAX_OBJECTS);
}

bool lengths_are_valid(std::span<const std::uint8_t> bytes, const process_health_t* /*type*/) {
  WireCursor cursor(bytes);
  cursor.skip(16);
  (void)cursor.text();
  (void)cursor.text();
  cursor.skip(1);
  (void)cursor.text();
  cursor.skip(8 * 8 + 4 + 2 * 8);
  const std::int32_t count = cursor.i32();
  if (!cursor.ok() || count < 0 || count > kMaxStages) return false;
  for (std::int32_t i = 0; i < count; ++i) {
    (void)cursor.text();
    cursor.skip(8 + 3 * 8);
  }
  return cursor.at_end();
}

}  // namespace plumb
