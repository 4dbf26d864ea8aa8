#include "tools/synth/renderer.hpp"

#include <algorithm>
#include <cmath>

#include "tools/synth/random.hpp"

namespace plumb::synth {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kSlots = 9;  ///< exposure times with their own pose; slot kSlots/2 is the middle
constexpr int kMiddle = kSlots / 2;
constexpr double kViewDistance = 320.0;
constexpr double kNearPlane = 0.25;
constexpr int kBlurBlock = 4;

double slot_offset(int slot) { return (slot + 0.5) / kSlots - 0.5; }

}  // namespace

FrameRenderer::FrameRenderer(const World& world, const RenderConfig& config)
    : world_(world),
      config_(config),
      pixel_rad_(1.0 / config.camera.fx_px),
      tiles_x_((config.camera.width_px + kTile - 1) / kTile),
      tiles_y_((config.camera.height_px + kTile - 1) / kTile),
      tiles_(static_cast<std::size_t>(tiles_x_) * static_cast<std::size_t>(tiles_y_)) {
  const auto pixels = static_cast<std::size_t>(config.camera.width_px) *
                      static_cast<std::size_t>(config.camera.height_px);
  samples_.resize(pixels);
}

double FrameRenderer::row_time_s(double time_s, int v) const {
  const double rows = config_.camera.height_px - 1;
  return time_s + config_.readout_s * (v / rows - 0.5);
}

const Se3& FrameRenderer::pose_at(int v, int slot) const {
  const int row = config_.readout_s > 0.0 ? v : 0;
  return poses_[static_cast<std::size_t>(row * kSlots + slot)];
}

void FrameRenderer::prepare(double time_s) {
  time_s_ = time_s;
  T_map_veh_ = world_.drive.T_map_veh(time_s);
  const int rows = config_.readout_s > 0.0 ? config_.camera.height_px : 1;
  poses_.clear();
  slot_time_s_.clear();
  for (int v = 0; v < rows; ++v) {
    for (int slot = 0; slot < kSlots; ++slot) {
      const double row = rows > 1 ? row_time_s(time_s, v) : time_s;
      const double t = row + slot_offset(slot) * config_.exposure_s;
      slot_time_s_.push_back(t);
      poses_.push_back(world_.drive.T_map_cam(t));
    }
  }
  smear_ = pose_at(0, kSlots - 1).t - pose_at(0, 0).t;
  const Se3 T_map_cam = world_.drive.T_map_cam(time_s);
  const Vector3d forward = T_map_cam.R.col(2);
  const double half_view =
      std::atan(0.5 * config_.camera.width_px / config_.camera.fx_px) * 1.15 + 0.15;
  ground_rays_.build(world_.terrain, T_map_cam.t, std::atan2(forward.y(), forward.x()), half_view);
  cull(time_s);
  fill_tiles(time_s);
}

void FrameRenderer::cull(double time_s) {
  const Se3 T_cam_map = world_.drive.T_map_cam(time_s).inverse();
  const double slope = 0.55 * config_.camera.width_px / config_.camera.fx_px;
  const double sine = 1.0 / std::sqrt(1.0 + slope * slope);
  const auto in_view = [&](const Primitive& solid) {
    const Vector3d p = T_cam_map * solid.centre;
    const double r = solid.radius() + 0.5;
    if (p.z() < -r || p.z() > kViewDistance + r) return false;
    return (std::abs(p.x()) - slope * p.z()) * sine < r;
  };
  solids_.clear();
  moving_.clear();
  moving_objects_.clear();
  world_.scene.moving(time_s, moving_, moving_objects_);
  cars_.clear();
  const Vector3d eye = world_.drive.T_map_cam(time_s).t;
  const auto near_car = [&](const Primitive& solid) {
    return solid.object >= 0 && (solid.centre - eye).squaredNorm() < 80.0 * 80.0;
  };
  for (const Primitive& solid : world_.scene.still()) {
    if (in_view(solid)) solids_.push_back(solid);
    if (near_car(solid)) cars_.push_back(solid);
  }
  for (const Primitive& solid : moving_) {
    if (in_view(solid)) solids_.push_back(solid);
    if (near_car(solid)) cars_.push_back(solid);
  }
  moving_shadows_.build(moving_, world_.lighting.to_sun(), 2.0);
  above_.build(cars_, Vector3d::UnitZ(), 1.0);
}

bool FrameRenderer::image_bounds(const Primitive& solid, const Se3& T_cam_map, Vector2d& low,
                                 Vector2d& high) const {
  std::array<Vector3d, 8> corner;
  for (std::size_t k = 0; k < 8; ++k) {
    const Vector3d sign(k & 1U ? 1.0 : -1.0, k & 2U ? 1.0 : -1.0, k & 4U ? 1.0 : -1.0);
    corner[k] = T_cam_map * (solid.centre + solid.R_map_local * sign.cwiseProduct(solid.half));
  }
  bool seen = false;
  const CameraModel& camera = config_.camera;
  const auto add = [&](const Vector3d& p) {
    const Vector2d px(camera.fx_px * p.x() / p.z() + camera.cx_px,
                      camera.fy_px * p.y() / p.z() + camera.cy_px);
    low = seen ? Vector2d(low.cwiseMin(px)) : px;
    high = seen ? Vector2d(high.cwiseMax(px)) : px;
    seen = true;
  };
  for (std::size_t a = 0; a < 8; ++a) {
    if (corner[a].z() >= kNearPlane) add(corner[a]);
    for (const std::size_t bit : {1U, 2U, 4U}) {
      const std::size_t b = a | bit;
      if (b == a || (corner[a].z() < kNearPlane) == (corner[b].z() < kNearPlane)) continue;
      const double f = (kNearPlane - corner[a].z()) / (corner[b].z() - corner[a].z());
      add(corner[a] + f * (corner[b] - corner[a]));
    }
  }
  return seen;
}

void FrameRenderer::fill_tiles(double time_s) {
  for (std::vector<Candidate>& tile : tiles_) tile.clear();
  const CameraModel& camera = config_.camera;
  const double half_span = 0.5 * (config_.readout_s + config_.exposure_s);
  const std::array<double, 3> times{-half_span, 0.0, half_span};
  std::array<Se3, 3> T_cam_map;
  for (std::size_t k = 0; k < 3; ++k)
    T_cam_map[k] = world_.drive.T_map_cam(time_s + times[k]).inverse();
  const double corner2 = 0.25 * (std::pow(camera.width_px / camera.fx_px, 2) +
                                 std::pow(camera.height_px / camera.fy_px, 2));
  const double bent = std::abs(camera.residual_k1) + std::abs(camera.residual_k2) * corner2;
  const double margin = 2.0 + bent * corner2 * 0.7 * camera.width_px;
  for (std::size_t i = 0; i < solids_.size(); ++i) {
    Vector2d low(1e9, 1e9);
    Vector2d high(-1e9, -1e9);
    for (std::size_t k = 0; k < 3; ++k) {
      Primitive moved = solids_[i];
      moved.centre += times[k] * moved.velocity;
      Vector2d a;
      Vector2d b;
      if (!image_bounds(moved, T_cam_map[k], a, b)) continue;
      low = low.cwiseMin(a);
      high = high.cwiseMax(b);
    }
    if (low.x() - margin > camera.width_px || low.y() - margin > camera.height_px ||
        high.x() + margin < 0.0 || high.y() + margin < 0.0)
      continue;
    const auto tile_of = [&](double px, int last) {
      return std::clamp(static_cast<int>(std::floor(std::clamp(px, -1e6, 1e6) / kTile)), 0, last);
    };
    const double nearest = (T_cam_map[1] * solids_[i].centre).norm() - solids_[i].radius() - 1.5;
    for (int ty = tile_of(low.y() - margin, tiles_y_ - 1);
         ty <= tile_of(high.y() + margin, tiles_y_ - 1); ++ty) {
      for (int tx = tile_of(low.x() - margin, tiles_x_ - 1);
           tx <= tile_of(high.x() + margin, tiles_x_ - 1); ++tx) {
        tiles_[static_cast<std::size_t>(ty * tiles_x_ + tx)].push_back(
            {static_cast<float>(nearest), static_cast<std::int32_t>(i)});
      }
    }
  }
  for (std::vector<Candidate>& tile : tiles_) {
    std::sort(tile.begin(), tile.end(), [](const Candidate& a, const Candidate& b) {
      return a.nearest_m != b.nearest_m ? a.nearest_m < b.nearest_m : a.solid < b.solid;
    });
  }
}

float FrameRenderer::sunlight(const Patch& patch, const Reflectance& surface) const {
  if (config_.plain) return 1.0F;
  if (!world_.lighting.has_sun() || surface.n_map.dot(world_.lighting.to_sun()) <= 0.0) return 0.0F;
  const Vector3d lifted = patch.p_map + 0.02 * patch.n_map;
  constexpr double kSunBlur = 0.006;
  if (world_.still_shadows.hidden(lifted, kSunBlur, world_.textures.volume)) return 0.0F;
  return moving_shadows_.hidden(lifted, kSunBlur, world_.textures.volume) ? 0.0F : 1.0F;
}

float FrameRenderer::light_from(Reflectance surface, const Patch& patch, double distance_m) const {
  const bool lit = world_.lamps.lit();
  if (lit) surface.openness *= world_.lamps.sky_share(patch.p_map);
  float radiance = world_.lighting.answer(surface, patch.view, sunlight(patch, surface));
  if (lit) radiance += world_.lamps.answer(surface, patch, T_map_veh_);
  return config_.plain ? radiance : world_.lighting.through_air(radiance, distance_m);
}

FrameRenderer::Sample FrameRenderer::shade_solid(const Ray& ray, const Hit& hit) const {
  const Primitive& solid = solids_[static_cast<std::size_t>(hit.primitive)];
  const Patch patch{ray.origin + hit.t * ray.direction, solid.R_map_local * hit.n_local,
                    ray.direction, hit.t * pixel_rad_,
                    smear_ - config_.exposure_s * solid.velocity};
  const SolidShader shader(world_.textures);
  Reflectance surface = shader.shade(solid, hit, patch);
  if (surface.n_map.dot(ray.direction) > 0.0) surface.n_map = patch.n_map;
  Sample out;
  out.radiance = light_from(surface, patch, hit.t);
  out.distance_m = static_cast<float>(hit.t);
  out.key =
      16U + 8U * static_cast<std::uint32_t>(hit.primitive) + static_cast<std::uint32_t>(hit.face);
  out.object = solid.object;
  return out;
}

FrameRenderer::Sample FrameRenderer::shade_ground(const Ray& ray, const GroundHit& hit) const {
  Patch patch{ray.origin + hit.t * ray.direction, Vector3d::UnitZ(), ray.direction,
              hit.t * pixel_rad_, smear_};
  if (hit.part == GroundPart::kKerbFace) {
    constexpr double kStep = 0.4;
    const double x = patch.p_map.x();
    const double y = patch.p_map.y();
    patch.n_map =
        Vector3d(
            world_.terrain.edge_distance(x - kStep, y) - world_.terrain.edge_distance(x + kStep, y),
            world_.terrain.edge_distance(x, y - kStep) - world_.terrain.edge_distance(x, y + kStep),
            1e-6)
            .normalized();
  }
  Reflectance surface = world_.ground.shade(patch, hit);
  Sample out;
  if (!config_.plain &&
      above_.hidden(patch.p_map + Vector3d(0.0, 0.0, 0.02), 0.01, world_.textures.volume))
    surface.openness = 0.15F;
  out.radiance = light_from(surface, patch, hit.t);
  out.distance_m = static_cast<float>(hit.t);
  out.key = 1U + static_cast<std::uint32_t>(hit.part);
  out.object = hit.part == GroundPart::kRoad ? kRoad : kNothing;
  return out;
}

Vector3d FrameRenderer::direction(double u, double v) const {
  const CameraModel& camera = config_.camera;
  if (camera.residual_k1 != 0.0 || camera.residual_k2 != 0.0) return camera.unproject({u, v});
  return {(u - camera.cx_px) / camera.fx_px, (v - camera.cy_px) / camera.fy_px, 1.0};
}

FrameRenderer::Sample FrameRenderer::trace(double u, double v, int slot,
                                           const std::vector<Candidate>& tile) const {
  const int row = std::clamp(static_cast<int>(std::lround(v)), 0, config_.camera.height_px - 1);
  const Se3& T_map_cam = pose_at(row, slot);
  const double since_s =
      slot_time_s_[static_cast<std::size_t>((config_.readout_s > 0.0 ? row : 0) * kSlots + slot)] -
      time_s_;
  const Ray ray{T_map_cam.t, (T_map_cam.R * direction(u, v)).normalized()};
  Hit hit;
  for (const Candidate& candidate : tile) {
    if (static_cast<double>(candidate.nearest_m) > hit.t) break;
    const Primitive& solid = solids_[static_cast<std::size_t>(candidate.solid)];
    Ray seen = ray;
    seen.origin -= since_s * solid.velocity;
    if (intersect(solid, seen, pixel_rad_, world_.textures.volume, hit))
      hit.primitive = candidate.solid;
  }
  GroundHit ground;
  if (ground_rays_.intersect(ray, ground) && ground.t < hit.t) return shade_ground(ray, ground);
  if (hit.primitive >= 0) return shade_solid(ray, hit);
  Sample sky;
  sky.radiance = world_.lighting.sky(ray.direction, pixel_rad_);
  return sky;
}

void FrameRenderer::first_pass(RenderedFrame& out) {
  const int width = config_.camera.width_px;
  std::size_t k = 0;
  for (int v = 0; v < config_.camera.height_px; ++v) {
    for (int u = 0; u < width; ++u, ++k) {
      const auto& tile = tiles_[static_cast<std::size_t>((v / kTile) * tiles_x_ + u / kTile)];
      samples_[k] = trace(u, v, kMiddle, tile);
      out.radiance[k] = samples_[k].radiance;
      out.distance_m[k] = samples_[k].distance_m;
      out.object[k] = samples_[k].object;
    }
  }
}

void FrameRenderer::measure_blur() {
  const int width = config_.camera.width_px;
  const int height = config_.camera.height_px;
  const int blocks_x = (width + kBlurBlock - 1) / kBlurBlock;
  const int blocks_y = (height + kBlurBlock - 1) / kBlurBlock;
  blur_px_.assign(static_cast<std::size_t>(blocks_x) * static_cast<std::size_t>(blocks_y), 0.0F);
  for (int by = 0; by < blocks_y; ++by) {
    for (int bx = 0; bx < blocks_x; ++bx) {
      const int u = std::min(bx * kBlurBlock + 2, width - 1);
      const int v = std::min(by * kBlurBlock + 2, height - 1);
      const Sample& sample = samples_[static_cast<std::size_t>(v * width + u)];
      const double distance =
          sample.distance_m > 0.0F ? static_cast<double>(sample.distance_m) : 1e4;
      const Vector3d p =
          pose_at(v, kMiddle) * (distance * config_.camera.unproject(Vector2d(u, v)).normalized());
      const Vector3d velocity =
          sample.key >= 16U ? solids_[(sample.key - 16U) / 8U].velocity : Vector3d::Zero();
      const Vector3d drift = 0.5 * config_.exposure_s * velocity;
      const Vector3d first = pose_at(v, 0).inverse() * Vector3d(p - drift);
      const Vector3d last = pose_at(v, kSlots - 1).inverse() * Vector3d(p + drift);
      if (first.z() < 0.1 || last.z() < 0.1) continue;
      blur_px_[static_cast<std::size_t>(by * blocks_x + bx)] =
          static_cast<float>((config_.camera.project(first) - config_.camera.project(last)).norm());
    }
  }
}

int FrameRenderer::samples_wanted(int u, int v) const {
  const int width = config_.camera.width_px;
  const int blocks_x = (width + kBlurBlock - 1) / kBlurBlock;
  const float blur =
      blur_px_[static_cast<std::size_t>((v / kBlurBlock) * blocks_x + u / kBlurBlock)];
  const Sample& here = samples_[static_cast<std::size_t>(v * width + u)];
  bool edge = false;
  const auto compare = [&](int nu, int nv) {
    if (nu < 0 || nv < 0 || nu >= width || nv >= config_.camera.height_px) return;
    const Sample& other = samples_[static_cast<std::size_t>(nv * width + nu)];
    const float contrast = std::abs(other.radiance - here.radiance) /
                           (std::max(other.radiance, here.radiance) + 0.02F);
    edge = edge || contrast > (other.key != here.key ? 0.08F : 0.3F);
  };
  compare(u - 1, v);
  compare(u + 1, v);
  compare(u, v - 1);
  compare(u, v + 1);
  // Textures are already averaged over the smear, so samples are needed only where something ends.
  if (!edge && blur < 4.0F) return 0;
  return std::clamp(static_cast<int>(std::ceil(blur / 0.9F)), edge ? config_.edge_samples : 0, 16);
}

void FrameRenderer::refine(RenderedFrame& out) {
  const int width = config_.camera.width_px;
  for (int v = 0; v < config_.camera.height_px; ++v) {
    for (int u = 0; u < width; ++u) {
      const int count = samples_wanted(u, v);
      if (count == 0) continue;
      const auto& tile = tiles_[static_cast<std::size_t>((v / kTile) * tiles_x_ + u / kTile)];
      const std::size_t k = static_cast<std::size_t>(v * width + u);
      const std::uint64_t turn = hash_keys(static_cast<std::uint64_t>(k), 0xaa);
      const bool still = count <= config_.edge_samples;  // then the first sample counts as well
      float sum = still ? out.radiance[k] : 0.0F;
      for (int i = 0; i < count;
           ++i) {  // a rank-1 lattice, shifted per pixel; each sample at its own time
        const double x = std::fmod(uniform_of(turn) + (i + 0.5) / count, 1.0) - 0.5;
        const double y = std::fmod(uniform_of(mix(turn)) + 0.6180339887 * i, 1.0) - 0.5;
        const int slot = static_cast<int>((i + 0.5) * kSlots / count);
        sum += trace(std::clamp(u + x, -0.5, width - 0.5), v + y, slot, tile).radiance;
      }
      out.radiance[k] = sum / static_cast<float>(still ? count + 1 : count);
    }
  }
}

void FrameRenderer::render(double time_s, RenderedFrame& out) {
  out.width_px = config_.camera.width_px;
  out.height_px = config_.camera.height_px;
  const std::size_t pixels = samples_.size();
  out.radiance.resize(pixels);
  out.distance_m.resize(pixels);
  out.object.resize(pixels);
  prepare(time_s);
  out.objects = world_.scene.parked();
  out.objects.insert(out.objects.end(), moving_objects_.begin(), moving_objects_.end());
  first_pass(out);
  measure_blur();
  refine(out);
}

}  // namespace plumb::synth
