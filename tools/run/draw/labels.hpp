/// Text on a picture that stays readable: its size follows the picture's width, it stands on a dark
/// backdrop, and labels do not cover each other.
///
/// Sizes:
///   A picture that is shown 640 pixels wide has letters about 10 pixels high.
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace plumb {

/// Sizes [px] for a picture of a given width.
struct LabelStyle {
  explicit LabelStyle(int picture_width_px);

  double font_scale;
  int line_width;   ///< of lines that are drawn
  int text_width;   ///< of the strokes of letters
  int line_height;  ///< from one line of text to the next
  int gap;          ///< around text and between items

  [[nodiscard]] cv::Size size_of(const std::string& text) const;
  /// Draws text whose left end stands on `base`.
  void draw(cv::Mat* picture, const std::string& text, const cv::Point& base,
            const cv::Scalar& colour) const;
};

/// Places labels, the important ones first.
class LabelPlacer {
 public:
  LabelPlacer(cv::Mat* picture, const LabelStyle& style) : picture_(picture), style_(style) {}

  /// Keeps labels away from a region.
  void reserve(const cv::Rect& region) { taken_.push_back(region); }
  /// Writes `text` beside `anchor`: above it, right of it, or below it, wherever it covers no label
  /// and stays in the picture. Leaves it out when there is no such place, and returns false.
  bool place(const std::string& text, const cv::Point& anchor, const cv::Scalar& colour);

 private:
  [[nodiscard]] bool is_free(const cv::Rect& box) const;

  cv::Mat* picture_;
  const LabelStyle& style_;
  std::vector<cv::Rect> taken_;
};

/// A word in the strip below a picture. With a colour it is an entry of the key.
struct StripItem {
  std::string text;
  bool has_colour = false;
  cv::Scalar colour;
};

/// The picture with a dark strip below it, which holds the items in as many lines as they need.
/// Each paragraph begins a line.
[[nodiscard]] cv::Mat with_strip(const cv::Mat& picture, const LabelStyle& style,
                                 const std::vector<std::vector<StripItem>>& paragraphs);

}  // namespace plumb
