/// Compares two sets of errors on the same frames: is one really smaller?
///
/// Model:
///   Errors of neighbouring frames are alike, so blocks of neighbouring frames are drawn and not
///   single ones (block bootstrap): as many blocks as there are, with replacement, two thousand
///   times. The interval lies between the 2.5th and the 97.5th percentile of the means.
/// Formats:
///   A file of samples is a table with the columns drive, frame, kind and value.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace plumb {

struct ErrorSample {
  std::string drive;
  std::int64_t frame = 0;
  std::string kind;  ///< which error of the frame, such as a cue or a segment's length
  double value = 0.0;
};

/// Reads a file of samples. Throws InputError with file and line.
[[nodiscard]] std::vector<ErrorSample> read_error_samples(const std::filesystem::path& path);
/// Writes a file of samples. Throws InputError.
void write_error_samples(const std::vector<ErrorSample>& samples,
                         const std::filesystem::path& path);

struct Interval {
  double mean = 0.0;
  double low = 0.0;
  double high = 0.0;
};

struct PairedComparison {
  int num_pairs = 0;
  int num_blocks = 0;
  Interval of;          ///< mean of the first set
  Interval against;     ///< mean of the second set
  Interval difference;  ///< first minus second, pair by pair
};

struct ComparisonOptions {
  std::string of;       ///< kind to take of the first set; empty: every kind, paired with its like
  std::string against;  ///< kind to take of the second set; stated if and only if `of` is
  int block_frames = 20;
};

/// Pairs what both sets have. The same input gives the same bits. Throws InputError when they have
/// no sample in common.
[[nodiscard]] PairedComparison compare_samples(const std::vector<ErrorSample>& of,
                                               const std::vector<ErrorSample>& against,
                                               const ComparisonOptions& options);

}  // namespace plumb
