/// Makes sound and faulty sequences of stamps and numbers.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "modules/integrity/time_base.hpp"

namespace plumb::test {

/// Makes `count` images from 10 s on, numbered from `first_seq`.
inline std::vector<TimeStampedImage> regular(int count, double interval_s,
                                             std::int64_t first_seq = 0) {
  std::vector<TimeStampedImage> stream;
  for (int i = 0; i < count; ++i)
    stream.push_back({10'000'000 + std::llround(i * interval_s * 1e6), first_seq + i});
  return stream;
}

inline std::vector<TimeVerdict> judge_all(const std::vector<TimeStampedImage>& stream) {
  TimeBase base({});
  std::vector<TimeVerdict> verdicts;
  for (const TimeStampedImage& image : stream) verdicts.push_back(base.update(image));
  return verdicts;
}

/// Makes messages without any order, some of them repeated, from up to three sessions.
inline std::vector<TimeStampedImage> garbage(std::mt19937_64& random, int count) {
  std::vector<TimeStampedImage> stream;
  for (int i = 0; i < count; ++i) {
    const auto kind = random() % 4;
    if (kind == 0 && !stream.empty()) {
      stream.push_back(stream[random() % stream.size()]);
    } else if (kind == 1 && !stream.empty()) {
      TimeStampedImage next = stream.back();
      next.seq += 1;
      next.stamp_us += static_cast<std::int64_t>(random() % 200'000);
      stream.push_back(next);
    } else {
      stream.push_back({static_cast<std::int64_t>(random() % 100'000'000),
                        static_cast<std::int64_t>(random() % 1000),
                        static_cast<std::int64_t>(random() % 3)});
    }
  }
  return stream;
}

/// Loses, repeats and swaps some images, and gives some a wrong stamp. The last 20 stay sound.
inline std::vector<TimeStampedImage> with_faults(std::vector<TimeStampedImage> stream,
                                                 std::mt19937_64& random) {
  for (int fault = 0; fault < 12; ++fault) {
    const std::size_t i = 1 + random() % (stream.size() - 22);
    const auto position = stream.begin() + static_cast<std::ptrdiff_t>(i);
    switch (random() % 4) {
      case 0:
        stream.erase(position);
        break;
      case 1:
        stream.insert(position, stream[i - 1]);
        break;
      case 2:
        std::swap(stream[i - 1], stream[i]);
        break;
      default:
        stream[i].stamp_us += static_cast<std::int64_t>(random() % 10'000'000) - 5'000'000;
    }
  }
  return stream;
}

}  // namespace plumb::test
