#include "tools/run/draw/overlay.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <opencv2/imgproc.hpp>

namespace plumb {
namespace {

const cv::Scalar kRoadColour(80, 220, 120);
const cv::Scalar kHorizonColour(60, 160, 255);
const cv::Scalar kPathColour(255, 200, 80);
const cv::Scalar kTextColour(255, 255, 255);
const cv::Scalar kObjectColour(90, 90, 255);
const cv::Scalar kPredictedColour(200, 120, 200);
constexpr double kNearest_m = 4.0;
constexpr double kNearestPoint_m = 0.5;
constexpr double kWidestRatio =
    1.5;  ///< farther off the axis, the radial terms fold the image over
constexpr double kFarthest_m = 40.0;
constexpr double kHalfWidth_m = 3.6;

cv::Point2d to_point(const Eigen::Vector2d& px) { return {px.x(), px.y()}; }

/// Point on the plane `right_m` to the right of and `ahead_m` ahead of the camera.
Eigen::Vector3d on_road(const RoadPlane& plane, double right_m, double ahead_m) {
  const Eigen::Vector3d& n = plane.normal_cam;
  const double down_m = (plane.height_m - n.x() * right_m - n.z() * ahead_m) / n.y();
  return {right_m, down_m, ahead_m};
}

void draw_road_line(cv::Mat* picture, const CameraModel& camera, const Eigen::Vector3d& from,
                    const Eigen::Vector3d& to) {
  constexpr int kPieces = 24;  // The residual radial term bends straight lines.
  cv::Point2d last = to_point(camera.project(from));
  for (int i = 1; i <= kPieces; ++i) {
    const double share = static_cast<double>(i) / kPieces;
    const cv::Point2d next = to_point(camera.project(from + share * (to - from)));
    cv::line(*picture, last, next, kRoadColour, 1, cv::LINE_AA);
    last = next;
  }
}

void draw_road(cv::Mat* picture, const CameraModel& camera, const RoadPlane& plane) {
  for (double right = -kHalfWidth_m; right <= kHalfWidth_m + 0.1; right += 1.8) {
    draw_road_line(picture, camera, on_road(plane, right, kNearest_m),
                   on_road(plane, right, kFarthest_m));
  }
  for (const double ahead : {5.0, 10.0, 15.0, 20.0, 30.0, 40.0}) {
    draw_road_line(picture, camera, on_road(plane, -kHalfWidth_m, ahead),
                   on_road(plane, kHalfWidth_m, ahead));
    const cv::Point2d label = to_point(camera.project(on_road(plane, kHalfWidth_m, ahead)));
    cv::putText(*picture, std::to_string(static_cast<int>(ahead)) + " m", label + cv::Point2d(4, 4),
                cv::FONT_HERSHEY_SIMPLEX, 0.4, kRoadColour, 1, cv::LINE_AA);
  }
  const double row = horizon_row_px(camera, plane);
  const double slope = -plane.normal_cam.x() / plane.normal_cam.y();
  const auto width = static_cast<double>(picture->cols);
  cv::line(*picture, cv::Point2d(0.0, row - slope * camera.cx_px),
           cv::Point2d(width, row + slope * (width - camera.cx_px)), kHorizonColour, 1,
           cv::LINE_AA);
}

/// Corners in cam: the underside, then the top, both in order around the box.
std::array<Eigen::Vector3d, 8> corners_of(const ObjectFigure& object, const RoadPlane& plane) {
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
void draw_edge(cv::Mat* picture, const CameraModel& camera, const Eigen::Vector3d& from,
               const Eigen::Vector3d& to, const cv::Scalar& colour) {
  constexpr int kPieces = 16;
  Eigen::Vector3d last = from;
  for (int i = 1; i <= kPieces; ++i) {
    const Eigen::Vector3d next = from + static_cast<double>(i) / kPieces * (to - from);
    if (is_in_sight(last) && is_in_sight(next)) {
      cv::line(*picture, to_point(camera.project(last)), to_point(camera.project(next)), colour, 1,
               cv::LINE_AA);
    }
    last = next;
  }
}

void draw_object(cv::Mat* picture, const CameraModel& camera, const RoadPlane& plane,
                 const ObjectFigure& object) {
  const std::array<Eigen::Vector3d, 8> corners = corners_of(object, plane);
  const cv::Scalar& colour = object.measured ? kObjectColour : kPredictedColour;
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t next = (i + 1) % 4;
    draw_edge(picture, camera, corners[i], corners[next], colour);
    draw_edge(picture, camera, corners[i + 4], corners[next + 4], colour);
    draw_edge(picture, camera, corners[i], corners[i + 4], colour);
  }
  if (!is_in_sight(corners[7])) return;
  cv::putText(*picture, object.label, to_point(camera.project(corners[7])) + cv::Point2d(0, -4),
              cv::FONT_HERSHEY_SIMPLEX, 0.4, colour, 1, cv::LINE_AA);
}

/// Path seen from above in the upper right corner, forward is up.
void draw_path(cv::Mat* picture, const std::vector<Eigen::Vector2d>& path_m) {
  if (path_m.size() < 2) return;
  constexpr int kSize = 150, kMargin = 10;
  const cv::Rect box(picture->cols - kSize - kMargin, kMargin, kSize, kSize);
  if (box.x < 0 || box.br().y > picture->rows) return;
  (*picture)(box) *= 0.45;
  Eigen::Vector2d low = path_m.front(), high = path_m.front();
  for (const Eigen::Vector2d& p : path_m) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const double span_m = std::max({high.x() - low.x(), high.y() - low.y(), 1.0});
  const double scale = (kSize - 20) / span_m;
  const Eigen::Vector2d middle = 0.5 * (low + high);
  const auto place = [&](const Eigen::Vector2d& p) {
    return cv::Point2d(box.x + kSize / 2 + scale * (p.x() - middle.x()),
                       box.y + kSize / 2 - scale * (p.y() - middle.y()));
  };
  for (std::size_t i = 1; i < path_m.size(); ++i) {
    cv::line(*picture, place(path_m[i - 1]), place(path_m[i]), kPathColour, 1, cv::LINE_AA);
  }
  cv::circle(*picture, place(path_m.back()), 3, kPathColour, cv::FILLED, cv::LINE_AA);
}

}  // namespace

double horizon_row_px(const CameraModel& camera, const RoadPlane& plane) {
  return camera.cy_px - camera.fy_px * plane.normal_cam.z() / plane.normal_cam.y();
}

cv::Mat draw_overlay(const cv::Mat& grey, const CameraModel& camera, const FrameFigures& figures) {
  cv::Mat picture;
  cv::cvtColor(grey, picture, cv::COLOR_GRAY2BGR);
  if (figures.plane) draw_road(&picture, camera, *figures.plane);
  if (figures.plane) {
    for (const ObjectFigure& object : figures.objects)
      draw_object(&picture, camera, *figures.plane, object);
  }
  draw_path(&picture, figures.path_m);
  int row = 22;
  for (const std::string& line : figures.lines) {
    cv::putText(picture, line, {12, row}, cv::FONT_HERSHEY_SIMPLEX, 0.5, {0, 0, 0}, 3, cv::LINE_AA);
    cv::putText(picture, line, {12, row}, cv::FONT_HERSHEY_SIMPLEX, 0.5, kTextColour, 1,
                cv::LINE_AA);
    row += 20;
  }
  return picture;
}

}  // namespace plumb
