// The signals of the ground plane, out of GROUND_PLANE.
#include <algorithm>
#include <cmath>

#include "modules/can/judge_wire.hpp"
#include "modules/can/signals/rows.hpp"
#include "modules/can/signals/signal_tables.hpp"
#include "plumb/status_names.hpp"

namespace plumb {
namespace {

using Plane = JudgedPlane;

// The signal has four bits, and 15 stands for "not available".
constexpr int kNumCueBits = 3;

/// One bit for each cue that entered the plane.
int cues_used(const Plane& m) {
  int bits = 0;
  for (int i = 0; i < std::min<int>(m.num_cues, kNumCueBits); ++i) {
    if (m.cues[static_cast<std::size_t>(i)].status == ground_cue_t::STATUS_USED) bits += 1 << i;
  }
  return bits;
}

constexpr Signal kGroundPlaneSignals[] = {
    crc("GroundPlane_Crc"),
    alive_counter("GroundPlane_AliveCtr"),
    {"GroundPlane_Validity",
     {12, 2},
     "",
     validity_of_group<Plane>(Group::kMain),
     "What the ground plane's values are worth: 0 invalid (they are sent as not available), 1 "
     "degraded (predicted, see the standard deviation, or one value is not available), 2 valid.",
     kValidityNames,
     kNoFreshInput},
    frame_counter("GroundPlane_FrameCtr"),
    {"GroundPlane_Pitch",
     {24, 16, 0.00002, -0.65536},
     "rad",
     wanted(with_deviation("GroundDetail_PitchStd",
                           when_valid<Plane>([](const Plane& m) { return m.pitch_rad; }))),
     "Pitch of the camera against the local road, about y of ISO 8855 (left): nose DOWN positive."},
    {"GroundPlane_Roll",
     {40, 12, 0.0002, -0.4096},
     "rad",
     wanted(with_deviation("GroundDetail_RollStd",
                           when_valid<Plane>([](const Plane& m) { return m.roll_rad; }))),
     "Roll of the camera against the local road, about x of ISO 8855 (forward): right side down "
     "positive."},
    {"GroundPlane_Height",
     {52, 12, 0.001},
     "m",
     wanted(with_deviation("GroundDetail_HeightStd",
                           when_valid<Plane>([](const Plane& m) { return m.height_m; }))),
     "Height of the optical centre above the local road, along the road's normal, up positive."},
};
static_assert(fit_message(kGroundPlaneSignals));

constexpr Signal kGroundPlaneDetailSignals[] = {
    crc("GroundDetail_Crc"),
    alive_counter("GroundDetail_AliveCtr"),
    {"GroundDetail_Status",
     {12, 4},
     "",
     when_received<Plane>([](const Plane& m) { return m.status; }),
     "Status of the ground plane.",
     kGroundPlaneStatusNames},
    frame_counter("GroundDetail_FrameCtr"),
    {"GroundDetail_PitchStd",
     {24, 10, 0.00005},
     "rad",
     when_valid<Plane>([](const Plane& m) { return std::sqrt(m.cov[0][0]); }),
     "Standard deviation of GroundPlane_Pitch."},
    {"GroundDetail_RollStd",
     {34, 10, 0.00005},
     "rad",
     when_valid<Plane>([](const Plane& m) { return std::sqrt(m.cov[1][1]); }),
     "Standard deviation of GroundPlane_Roll."},
    {"GroundDetail_HeightStd",
     {44, 10, 0.0005},
     "m",
     when_valid<Plane>([](const Plane& m) { return m.height_m * std::sqrt(m.cov[2][2]); }),
     "Standard deviation of GroundPlane_Height."},
    {"GroundDetail_Reason",
     {54, 4},
     "",
     when_received<Plane>([](const Plane& m) { return m.reason; }),
     "Why the ground plane is not fully valid.",
     kGroundPlaneReasonNames},
    {"GroundDetail_CuesUsed",
     {58, 4},
     "",
     when_received<Plane>([](const Plane& m) { return cues_used(m); }),
     "Sum of the cues that entered this frame's plane: 1 dense image alignment, 2 triangulated "
     "points, 4 objects.",
     std::span(kGroundPlaneCueNames).first(kNumCueBits),
     "",
     true},
};
static_assert(fit_message(kGroundPlaneDetailSignals));

constexpr SignalTable kPlaneTables[] = {
    {message_index("GroundPlane"), kGroundPlaneSignals},
    {message_index("GroundPlaneDetail"), kGroundPlaneDetailSignals},
};

}  // namespace

std::span<const SignalTable> plane_signals() { return kPlaneTables; }

}  // namespace plumb
