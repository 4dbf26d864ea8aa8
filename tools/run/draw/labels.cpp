#include "tools/run/draw/labels.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace plumb {
namespace {

constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
constexpr double kShownWidth_px = 640.0;
const cv::Scalar kStripColour(32, 28, 26);
const cv::Scalar kWordColour(240, 240, 240);

struct PlacedItem {
  StripItem item;
  cv::Point base;
};

}  // namespace

LabelStyle::LabelStyle(int picture_width_px) {
  const double enlarged = std::max(1.0, picture_width_px / kShownWidth_px);
  font_scale = 0.42 * enlarged;
  line_width = std::max(1, static_cast<int>(std::lround(enlarged)));
  text_width = std::max(1, static_cast<int>(std::lround(0.9 * enlarged)));
  line_height = static_cast<int>(std::lround(18.0 * enlarged));
  gap = static_cast<int>(std::lround(3.0 * enlarged));
}

cv::Size LabelStyle::size_of(const std::string& text) const {
  int below = 0;
  return cv::getTextSize(text, kFont, font_scale, text_width, &below);
}

void LabelStyle::draw(cv::Mat* picture, const std::string& text, const cv::Point& base,
                      const cv::Scalar& colour) const {
  cv::putText(*picture, text, base, kFont, font_scale, colour, text_width, cv::LINE_AA);
}

bool LabelPlacer::is_free(const cv::Rect& box) const {
  const cv::Rect frame(0, 0, picture_->cols, picture_->rows);
  return (box & frame) == box && std::none_of(taken_.begin(), taken_.end(), [&](const cv::Rect& t) {
           return (t & box).area() > 0;
         });
}

bool LabelPlacer::place(const std::string& text, const cv::Point& anchor,
                        const cv::Scalar& colour) {
  const cv::Size size = style_.size_of(text) + cv::Size(2 * style_.gap, 2 * style_.gap);
  const cv::Point corners[] = {
      {anchor.x, anchor.y - style_.gap - size.height},                    // above
      {anchor.x + style_.gap, anchor.y - size.height / 2},                // right
      {anchor.x, anchor.y + style_.gap},                                  // below
      {anchor.x - size.width - style_.gap, anchor.y - size.height / 2}};  // left
  for (const cv::Point& corner : corners) {
    const cv::Rect box(corner, size);
    if (!is_free(box)) continue;
    (*picture_)(box) *= 0.35;
    style_.draw(picture_, text, {box.x + style_.gap, box.br().y - style_.gap}, colour);
    taken_.push_back(box);
    return true;
  }
  return false;
}

cv::Mat with_strip(const cv::Mat& picture, const LabelStyle& style,
                   const std::vector<std::vector<StripItem>>& paragraphs) {
  std::vector<PlacedItem> placed;
  const int swatch = style.line_height, space = 4 * style.gap;
  int row = 0;
  for (const std::vector<StripItem>& paragraph : paragraphs) {
    int left = space;
    ++row;
    for (const StripItem& item : paragraph) {
      const int width = style.size_of(item.text).width + (item.has_colour ? swatch : 0);
      if (left > space && left + width + space > picture.cols) {
        left = space;
        ++row;
      }
      placed.push_back({item, {left, row * style.line_height}});
      left += width + space;
    }
  }
  cv::Mat out(picture.rows + row * style.line_height + 2 * style.gap, picture.cols, picture.type(),
              kStripColour);
  picture.copyTo(out.rowRange(0, picture.rows));
  for (const PlacedItem& place : placed) {
    cv::Point base = place.base + cv::Point(0, picture.rows);
    if (place.item.has_colour) {
      const cv::Point middle = base - cv::Point(0, style.size_of("x").height / 2);
      cv::line(out, middle, middle + cv::Point(swatch - 2 * style.gap, 0), place.item.colour,
               2 * style.line_width, cv::LINE_AA);
      base.x += swatch;
    }
    style.draw(&out, place.item.text, base, kWordColour);
  }
  return out;
}

}  // namespace plumb
