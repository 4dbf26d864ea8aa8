/// A LocalMap on rendered images, driven the way Pipeline does.
#pragma once

#include "modules/vo/initializer.hpp"
#include "modules/vo/local_map.hpp"
#include "modules/vo/motion_predictor.hpp"
#include "tests/support/scene.hpp"

namespace plumb::vo::test {

using plumb::test::Scene;
using plumb::test::scene_camera;

class MapFixture {
 public:
  static VoConfig config() {
    VoConfig c;
    c.max_tracks = 300;
    return c;
  }

  /// Renders the view from `T_world_cam` into the newest image.
  void show(const Se3& T_world_cam, double noise_std_grey = 1.0) {
    const auto image = scene_.render(T_world_cam, noise_std_grey, ++noise_seed_);
    map.newest_image().build(image.view());
    time = {next_seq_, next_seq_ - 1, next_seq_ == 0 ? 0.0 : 0.1};
    ++next_seq_;
    out = VoOutput{};
  }
  /// Shows `T_world_cam` to the initialiser.
  void initialize(const Se3& T_world_cam) {
    show(T_world_cam);
    if (!initializer.has_reference()) {
      initializer.begin(time, map, &out);
    } else {
      initializer.update(time, map, motion, &out, probe);
    }
  }
  /// Initialises on a straight drive with `step_m` per image. Returns the number of images that it
  /// took.
  int drive_until_done(double step_m, int most = 20) {
    for (int i = 0; i < most; ++i) {
      initialize({Eigen::Matrix3d::Identity(), {0.0, 0.0, step_m * i}});
      if (initializer.done()) return i + 1;
    }
    return -1;
  }

  LocalMap map{config(), scene_camera()};
  MotionPredictor motion{config()};
  Initializer initializer{config(), scene_camera(), 1};
  FrameTime time;
  VoOutput out;
  NullProbe probe;

 private:
  Scene scene_{scene_camera()};
  unsigned noise_seed_ = 10;
  std::int64_t next_seq_ = 0;
};

}  // namespace plumb::vo::test
