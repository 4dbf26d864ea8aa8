/// Reads and writes files of samples. A file is text and has one drive. It exists only when it is
/// complete.
///
/// Line 1 says what it is ("# plumb-train samples, version 3, drive NAME, algorithm ID"), line 2
/// names the columns. One row for each frame follows, then "# end N" with the number of rows.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/learn/train/sample.hpp"

namespace plumb {

inline constexpr int kSamplesVersion = 3;

struct DriveSamples {
  std::string drive;      ///< no commas or blanks
  std::string algorithm;  ///< setting of the run: "learned", "fixed" or "paper"
  std::vector<Sample> frames;
};

/// Throws InputError when `path` cannot be written.
void write_samples(const DriveSamples& samples, const std::filesystem::path& path);

/// Throws InputError with file and line for anything but a complete file of this version.
[[nodiscard]] DriveSamples read_samples(const std::filesystem::path& path);

/// Reads several files. Throws InputError also when two hold the same drive, or when their
/// algorithms differ.
[[nodiscard]] std::vector<DriveSamples> read_all_samples(
    const std::vector<std::filesystem::path>& paths);

/// Whether the name is not empty and has only letters, digits and ._-+, as "04_000-050" has.
[[nodiscard]] bool is_drive_name(const std::string& name);

}  // namespace plumb
