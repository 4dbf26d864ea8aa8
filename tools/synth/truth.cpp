#include "tools/synth/truth.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace plumb::synth {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

PlaneTruth fit(const std::vector<Vector3d>& points) {
  Vector3d mean = Vector3d::Zero();
  for (const Vector3d& p : points) mean += p;
  mean /= static_cast<double>(points.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Vector3d& p : points) scatter += (p - mean) * (p - mean).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter);
  PlaneTruth out;
  out.n_cam = solver.eigenvectors().col(0);
  if (out.n_cam.y() < 0.0) out.n_cam = -out.n_cam;
  out.height_m = out.n_cam.dot(mean);
  out.rms_m =
      std::sqrt(std::max(0.0, solver.eigenvalues()[0]) / static_cast<double>(points.size()));
  return out;
}

/// Corners of a convex solid, which are those intersections of three planes that satisfy all
/// planes.
std::vector<Vector3d> convex_corners(const Primitive& solid) {
  std::vector<Vector3d> out;
  const std::size_t n = solid.num_planes;
  for (std::size_t a = 0; a < n; ++a) {
    for (std::size_t b = a + 1; b < n; ++b) {
      for (std::size_t c = b + 1; c < n; ++c) {
        Eigen::Matrix3d A;
        A << solid.planes[a].n_local.transpose(), solid.planes[b].n_local.transpose(),
            solid.planes[c].n_local.transpose();
        if (std::abs(A.determinant()) < 1e-6) continue;
        const Vector3d x =
            A.inverse() *
            Vector3d(solid.planes[a].offset_m, solid.planes[b].offset_m, solid.planes[c].offset_m);
        const bool inside =
            std::all_of(solid.planes.begin(), solid.planes.begin() + solid.num_planes,
                        [&](const Plane& p) { return p.n_local.dot(x) <= p.offset_m + 1e-6; });
        if (inside) out.push_back(x);
      }
    }
  }
  return out;
}

struct Box {
  Vector2d low{1e9, 1e9};
  Vector2d high{-1e9, -1e9};
  [[nodiscard]] double area() const {
    return std::max(0.0, high.x() - low.x()) * std::max(0.0, high.y() - low.y());
  }
};

Box clip(Box box, const CameraModel& camera) {
  box.low = box.low.cwiseMax(Vector2d(0.0, 0.0));
  box.high = box.high.cwiseMin(Vector2d(camera.width_px - 1.0, camera.height_px - 1.0));
  return box;
}

Box project_box(const std::vector<const Primitive*>& parts, const CameraModel& camera,
                const Se3& T_cam_map) {
  Box box;
  for (const Primitive* part : parts) {
    for (const Vector3d& p_map : outline(*part)) {
      Vector3d p = T_cam_map * p_map;
      p.z() = std::max(p.z(), 0.3);  // beside or behind the camera, the box leaves the image
      const Vector2d px = camera.project(p);
      box.low = box.low.cwiseMin(px);
      box.high = box.high.cwiseMax(px);
    }
  }
  return box;
}

/// Share of the object's own pixels inside the box that the frame shows.
double visible_share(const RenderedFrame& frame, const std::vector<const Primitive*>& parts,
                     const Box& box, const CameraModel& camera, const Se3& T_map_cam,
                     std::int32_t object) {
  static const VolumeNoise no_holes(0);
  int own = 0;
  int shown = 0;
  const double step = std::max(1.0, std::sqrt(box.area() / 900.0));
  for (double v = std::ceil(box.low.y()); v <= box.high.y(); v += step) {
    for (double u = std::ceil(box.low.x()); u <= box.high.x(); u += step) {
      const int ui = static_cast<int>(u);
      const int vi = static_cast<int>(v);
      const Ray ray{T_map_cam.t, (T_map_cam.R * camera.unproject({ui, vi})).normalized()};
      Hit hit;
      const bool covers = std::any_of(parts.begin(), parts.end(), [&](const Primitive* p) {
        return intersect(*p, ray, 0.001, no_holes, hit);
      });
      if (!covers) continue;
      ++own;
      shown += frame.object[static_cast<std::size_t>(vi * frame.width_px + ui)] == object ? 1 : 0;
    }
  }
  return own > 0 ? static_cast<double>(shown) / own : 0.0;
}

void place(Label& label, const ObjectPose& pose, const Se3& T_cam_map) {
  const Se3 T_cam_object = T_cam_map * pose.T_map_object;
  const Vector3d forward = T_cam_object.R.col(0);
  label.kind = pose.kind;
  label.size_m = pose.size_m;
  label.p_cam = T_cam_object.t;
  label.rotation_y_rad = -std::atan2(forward.z(), forward.x());
  label.alpha_rad = std::remainder(
      label.rotation_y_rad - std::atan2(label.p_cam.x(), label.p_cam.z()), 6.283185307179586);
}

}  // namespace

std::vector<Vector3d> outline(const Primitive& solid) {
  std::vector<Vector3d> local;
  if (solid.shape == Shape::kConvex) {
    local = convex_corners(solid);
  } else if (solid.shape == Shape::kWheel) {
    for (int k = 0; k < 24; ++k) {
      const double a = 6.283185307179586 * k / 24.0;
      const double r = solid.half.x() / std::cos(3.14159265 / 24.0);
      for (const double side : {1.0, -1.0})
        local.emplace_back(r * std::cos(a), side * solid.half.y(), r * std::sin(a));
    }
  } else {
    for (unsigned k = 0; k < 8; ++k) {
      local.push_back(Vector3d(k & 1U ? 1.0 : -1.0, k & 2U ? 1.0 : -1.0, k & 4U ? 1.0 : -1.0)
                          .cwiseProduct(solid.half));
    }
  }
  for (Vector3d& p : local) p = solid.centre + solid.R_map_local * p;
  return local;
}

PlaneTruth road_plane(const Terrain& terrain, const Se3& T_map_cam) {
  const Se3 T_cam_map = T_map_cam.inverse();
  Vector2d forward = T_map_cam.R.col(2).head<2>();
  forward.normalize();
  const Vector2d right(forward.y(), -forward.x());
  std::vector<Vector3d> road;
  std::vector<Vector3d> all;
  for (double z = 4.5; z <= 20.5; z += 0.25) {
    for (double x = -1.75; x <= 1.76; x += 0.25) {
      const Vector2d p = T_map_cam.t.head<2>() + z * forward + x * right;
      const Vector3d p_cam = T_cam_map * Vector3d(p.x(), p.y(), terrain.height(p.x(), p.y()));
      if (p_cam.z() < 5.0 || p_cam.z() > 20.0) continue;
      all.push_back(p_cam);
      if (terrain.edge_distance(p.x(), p.y()) < 0.0) road.push_back(p_cam);
    }
  }
  const std::vector<Vector3d>& used = 3 * road.size() >= all.size() ? road : all;
  PlaneTruth out = fit(used);
  out.num_points = static_cast<int>(used.size());
  out.num_candidates = static_cast<int>(all.size());
  return out;
}

std::vector<Label> make_labels(const RenderedFrame& frame, const std::vector<Primitive>& solids,
                               const CameraModel& camera, const Se3& T_map_cam, int min_pixels) {
  const Se3 T_cam_map = T_map_cam.inverse();
  std::vector<int> pixels(frame.objects.size(), 0);
  for (const std::int32_t object : frame.object) {
    if (object >= 0) ++pixels[static_cast<std::size_t>(object)];
  }
  std::vector<Label> labels;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    if (pixels[i] < min_pixels) continue;
    std::vector<const Primitive*> parts;
    for (const Primitive& solid : solids) {
      if (solid.object == static_cast<std::int32_t>(i)) parts.push_back(&solid);
    }
    const Box whole = project_box(parts, camera, T_cam_map);
    const Box seen = clip(whole, camera);
    Label label;
    label.object = static_cast<std::int32_t>(i);
    place(label, frame.objects[i], T_cam_map);
    label.left_px = seen.low.x();
    label.top_px = seen.low.y();
    label.right_px = seen.high.x();
    label.bottom_px = seen.high.y();
    const double kept = seen.area() / std::max(1.0, whole.area());
    label.truncated = kept > 0.97 ? 0 : kept > 0.5 ? 1 : 2;
    const double shown = visible_share(frame, parts, seen, camera, T_map_cam, label.object);
    label.occluded = shown > 0.8 ? 0 : shown > 0.4 ? 1 : 2;
    labels.push_back(label);
  }
  return labels;
}

std::string label_row(int frame, const Label& l) {
  static constexpr std::array<const char*, 7> kTypes{"Car", "Van",  "Truck",     "Truck",
                                                     "Bus", "Tram", "Pedestrian"};
  std::array<char, 256> text{};
  std::snprintf(text.data(), text.size(),
                "%d %d %s %d %d %.6f %.6f %.6f %.6f %.6f %.6f %.6f %.6f %.6f %.6f %.6f %.6f", frame,
                l.object, kTypes[static_cast<std::size_t>(l.kind)], l.truncated, l.occluded,
                l.alpha_rad, l.left_px, l.top_px, l.right_px, l.bottom_px, l.size_m.z(),
                l.size_m.y(), l.size_m.x(), l.p_cam.x(), l.p_cam.y(), l.p_cam.z(),
                l.rotation_y_rad);
  return text.data();
}

}  // namespace plumb::synth
