#include "tools/evaluate/eval/gnuplot.hpp"

#include <algorithm>
#include <cstdio>

#include "core/input_error.hpp"
#include "modules/datasets/text.hpp"

namespace plumb {
namespace {

constexpr const char* kColours[] = {"#333333", "#d95319", "#0072bd", "#77ac30", "#7e2f8e"};

/// A gnuplot string literal: single quotes are doubled inside single quotes.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("''") : std::string(1, c);
  return result + "'";
}

std::string data_block(const std::string& name, const Curve& curve) {
  std::string text = name + " << EOD\n";
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    text += format("%.9g %.9g\n", curve.x[i], curve.y[i]);
  }
  return text + "EOD\n";
}

struct Range {
  double low = 0.0;
  double high = 0.0;
  void take(const std::vector<double>& values) {
    for (const double value : values) {
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  [[nodiscard]] double span() const { return high - low; }
  void widen(double span_wanted) {
    const double more = std::max(0.0, span_wanted - span()) / 2.0;
    low -= more;
    high += more;
  }
};

/// A map around the origin and every curve; a straight drive still gets some width.
std::string map_ranges(const Plot& plot) {
  constexpr double kLeastShape = 0.6;
  Range x, y;
  for (const Curve& curve : plot.curves) {
    x.take(curve.x);
    y.take(curve.y);
  }
  const double longest = std::max({x.span(), y.span(), 1.0});
  for (Range* range : {&x, &y}) {
    range->widen(kLeastShape * longest);
    range->widen(1.06 * range->span());
  }
  return format("set size ratio -1\nset xrange [%g:%g]\nset yrange [%g:%g]\n", x.low, x.high, y.low,
                y.high);
}

std::string script_of(const Plot& plot, std::size_t index) {
  std::string data;
  std::string command = "plot ";
  for (std::size_t c = 0; c < plot.curves.size(); ++c) {
    const std::string name = format("$p%zuc%zu", index, c);
    const Curve& curve = plot.curves[c];
    data += data_block(name, curve);
    command += c == 0 ? "" : ", ";
    command += name + (curve.marks_only ? " with points pt 7 ps 0.4" : " with lines lw 2") +
               format(" lc rgb '%s'", kColours[c % std::size(kColours)]) + " title " +
               quoted(curve.title);
  }
  std::string script = data + "set title " + quoted(plot.title) + " noenhanced\nset xlabel " +
                       quoted(plot.x_label) + "\nset ylabel " + quoted(plot.y_label) + "\n";
  if (plot.equal_axes) {
    script += map_ranges(plot);
  } else {
    script += "set size noratio\nset xrange [*:*]\n";
    script += plot.y_from_zero ? "set yrange [0:*]\n" : "set yrange [*:*]\n";
  }
  return script + command + "\n";
}

}  // namespace

void draw(const std::vector<Plot>& plots, const std::filesystem::path& path) {
  const std::size_t rows = plots.size();
  const std::size_t height_px = rows == 1 ? 620 : 380 * rows;
  const bool svg = path.extension() == ".svg";
  std::string script =
      svg ? format("set terminal svg size 900,%zu noenhanced background 'white'\n", height_px)
          : format("set terminal pngcairo size 900,%zu noenhanced\n", height_px);
  script += "set output " + quoted(path.string()) + "\nset grid lc rgb '#dddddd'\n";
  script += "set key outside top right\n";
  if (rows > 1) script += format("set multiplot layout %zu,1\n", rows);
  for (std::size_t i = 0; i < rows; ++i) script += script_of(plots[i], i);

  std::FILE* pipe = popen("gnuplot", "w");
  if (pipe == nullptr) throw InputError("cannot start gnuplot");
  const bool written = std::fwrite(script.data(), 1, script.size(), pipe) == script.size();
  const int status = pclose(pipe);
  if (status != 0 || !written) {
    throw InputError("gnuplot could not draw " + path.string() + " (is gnuplot-nox installed?)");
  }
}

}  // namespace plumb
