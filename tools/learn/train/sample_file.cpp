#include "tools/learn/train/sample_file.hpp"

#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>
#include <set>

#include "core/input_error.hpp"
#include "modules/datasets/number_file.hpp"
#include "modules/datasets/text.hpp"

namespace plumb {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMagic = "# plumb-train samples";
constexpr std::size_t kFirstRow = 2;

std::string header_row() {
  std::string text;
  const Sample sample;
  Sample::visit(sample, [&text](const char* name, double) { text.append(",").append(name); });
  return text.substr(1);
}

std::string row_of(const Sample& sample) {
  std::string text;
  Sample::visit(sample, [&text](const char* /*name*/, double value) {
    char cell[32] = "";
    if (std::isfinite(value)) *std::to_chars(cell, cell + sizeof cell - 1, value).ptr = '\0';
    text.append(",").append(cell);
  });
  return text.substr(1);
}

[[noreturn]] void refuse(const fs::path& path, std::size_t line, const std::string& why) {
  throw InputError(path.string() + ":" + std::to_string(line) + ": " + why);
}

/// "KEY VALUE" of one comma-separated part of line 1.
std::string value_of(std::string_view part, std::string_view key) {
  if (part.substr(0, key.size()) != key || part.size() <= key.size() + 1) return {};
  return std::string(part.substr(key.size() + 1));
}

void read_first_line(const fs::path& path, const std::string& line, DriveSamples* samples) {
  const std::vector<std::string_view> parts = split_cells(line);
  if (parts.empty() || parts[0] != kMagic) refuse(path, 1, "is not a sample file of plumb-train");
  const std::string version = parts.size() > 1 ? value_of(parts[1], "version") : "";
  if (version != std::to_string(kSamplesVersion)) {
    refuse(path, 1,
           "holds samples of version '" + version + "', this program reads " +
               std::to_string(kSamplesVersion));
  }
  if (parts.size() == 4) {
    samples->drive = value_of(parts[2], "drive");
    samples->algorithm = value_of(parts[3], "algorithm");
  }
  if (samples->drive.empty() || samples->algorithm.empty())
    refuse(path, 1, "does not name its drive and algorithm");
}

Sample read_row(const fs::path& path, std::size_t line, const std::string& text,
                std::size_t num_columns) {
  const std::vector<std::string_view> cells = split_cells(text);
  if (cells.size() != num_columns) {
    refuse(path, line, format("%zu cells, there are %zu columns", cells.size(), num_columns));
  }
  Sample sample;
  std::size_t i = 0;
  Sample::visit(sample, [&](const char* name, double& value) {
    const std::string_view cell = cells[i++];
    if (cell.empty()) return;
    const std::optional<double> number = parse_number(cell);
    if (!number)
      refuse(path, line, format("%s: '%s' is not a number", name, std::string(cell).c_str()));
    value = *number;
  });
  return sample;
}

}  // namespace

bool is_drive_name(const std::string& name) {
  const auto fits = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
           std::string_view("._-+").find(c) != std::string_view::npos;
  };
  return !name.empty() && std::all_of(name.begin(), name.end(), fits);
}

void write_samples(const DriveSamples& samples, const fs::path& path) {
  fs::path part = path;
  part += format(".part%d", static_cast<int>(getpid()));
  std::ofstream file(part);
  file << kMagic << ", version " << kSamplesVersion << ", drive " << samples.drive << ", algorithm "
       << samples.algorithm << "\n"
       << header_row() << "\n";
  for (const Sample& sample : samples.frames) file << row_of(sample) << "\n";
  file << "# end " << samples.frames.size() << "\n";
  file.close();
  std::error_code error;
  if (file) fs::rename(part, path, error);
  if (file && !error) return;
  std::error_code ignored;
  fs::remove(part, ignored);
  throw InputError("cannot write " + path.string());
}

DriveSamples read_samples(const fs::path& path) {
  const std::vector<std::string> lines = read_lines(path);
  if (lines.empty()) throw InputError(path.string() + " is empty");
  DriveSamples samples;
  read_first_line(path, lines[0], &samples);
  if (lines.size() < kFirstRow || lines[1] != header_row())
    refuse(path, 2, "columns are not those of this version");
  const std::size_t num_columns = split_cells(lines[1]).size();
  std::size_t i = kFirstRow;
  for (; i < lines.size() && lines[i].rfind("# end", 0) != 0; ++i) {
    samples.frames.push_back(read_row(path, i + 1, lines[i], num_columns));
  }
  if (i == lines.size() || lines[i] != format("# end %zu", samples.frames.size()))
    refuse(path, lines.size(), "the file does not end as it should: it is not complete");
  return samples;
}

std::vector<DriveSamples> read_all_samples(const std::vector<fs::path>& paths) {
  std::vector<DriveSamples> all;
  std::set<std::string> drives;
  for (const fs::path& path : paths) {
    all.push_back(read_samples(path));
    if (!drives.insert(all.back().drive).second)
      throw InputError(path.string() + ": drive " + all.back().drive + " is there twice");
    if (all.back().algorithm == all.front().algorithm) continue;
    throw InputError(path.string() + ": made with " + all.back().algorithm + ", " +
                     paths.front().string() + " with " + all.front().algorithm);
  }
  return all;
}

}  // namespace plumb
