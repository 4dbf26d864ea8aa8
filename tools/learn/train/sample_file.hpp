/// Files of samples: one drive each, text, complete or not there.
///
/// Line 1 says what it is ("# plumb-train samples, version 2, drive NAME, model ID"), line 2 names the columns, then one
/// row per frame, and "# end N" with the number of rows. A file appears under its name when it is complete.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/learn/train/sample.hpp"

namespace plumb {

inline constexpr int kSamplesVersion = 2;

struct DriveSamples {
  std::string drive;      ///< no commas or blanks
  std::string algorithm;  ///< setting under which it ran: "learned", "fixed" or "paper"
  std::vector<Sample> frames;
};

/// Throws InputError when `path` cannot be written.
void write_samples(const DriveSamples& samples, const std::filesystem::path& path);

/// Throws InputError with file and line for anything but a complete file of this version.
[[nodiscard]] DriveSamples read_samples(const std::filesystem::path& path);

/// Reads several. Throws InputError also when two hold the same drive, or their algorithms differ.
[[nodiscard]] std::vector<DriveSamples> read_all_samples(
    const std::vector<std::filesystem::path>& paths);

/// "04_000-050" and the like: not empty, letters, digits and ._-+ only.
[[nodiscard]] bool is_drive_name(const std::string& name);

}  // namespace plumb
