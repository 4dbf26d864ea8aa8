/// Makes pictures of a drive without a renderer. The camera sees a window of a random texture,
/// which is flat at the top like a sky. The window grows smaller as the car drives on.
#pragma once

#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/image_view.hpp"

namespace plumb::test {

inline ImageView view_of(const cv::Mat& image) {
  return {image.data, image.cols, image.rows, static_cast<std::ptrdiff_t>(image.step)};
}

inline cv::Mat with_noise(const cv::Mat& image, double grey_std, int seed) {
  cv::theRNG().state = static_cast<std::uint64_t>(seed) * 7919U + 1U;
  cv::Mat sum;
  cv::Mat noise(image.size(), CV_32F);
  image.convertTo(sum, CV_32F);
  cv::randn(noise, 0.0, grey_std);
  sum += noise;
  sum.convertTo(sum, CV_8U);
  return sum;
}

inline cv::Mat with_jpeg(const cv::Mat& image, int quality) {
  std::vector<std::uint8_t> bytes;
  cv::imencode(".jpg", image, bytes, {cv::IMWRITE_JPEG_QUALITY, quality});
  return cv::imdecode(bytes, cv::IMREAD_GRAYSCALE);
}

class PictureScene {
 public:
  static constexpr int kWidth = 640;
  static constexpr int kHeight = 360;

  explicit PictureScene(int seed) : world_(2 * kHeight, 2 * kWidth, CV_32F) {
    cv::theRNG().state = static_cast<std::uint64_t>(seed) + 100U;
    cv::Mat layer(world_.size(), CV_32F);
    world_ = cv::Scalar(120.0);
    for (const double size_px : {2.0, 6.0, 20.0, 60.0}) {
      // Fine texture has 11 grey levels and coarse texture 5, as a near road and houses have.
      cv::randn(layer, 0.0, (size_px < 10.0 ? 40.0 : 18.0) * size_px);
      cv::GaussianBlur(layer, layer, {}, size_px);
      world_ += layer;
    }
    for (int v = 0; v < world_.rows; ++v) {
      const float sky = static_cast<float>(std::clamp(1.6 - v / (0.3 * world_.rows), 0.0, 1.0));
      for (int u = 0; u < world_.cols; ++u) {
        float& grey = world_.at<float>(v, u);
        grey = std::clamp((1.0F - sky) * grey + sky * 210.0F, 10.0F, 245.0F);
      }
    }
  }

  /// Returns the picture after `driven_m`, with the camera nodded down by `nod_px`. The visible
  /// scenery is 10 m ahead and changes every 5 m.
  [[nodiscard]] cv::Mat show(double driven_m, double nod_px = 0.0) const {
    const double zoom = std::exp(std::fmod(driven_m, 5.0) / 10.0);
    const double place_px = 173.0 * std::floor(driven_m / 5.0);
    const double u = kWidth / 2.0 - zoom * (kWidth + 37.0 + place_px);
    const double v = kHeight / 2.0 - zoom * (kHeight - 11.0) + nod_px;
    const cv::Matx23d map(zoom, 0.0, u, 0.0, zoom, v);
    cv::Mat image;
    cv::warpAffine(world_, image, map, {kWidth, kHeight}, cv::INTER_LINEAR, cv::BORDER_WRAP);
    image.convertTo(image, CV_8U);
    return image;
  }

 private:
  cv::Mat world_;
};

}  // namespace plumb::test
