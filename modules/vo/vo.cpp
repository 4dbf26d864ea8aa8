#include "modules/vo/vo.hpp"

#include "modules/vo/pipeline.hpp"

namespace plumb {

struct VisualOdometry::Impl {
  vo::Pipeline pipeline;
};

VisualOdometry::VisualOdometry(const VoConfig& config, const CameraModel& camera,
                               std::uint64_t seed)
    : impl_(new Impl{vo::Pipeline(config, camera, seed)}) {}

VisualOdometry::~VisualOdometry() = default;

const VoOutput& VisualOdometry::update(const VoInput& input, StageProbe& probe) {
  return impl_->pipeline.update(input, probe);
}

vo::AttachedRegions& VisualOdometry::attached() { return impl_->pipeline.attached(); }

}  // namespace plumb
