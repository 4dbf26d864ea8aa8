/// Sequence numbers that never go back, made of those of a source that may begin anew.
///
/// Estimators find images by number, so that a number that comes twice would name two images. Each
/// time line of the source gets numbers of its own, well above all earlier ones.
#pragma once

#include <algorithm>
#include <cstdint>

namespace plumb {

class SteadyNumbers {
 public:
  /// Numbers between two time lines: no window of images reaches over it.
  static constexpr std::int64_t kGap = 1000;

  /// Begins another time line, whose first image has the number `seq`.
  void begin_anew(std::int64_t seq) {
    // Unsigned arithmetic is defined for the numbers of a hostile source, too.
    first_ = newest_ + kGap;
    offset_ = static_cast<std::uint64_t>(first_) - static_cast<std::uint64_t>(seq);
  }
  /// The steady number of an image of this time line.
  [[nodiscard]] std::int64_t steady(std::int64_t seq) const {
    return static_cast<std::int64_t>(static_cast<std::uint64_t>(seq) + offset_);
  }
  /// As steady(), for the newest image.
  std::int64_t take(std::int64_t seq) {
    newest_ = std::max(newest_, steady(seq));
    return steady(seq);
  }
  /// Whether the image belongs to this time line.
  [[nodiscard]] bool is_present(std::int64_t steady_seq) const { return steady_seq >= first_; }
  /// The source's own number. @pre is_present(steady_seq)
  [[nodiscard]] std::int64_t source(std::int64_t steady_seq) const {
    return static_cast<std::int64_t>(static_cast<std::uint64_t>(steady_seq) - offset_);
  }

 private:
  std::int64_t first_ = INT64_MIN;
  std::int64_t newest_ = 0;
  std::uint64_t offset_ = 0;
};

}  // namespace plumb
