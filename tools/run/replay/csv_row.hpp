/// Builds one row of a CSV file, or its header, which lists the names of the cells in the same
/// order.
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <string>

#include "core/numbers.hpp"

namespace plumb {

class CsvRow {
 public:
  explicit CsvRow(bool names_only) : names_only_(names_only) {}

  /// Reasons are sentences; a comma in one must not begin a new cell.
  void add(const std::string& name, const char* text) {
    std::string value = text == nullptr ? "" : text;
    std::replace(value.begin(), value.end(), ',', ';');
    cell(name, value);
  }
  void add(const std::string& name, std::int64_t value) { cell(name, std::to_string(value)); }
  /// Adds an empty cell when the value is not valid or not finite.
  void add(const std::string& name, double value, bool holds = true) {
    char text[32] = "";
    if (holds && std::isfinite(value))
      *std::to_chars(text, text + sizeof text - 1, value).ptr = '\0';
    cell(name, text);
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  void cell(const std::string& name, const std::string& value) {
    if (!text_.empty() || num_cells_ > 0) text_ += ',';
    text_ += names_only_ ? name : value;
    ++num_cells_;
  }
  bool names_only_;
  int num_cells_ = 0;
  std::string text_;
};

/// The standard deviation; NaN, which gives an empty cell, when the variance is not valid.
inline double deviation(double variance) { return variance >= 0.0 ? std::sqrt(variance) : kNan; }

}  // namespace plumb
