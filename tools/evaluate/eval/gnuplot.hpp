/// Draws pictures with the gnuplot program.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace plumb {

struct Curve {
  std::string title;
  std::vector<double> x;
  std::vector<double> y;
  bool marks_only = false;  ///< points, else a line
};

struct Plot {
  std::string title;
  std::string x_label;
  std::string y_label;
  std::vector<Curve> curves;
  bool equal_axes = false;  ///< for a map, on which a metre has the same length along both axes
  bool y_from_zero = false;
};

/// Draws `plots` above one another into `path`; its extension, .png or .svg, is the format.
/// Throws InputError when gnuplot is not installed or the file cannot be written.
void draw(const std::vector<Plot>& plots, const std::filesystem::path& path);

}  // namespace plumb
