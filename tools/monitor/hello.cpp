#include "tools/monitor/hello.hpp"

#include "platform/version.hpp"
#include "tools/monitor/chain_view.hpp"

namespace plumb {

nlohmann::json hello_json(const char* mode, const std::string& title, const PlumbConfig& config,
                          const CanView& can) {
  const GroundConfig& ground = config.ground;
  return {{"type", "hello"},
          {"mode", mode},
          {"title", title},
          {"version", plumb_version()},
          {"rows", kRowNames},
          {"words", status_words()},
          {"can", can.schema()},
          {"road",
           {{"near", ground.road_near_m / ground.camera_height_m},
            {"far", ground.road_far_m / ground.camera_height_m},
            {"half_width", ground.road_half_width_m / ground.camera_height_m}}}};
}

}  // namespace plumb
