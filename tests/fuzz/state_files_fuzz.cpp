// A fuzz target for the state files of the mount and of what is attached to the camera. What is
// accepted must be something that the estimator can go on with.
#include <cmath>

#include "modules/mount/mount_config.hpp"
#include "modules/mount/mount_source.hpp"
#include "modules/vo/attached_source.hpp"
#include "platform/config.hpp"
#include "tests/fuzz/fuzz_input.hpp"

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer's name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const plumb::fuzz::MemoryFile kFile;
  kFile.write(plumb::fuzz::Bytes{data, size});
  try {
    const plumb::MountReference reference = plumb::load_mount_reference(kFile.path());
    plumb::fuzz::require(reference.num_stretches >= 1);
    plumb::fuzz::require(reference.mean_rad.allFinite() && reference.std_rad.allFinite());
    plumb::fuzz::require(reference.std_rad.minCoeff() >= 0.0);
    plumb::MountCheck check{plumb::MountConfig{}};
    check.restore(reference);
  } catch (const plumb::ConfigError&) {
  }
  try {
    plumb::vo::AttachedRegions regions(64, 40);
    plumb::load_attached_regions(kFile.path(), 64, 40, &regions);
    regions.end_image(1.0);
    plumb::fuzz::require(regions.share() >= 0.0 && regions.share() <= 1.0);
  } catch (const plumb::ConfigError&) {
  }
  return 0;
}
