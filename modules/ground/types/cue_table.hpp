/// The one table of the cues: their numbers, their names, and whether they measure the height.
///
/// The estimator, GROUND_PLANE, the CSV of plumb-replay and the samples of plumb-train walk this
/// table. docs/add_a_cue.md says how to add an entry.
#pragma once

#include <array>
#include <cstddef>

namespace plumb {

/// Index of a cue in every list of cues; same numbers as ground_plane_t.CUE_*.
enum CueId : std::size_t {
  kCueDense = 0,
  kCuePoints = 1,
  kCueObjects = 2,
  kCueMotion = 3,
  kNumCues = 4
};

struct CueEntry {
  const char* name = nullptr;  ///< prefix of its columns
  /// Cues that measure the height are fused first: they start the filter and open its gate again.
  /// The others are held against the plane that results.
  bool measures_height = false;
};

inline constexpr std::array<CueEntry, kNumCues> kCueTable{{
    {"dense", true},
    {"points", true},
    {"objects", false},
    {"motion", true},
}};
static_assert(kCueTable.back().name != nullptr, "a cue has no entry");

/// Room that a message has for cues, ground_plane_t.MAX_CUES.
inline constexpr std::size_t kMaxCues = 8;
static_assert(kNumCues <= kMaxCues);

}  // namespace plumb
