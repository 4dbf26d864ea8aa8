/// Renders a camera frame by ray casting. Distortion, rolling shutter and motion during the
/// exposure are exact.
///
/// Frames:
///   map: as in route.hpp.
///   img: (0,0) is the centre of the upper left pixel.
/// Time:
///   A frame's time is the middle of the exposure of its middle row.
/// Threads:
///   FrameRenderer owns its scratch memory, so that each thread needs its own. The result depends
///   on the time only.
#pragma once

#include <cstdint>
#include <vector>

#include "core/camera_model.hpp"
#include "tools/synth/drive.hpp"
#include "tools/synth/ground_ray.hpp"
#include "tools/synth/ground_shader.hpp"
#include "tools/synth/lamps.hpp"
#include "tools/synth/lighting.hpp"
#include "tools/synth/scene.hpp"
#include "tools/synth/shadow_grid.hpp"
#include "tools/synth/solid_shader.hpp"

namespace plumb::synth {

struct RenderConfig {
  CameraModel camera;
  double exposure_s = 0.002;
  double readout_s = 0.0;  ///< first to last row; 0 = global shutter
  int edge_samples = 3;    ///< extra samples where the picture changes
  bool plain = false;      ///< test pictures: no shadows, no haze
};

/// What all threads share.
struct World {
  const Terrain& terrain;
  const Drive& drive;
  const Scene& scene;
  const Textures& textures;
  const Lighting& lighting;
  const GroundShader& ground;
  const ShadowGrid& still_shadows;
  const Lamps& lamps;
};

struct RenderedFrame {
  int width_px = 0;
  int height_px = 0;
  std::vector<float> radiance;
  std::vector<float> distance_m;     ///< along the ray; 0 = sky
  std::vector<std::int32_t> object;  ///< labelled object, -1 none, -2 road
  std::vector<ObjectPose> objects;   ///< poses of all objects at the frame's time
};

class FrameRenderer {
 public:
  static constexpr std::int32_t kNothing = -1;
  static constexpr std::int32_t kRoad = -2;

  FrameRenderer(const World& world, const RenderConfig& config);

  void render(double time_s, RenderedFrame& out);

  /// The solids of the last frame that belong to objects, for measuring what is hidden.
  [[nodiscard]] const std::vector<Primitive>& visible() const { return solids_; }

 private:
  static constexpr int kTile = 16;
  struct Candidate {
    float nearest_m;
    std::int32_t solid;
  };
  struct Sample {
    float radiance = 0.0F;
    float distance_m = 0.0F;
    std::uint32_t key = 0;
    std::int32_t object = kNothing;
  };

  void prepare(double time_s);
  void cull(double time_s);
  void fill_tiles(double time_s);
  bool image_bounds(const Primitive& solid, const Se3& T_cam_map, Eigen::Vector2d& low,
                    Eigen::Vector2d& high) const;
  [[nodiscard]] double row_time_s(double time_s, int v) const;
  [[nodiscard]] const Se3& pose_at(int v, int slot) const;
  [[nodiscard]] Eigen::Vector3d direction(double u, double v) const;
  [[nodiscard]] Sample trace(double u, double v, int slot,
                             const std::vector<Candidate>& tile) const;
  [[nodiscard]] Sample shade_solid(const Ray& ray, const Hit& hit) const;
  [[nodiscard]] Sample shade_ground(const Ray& ray, const GroundHit& hit) const;
  [[nodiscard]] float light_from(Reflectance surface, const Patch& patch, double distance_m) const;
  [[nodiscard]] float sunlight(const Patch& patch, const Reflectance& surface) const;
  void first_pass(RenderedFrame& out);
  void refine(RenderedFrame& out);
  [[nodiscard]] int samples_wanted(int u, int v) const;
  void measure_blur();

  World world_;
  RenderConfig config_;
  double pixel_rad_;
  int tiles_x_;
  int tiles_y_;
  double time_s_ = 0.0;
  Se3 T_map_veh_;
  Eigen::Vector3d smear_ = Eigen::Vector3d::Zero();  ///< [m] motion of the eye during the exposure
  std::vector<Primitive> solids_;
  std::vector<Primitive> moving_;
  std::vector<ObjectPose> moving_objects_;
  std::vector<std::vector<Candidate>> tiles_;
  ShadowGrid moving_shadows_;
  ShadowGrid above_;
  std::vector<Primitive> cars_;
  GroundRays ground_rays_;
  std::vector<Se3> poses_;  ///< [row or 0][slot]: T_map_cam during the exposure
  std::vector<double> slot_time_s_;
  std::vector<Sample> samples_;
  std::vector<float> blur_px_;  ///< per 4x4 block
};

}  // namespace plumb::synth
