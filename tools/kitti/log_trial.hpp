/// Makes a trial of a drive: the same log, a little different, as another day's recording would be.
///
/// A trial begins at a later image, has noise on its images and lacks some of them. The truth of
/// the images that are left comes out beside it, row for row what plumb-replay writes.
#pragma once

#include <cstdint>
#include <string>

namespace plumb {

struct TrialOptions {
  std::string log;
  std::string out;     ///< log to write; empty: none
  std::string poses;   ///< KITTI pose file to write; empty: none
  std::string planes;  ///< file of planes to write; empty: none
  int skip = 0;        ///< images to leave out at the beginning
  double noise = 0.0;  ///< standard deviation of noise on the pixels [grey levels]
  double drop = 0.0;   ///< probability that an image is missing
  std::uint64_t seed = 1;
};

struct TrialResult {
  std::int64_t num_images = 0;
  std::int64_t num_poses = 0;
  std::int64_t num_planes = 0;
};

/// Writes no pose file when an image lacks its pose, and no file of planes when there is none. The
/// same options give the same bytes. Throws InputError and LogError.
TrialResult make_trial(const TrialOptions& options);

}  // namespace plumb
