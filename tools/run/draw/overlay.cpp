#include "tools/run/draw/overlay.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <opencv2/imgproc.hpp>

#include "tools/run/draw/labels.hpp"

namespace plumb {
namespace {

const cv::Scalar kRoadColour(80, 220, 120);
const cv::Scalar kHorizonColour(60, 160, 255);
const cv::Scalar kPathColour(255, 200, 80);
const cv::Scalar kObjectColour(90, 90, 255);
const cv::Scalar kPredictedColour(240, 150, 230);
const cv::Scalar kStaticColour(255, 184, 168);
const cv::Scalar kMovingColour(255, 77, 255);
const cv::Scalar kAttachedColour(0, 92, 255);
const cv::Scalar kUndecidedColour(177, 165, 154);
constexpr double kNearest_m = 4.0;
constexpr double kNearestPoint_m = 0.5;
constexpr double kWidestRatio =
    1.5;  ///< farther off the axis, the radial terms fold the image over
constexpr double kFarthest_m = 40.0;
constexpr double kHalfWidth_m = 3.6;

cv::Point2d to_point(const Eigen::Vector2d& px) { return {px.x(), px.y()}; }

/// Point on the plane `right_m` to the right of and `ahead_m` ahead of the camera.
Eigen::Vector3d on_road(const PlaneFigure& plane, double right_m, double ahead_m) {
  const Eigen::Vector3d& n = plane.normal_cam;
  const double down_m = (plane.height_m - n.x() * right_m - n.z() * ahead_m) / n.y();
  return {right_m, down_m, ahead_m};
}

/// What everything is drawn on.
struct Canvas {
  cv::Mat* picture;
  const CameraModel& camera;
  const LabelStyle& style;
};

void draw_road_line(const Canvas& canvas, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  constexpr int kPieces = 24;  // The residual radial term bends straight lines.
  cv::Point2d last = to_point(canvas.camera.project(from));
  for (int i = 1; i <= kPieces; ++i) {
    const double share = static_cast<double>(i) / kPieces;
    const cv::Point2d next = to_point(canvas.camera.project(from + share * (to - from)));
    cv::line(*canvas.picture, last, next, kRoadColour, canvas.style.line_width, cv::LINE_AA);
    last = next;
  }
}

void draw_road(const Canvas& canvas, const PlaneFigure& plane) {
  for (double right = -kHalfWidth_m; right <= kHalfWidth_m + 0.1; right += 1.8) {
    draw_road_line(canvas, on_road(plane, right, kNearest_m), on_road(plane, right, kFarthest_m));
  }
  for (const double ahead : {5.0, 10.0, 15.0, 20.0, 30.0, 40.0}) {
    draw_road_line(canvas, on_road(plane, -kHalfWidth_m, ahead),
                   on_road(plane, kHalfWidth_m, ahead));
  }
  const CameraModel& camera = canvas.camera;
  const double row = horizon_row_px(camera, plane);
  const double slope = -plane.normal_cam.x() / plane.normal_cam.y();
  const auto width = static_cast<double>(canvas.picture->cols);
  cv::line(*canvas.picture, cv::Point2d(0.0, row - slope * camera.cx_px),
           cv::Point2d(width, row + slope * (width - camera.cx_px)), kHorizonColour,
           canvas.style.line_width, cv::LINE_AA);
}

/// Distances beside the grid; those that say most come first.
void label_road(const Canvas& canvas, const PlaneFigure& plane, LabelPlacer* labels) {
  for (const int ahead : {10, 20, 40, 5, 30, 15}) {
    const cv::Point2d end = to_point(canvas.camera.project(on_road(plane, kHalfWidth_m, ahead)));
    labels->place(std::to_string(ahead) + " m", end, kRoadColour);
  }
}

/// Corners in cam: the underside, then the top, both in order around the box.
std::array<Eigen::Vector3d, 8> corners_of(const ObjectFigure& object, const PlaneFigure& plane) {
  const Eigen::Vector3d& down = plane.normal_cam;
  const Eigen::Vector3d ahead =
      (Eigen::Vector3d::UnitZ() - down.z() * down).normalized();  // optical axis, along the road
  const Eigen::Vector3d left = ahead.cross(down);
  const Eigen::Vector3d origin = plane.height_m * down;
  const Eigen::Rotation2Dd turn(object.yaw_rad);
  std::array<Eigen::Vector3d, 8> corners;
  const double around[4][2] = {{0.5, 0.5}, {0.5, -0.5}, {-0.5, -0.5}, {-0.5, 0.5}};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto& share = around[i % 4];
    const Eigen::Vector2d place =
        object.place_m +
        turn * Eigen::Vector2d(share[0] * object.size_m.x(), share[1] * object.size_m.y());
    const double up_m = i < 4 ? 0.0 : object.size_m.z();
    corners[i] = origin + place.x() * ahead + place.y() * left - up_m * down;
  }
  return corners;
}

bool is_in_sight(const Eigen::Vector3d& p_cam) {
  return p_cam.z() > kNearestPoint_m &&
         p_cam.head<2>().cwiseAbs().maxCoeff() < kWidestRatio * p_cam.z();
}

/// The visible part of an edge. The image's border cuts objects beside the camera.
void draw_edge(const Canvas& canvas, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
               const cv::Scalar& colour) {
  constexpr int kPieces = 16;
  Eigen::Vector3d last = from;
  for (int i = 1; i <= kPieces; ++i) {
    const Eigen::Vector3d next = from + static_cast<double>(i) / kPieces * (to - from);
    if (is_in_sight(last) && is_in_sight(next)) {
      cv::line(*canvas.picture, to_point(canvas.camera.project(last)),
               to_point(canvas.camera.project(next)), colour, canvas.style.line_width, cv::LINE_AA);
    }
    last = next;
  }
}

void draw_object(const Canvas& canvas, const PlaneFigure& plane, const ObjectFigure& object) {
  const std::array<Eigen::Vector3d, 8> corners = corners_of(object, plane);
  const cv::Scalar& colour = object.measured ? kObjectColour : kPredictedColour;
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t next = (i + 1) % 4;
    draw_edge(canvas, corners[i], corners[next], colour);
    draw_edge(canvas, corners[i + 4], corners[next + 4], colour);
    draw_edge(canvas, corners[i], corners[i + 4], colour);
  }
}

/// Labels the near objects first: where there is no room, it is the far ones that go without.
void label_objects(const Canvas& canvas, const PlaneFigure& plane,
                   std::vector<ObjectFigure> objects, LabelPlacer* labels) {
  std::sort(objects.begin(), objects.end(), [](const ObjectFigure& a, const ObjectFigure& b) {
    return a.place_m.squaredNorm() < b.place_m.squaredNorm();
  });
  for (const ObjectFigure& object : objects) {
    // The upper left corner in the picture, of those that are in sight.
    std::optional<cv::Point2d> anchor;
    for (const Eigen::Vector3d& corner : corners_of(object, plane)) {
      if (!is_in_sight(corner)) continue;
      const cv::Point2d px = to_point(canvas.camera.project(corner));
      anchor = anchor ? cv::Point2d(std::min(anchor->x, px.x), std::min(anchor->y, px.y)) : px;
    }
    if (!anchor || object.label.empty()) continue;
    labels->place(object.label, *anchor, object.measured ? kObjectColour : kPredictedColour);
  }
}

/// Kinds differ in shape as well as in colour: dots, crosses, squares and small dots.
void draw_feature(const Canvas& canvas, const Feature& feature) {
  const cv::Point2d at = to_point(feature.px.cast<double>());
  const int unit = canvas.style.line_width;
  cv::Mat& picture = *canvas.picture;
  switch (feature.kind) {
    case FeatureKind::kStatic:
      cv::circle(picture, at, unit, kStaticColour, cv::FILLED, cv::LINE_AA);
      break;
    case FeatureKind::kMoving:
      cv::drawMarker(picture, at, kMovingColour, cv::MARKER_TILTED_CROSS, 5 * unit, unit,
                     cv::LINE_AA);
      break;
    case FeatureKind::kAttached:
      cv::drawMarker(picture, at, kAttachedColour, cv::MARKER_SQUARE, 5 * unit, unit, cv::LINE_AA);
      break;
    case FeatureKind::kUndecided:
      cv::circle(picture, at, (unit + 1) / 2, kUndecidedColour, cv::FILLED, cv::LINE_AA);
      break;
  }
}

/// Where the path is drawn, in the upper right corner.
cv::Rect path_box(const cv::Mat& picture) {
  const int size = std::min(picture.rows * 2 / 5, picture.cols / 5), margin = size / 16;
  return {picture.cols - size - margin, margin, size, size};
}

/// Path seen from above, forward is up.
void draw_path(const Canvas& canvas, const std::vector<Eigen::Vector2d>& path_m) {
  cv::Mat* const picture = canvas.picture;
  const cv::Rect box = path_box(*picture);
  const int size = box.width, line_width = canvas.style.line_width;
  (*picture)(box) *= 0.35;
  Eigen::Vector2d low = path_m.front(), high = path_m.front();
  for (const Eigen::Vector2d& p : path_m) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const double span_m = std::max({high.x() - low.x(), high.y() - low.y(), 1.0});
  const double scale = 0.85 * size / span_m;
  const Eigen::Vector2d middle = 0.5 * (low + high);
  const auto place = [&](const Eigen::Vector2d& p) {
    return cv::Point2d(box.x + size / 2 + scale * (p.x() - middle.x()),
                       box.y + size / 2 - scale * (p.y() - middle.y()));
  };
  for (std::size_t i = 1; i < path_m.size(); ++i) {
    cv::line(*picture, place(path_m[i - 1]), place(path_m[i]), kPathColour, line_width,
             cv::LINE_AA);
  }
  cv::circle(*picture, place(path_m.back()), 3 * line_width, kPathColour, cv::FILLED, cv::LINE_AA);
}

}  // namespace

double horizon_row_px(const CameraModel& camera, const PlaneFigure& plane) {
  return camera.cy_px - camera.fy_px * plane.normal_cam.z() / plane.normal_cam.y();
}

cv::Mat draw_overlay(const cv::Mat& grey, const CameraModel& camera, const FrameFigures& figures) {
  cv::Mat picture;
  cv::cvtColor(grey, picture, cv::COLOR_GRAY2BGR);
  const LabelStyle style(picture.cols);
  const Canvas canvas{&picture, camera, style};
  LabelPlacer labels(&picture, style);
  const bool has_path = figures.path_m.size() > 1;
  if (has_path) labels.reserve(path_box(picture));
  for (const Feature& feature : figures.features) draw_feature(canvas, feature);
  if (figures.plane) {
    draw_road(canvas, *figures.plane);
    for (const ObjectFigure& object : figures.objects) draw_object(canvas, *figures.plane, object);
    label_objects(canvas, *figures.plane, figures.objects, &labels);
    label_road(canvas, *figures.plane, &labels);
  }
  if (has_path) draw_path(canvas, figures.path_m);
  std::vector<StripItem> words;
  for (const std::string& line : figures.lines) words.push_back({line, false, {}});
  std::vector<StripItem> key = {{"road grid", true, kRoadColour},
                                {"horizon", true, kHorizonColour},
                                {"object measured", true, kObjectColour},
                                {"object predicted", true, kPredictedColour},
                                {"path from above", true, kPathColour}};
  if (!figures.features.empty()) {
    key.push_back({"feature static", true, kStaticColour});
    key.push_back({"moving", true, kMovingColour});
    key.push_back({"attached", true, kAttachedColour});
    key.push_back({"undecided", true, kUndecidedColour});
  }
  return with_strip(picture, style, {words, key});
}

}  // namespace plumb
