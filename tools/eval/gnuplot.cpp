#include "tools/eval/gnuplot.hpp"

#include <cstdio>
#include <memory>

#include "tools/support/input_error.hpp"
#include "tools/support/text.hpp"

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
  script += plot.equal_axes ? "set size ratio -1\n" : "set size noratio\n";
  script += plot.y_from_zero ? "set yrange [0:*]\n" : "set yrange [*:*]\n";
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
