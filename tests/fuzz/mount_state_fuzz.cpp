// A fuzz target for the state file of the mount. What is accepted must be a reference that the
// check can go on with.
#include <cmath>

#include "modules/mount/mount_config.hpp"
#include "modules/mount/mount_source.hpp"
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
  return 0;
}
