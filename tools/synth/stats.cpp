#include "tools/synth/stats.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>
#include <sstream>
#include <stdexcept>

namespace plumb::synth {
namespace {

namespace fs = std::filesystem;

constexpr int kWindow = 256;
constexpr float kCornerStrength =
    4e-4F;  ///< smallest eigenvalue of a 5x5 window, image scaled to 0..1

struct Geometry {
  double focal_px = 0.0;
  double cx_px = 0.0;
  double cy_px = 0.0;

  [[nodiscard]] bool on_road(int u, int v) const {
    const double drop = v - cy_px;
    return drop > focal_px * 1.65 / 30.0 && std::abs(u - cx_px) < drop;
  }
};

Geometry read_geometry(const fs::path& file) {
  std::ifstream in(file);
  std::string name;
  double skip = 0.0;
  Geometry g;
  if (!(in >> name >> g.focal_px >> skip >> g.cx_px >> skip >> skip >> skip >> g.cy_px) ||
      name != "P0:") {
    throw std::invalid_argument(file.string() + ": no P0 row");
  }
  return g;
}

std::vector<fs::path> list_images(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> images;
  for (const auto& entry : fs::directory_iterator(folder / "image_0", error)) {
    if (entry.path().extension() == ".png") images.push_back(entry.path());
  }
  if (images.empty())
    throw std::invalid_argument((folder / "image_0").string() + ": no PNG images");
  std::sort(images.begin(), images.end());
  return images;
}

cv::Mat load(const fs::path& file) {
  cv::Mat image = cv::imread(file.string(), cv::IMREAD_UNCHANGED);
  if (image.empty() || image.type() != CV_8UC1)
    throw std::invalid_argument(file.string() + ": not an 8-bit grey image");
  return image;
}

double percentile(std::vector<float>& values, double share) {
  if (values.empty()) return 0.0;
  const auto k = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + k, values.end());
  return static_cast<double>(values[static_cast<std::size_t>(k)]);
}

/// Sums up row spectra and fits a straight line in log-log.
class Spectrum {
 public:
  void add(const cv::Mat& image, int u, int v) {
    cv::Mat row;
    image(cv::Rect(u, v, kWindow, 1)).convertTo(row, CV_32F);
    row -= cv::mean(row)[0];
    for (int k = 0; k < kWindow; ++k)
      row.at<float>(0, k) *= static_cast<float>(0.5 - 0.5 * std::cos(2.0 * CV_PI * k / kWindow));
    cv::Mat transformed;
    cv::dft(row, transformed, cv::DFT_COMPLEX_OUTPUT);
    for (int k = 0; k < kWindow / 2; ++k) {
      const auto c = transformed.at<cv::Vec2f>(0, k);
      power_[static_cast<std::size_t>(k)] += static_cast<double>(c[0] * c[0] + c[1] * c[1]);
    }
  }
  [[nodiscard]] double slope() const {
    double n = 0.0;
    double sx = 0.0;
    double sy = 0.0;
    double sxx = 0.0;
    double sxy = 0.0;
    for (std::size_t k = 4; k <= 64; ++k) {
      const double x = std::log(static_cast<double>(k));
      const double y = std::log(power_[k] + 1e-9);
      const double w = 1.0 / static_cast<double>(k);  // equal weight per octave
      n += w;
      sx += w * x;
      sy += w * y;
      sxx += w * x * x;
      sxy += w * x * y;
    }
    return (n * sxy - sx * sy) / (n * sxx - sx * sx);
  }

 private:
  std::array<double, kWindow / 2> power_{};
};

struct Gathered {
  std::vector<float> gradient;
  std::vector<float> road_gradient;
  std::vector<float> block_noise;
  Spectrum spectrum;
  Spectrum road_spectrum;
  double road_sum = 0.0;
  double saturated = 0.0;
  double pixels = 0.0;
  double cells = 0.0;
  double corner_cells = 0.0;
  double road_cells = 0.0;
  double road_corner_cells = 0.0;
};

void gather_pixels(const cv::Mat& image, const Geometry& geometry, Gathered& all) {
  for (int v = 1; v + 1 < image.rows; ++v) {
    for (int u = 1; u + 1 < image.cols; ++u) {
      const int gx = image.at<std::uint8_t>(v, u + 1) - image.at<std::uint8_t>(v, u - 1);
      const int gy = image.at<std::uint8_t>(v + 1, u) - image.at<std::uint8_t>(v - 1, u);
      const float g = 0.5F * std::sqrt(static_cast<float>(gx * gx + gy * gy));
      all.gradient.push_back(g);
      all.saturated += image.at<std::uint8_t>(v, u) >= 254 ? 1.0 : 0.0;
      all.pixels += 1.0;
      if (!geometry.on_road(u, v)) continue;
      all.road_gradient.push_back(g);
      all.road_sum += image.at<std::uint8_t>(v, u);
    }
  }
}

void gather_blocks(const cv::Mat& image, const Geometry& geometry, Gathered& all) {
  cv::Mat values;
  image.convertTo(values, CV_32F, 1.0 / 255.0);
  cv::Mat strength;
  cv::cornerMinEigenVal(values, strength, 5, 3);
  constexpr int kCell = 32;
  for (int v = 0; v + kCell <= image.rows; v += kCell) {
    for (int u = 0; u + kCell <= image.cols; u += kCell) {
      double best = 0.0;
      cv::minMaxLoc(strength(cv::Rect(u, v, kCell, kCell)), nullptr, &best);
      const bool corner = best > static_cast<double>(kCornerStrength);
      all.cells += 1.0;
      all.corner_cells += corner ? 1.0 : 0.0;
      if (!geometry.on_road(u + kCell / 2, v + kCell / 2)) continue;
      all.road_cells += 1.0;
      all.road_corner_cells += corner ? 1.0 : 0.0;
    }
  }
  const cv::Mat kernel = (cv::Mat_<float>(3, 3) << 1, -2, 1, -2, 4, -2, 1, -2, 1) / 6.0F;
  cv::Mat residual;
  image.convertTo(values, CV_32F);
  cv::filter2D(values, residual, CV_32F, kernel);
  for (int v = 8; v + 24 <= image.rows; v += 16) {
    for (int u = 8; u + 24 <= image.cols; u += 16) {
      const double mean = cv::mean(values(cv::Rect(u, v, 16, 16)))[0];
      if (mean < 30.0 || mean > 200.0) continue;
      all.block_noise.push_back(
          static_cast<float>(cv::norm(residual(cv::Rect(u, v, 16, 16))) / 16.0));
    }
  }
}

void gather_spectra(const cv::Mat& image, const Geometry& geometry, Gathered& all) {
  for (int v = 4; v < image.rows; v += 9) {
    for (int u = 0; u + kWindow <= image.cols; u += kWindow / 2) {
      all.spectrum.add(image, u, v);
      if (geometry.on_road(u, v) && geometry.on_road(u + kWindow - 1, v))
        all.road_spectrum.add(image, u, v);
    }
  }
}

/// Share of corners that Lucas-Kanade follows there and back through 5 and 10 frames.
void measure_tracking(const std::vector<fs::path>& images, DriveStats& stats) {
  constexpr int kSpan = 10;
  double started = 0.0;
  double after_5 = 0.0;
  double after_10 = 0.0;
  const std::size_t stride = std::max<std::size_t>(kSpan + 1, images.size() / 4);
  for (std::size_t first = 0; first + kSpan < images.size(); first += stride) {
    cv::Mat previous = load(images[first]);
    std::vector<cv::Point2f> points;
    cv::goodFeaturesToTrack(previous, points, 500, 0.004, 12.0);
    started += static_cast<double>(points.size());
    for (std::size_t k = 1; k <= kSpan && !points.empty(); ++k) {
      const cv::Mat next = load(images[first + k]);
      std::vector<cv::Point2f> forward;
      std::vector<cv::Point2f> back;
      std::vector<std::uint8_t> ok;
      std::vector<std::uint8_t> ok_back;
      std::vector<float> error;
      cv::calcOpticalFlowPyrLK(previous, next, points, forward, ok, error, {21, 21}, 4);
      cv::calcOpticalFlowPyrLK(next, previous, forward, back, ok_back, error, {21, 21}, 4);
      std::vector<cv::Point2f> kept;
      for (std::size_t i = 0; i < points.size(); ++i) {
        const bool inside = forward[i].x > 8 && forward[i].y > 8 &&
                            forward[i].x < static_cast<float>(next.cols - 9) &&
                            forward[i].y < static_cast<float>(next.rows - 9);
        if (ok[i] && ok_back[i] && inside && cv::norm(back[i] - points[i]) < 0.5)
          kept.push_back(forward[i]);
      }
      points = kept;
      previous = next;
      if (k == 5) after_5 += static_cast<double>(points.size());
      if (k == kSpan) after_10 += static_cast<double>(points.size());
    }
  }
  stats.survive_5_percent = started > 0.0 ? 100.0 * after_5 / started : 0.0;
  stats.survive_10_percent = started > 0.0 ? 100.0 * after_10 / started : 0.0;
}

}  // namespace

DriveStats measure_drive(const fs::path& folder) {
  const std::vector<fs::path> images = list_images(folder);
  const Geometry geometry = read_geometry(folder / "calib.txt");
  Gathered all;
  DriveStats out;
  out.name = folder.filename().empty() ? folder.parent_path().filename().string()
                                       : folder.filename().string();
  out.frames = static_cast<int>(images.size());
  const std::size_t stride = std::max<std::size_t>(1, images.size() / 12);
  double used = 0.0;
  for (std::size_t i = 0; i < images.size(); i += stride, used += 1.0) {
    const cv::Mat image = load(images[i]);
    cv::Scalar mean;
    cv::Scalar sd;
    cv::meanStdDev(image, mean, sd);
    out.mean += mean[0];
    out.sd += sd[0];
    gather_pixels(image, geometry, all);
    gather_blocks(image, geometry, all);
    gather_spectra(image, geometry, all);
  }
  out.mean /= used;
  out.sd /= used;
  out.saturated_percent = 100.0 * all.saturated / all.pixels;
  out.road_mean = all.road_sum / std::max(1.0, static_cast<double>(all.road_gradient.size()));
  double steep = 0.0;
  for (const float g : all.road_gradient) steep += g > 8.0F ? 1.0 : 0.0;
  out.road_over_8_percent =
      100.0 * steep / std::max(1.0, static_cast<double>(all.road_gradient.size()));
  out.gradient_median = percentile(all.gradient, 0.5);
  out.gradient_p90 = percentile(all.gradient, 0.9);
  out.road_gradient_median = percentile(all.road_gradient, 0.5);
  out.road_gradient_p90 = percentile(all.road_gradient, 0.9);
  out.spectrum_slope = all.spectrum.slope();
  out.road_spectrum_slope = all.road_spectrum.slope();
  out.noise = percentile(all.block_noise, 0.05);
  out.corner_cells_percent = 100.0 * all.corner_cells / std::max(1.0, all.cells);
  out.road_corner_cells_percent = 100.0 * all.road_corner_cells / std::max(1.0, all.road_cells);
  measure_tracking(images, out);
  return out;
}

std::string stats_table(const std::vector<DriveStats>& drives) {
  std::ostringstream out;
  out << "| drive | frames | mean | sd | white % | grad p50 | p90 | slope | noise | corner cells % "
         "| road mean | road grad p50 | p90 | "
         "> 8 % | slope | corner cells % | tracks left after 5, 10 frames % |\n";
  out << "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const DriveStats& d : drives) {
    std::array<char, 512> row{};
    std::snprintf(row.data(), row.size(),
                  "| %s | %d | %.0f | %.0f | %.1f | %.1f | %.1f | %.2f | %.2f | %.0f | %.0f | %.1f "
                  "| %.1f | %.1f | %.2f | %.0f | %.0f, %.0f |\n",
                  d.name.c_str(), d.frames, d.mean, d.sd, d.saturated_percent, d.gradient_median,
                  d.gradient_p90, d.spectrum_slope, d.noise, d.corner_cells_percent, d.road_mean,
                  d.road_gradient_median, d.road_gradient_p90, d.road_over_8_percent,
                  d.road_spectrum_slope, d.road_corner_cells_percent, d.survive_5_percent,
                  d.survive_10_percent);
    out << row.data();
  }
  return out.str();
}

}  // namespace plumb::synth
