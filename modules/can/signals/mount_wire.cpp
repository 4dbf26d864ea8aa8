// The signals of the mount check, out of MOUNT.

#include "modules/can/signals/rows.hpp"
#include "modules/can/signals/signal_tables.hpp"
#include "plumb/mount_t.hpp"
#include "plumb/status_names.hpp"

namespace plumb {
namespace {

using Mount = mount_t;

constexpr Signal kMountSignals[] = {
    crc("Mount_Crc"),
    alive_counter("Mount_AliveCtr"),
    {"Mount_Status",
     {12, 4},
     "",
     when_received<Mount>([](const Mount& m) { return m.status; }),
     "0 no reference yet, too few stretches; 1 no reference yet, the stretches disagree; 2 the "
     "camera sits as its reference says; 3 it does not, the calibration no longer holds; 4 it "
     "looks far off the direction of travel.",
     kMountStatusNames,
     "the mount check is silent for more than 3 s or was never heard"},
    {"Mount_Reason",
     {16, 4},
     "",
     when_received<Mount>([](const Mount& m) { return m.reason; }),
     "Why the newest image told nothing about the mount.",
     kMountReasonNames},
    {"Mount_Progress",
     {20, 8, 0.005},
     "",
     when_received<Mount>([](const Mount& m) { return m.progress; }),
     "Share of the stretches that a reference is made of, 0 to 1; 1 when there is one."},
    {"Mount_PitchChange",
     {28, 12, 0.0002, -0.4096},
     "rad",
     when_valid<Mount>([](const Mount& m) { return m.recent_rad[0] - m.reference_rad[0]; }),
     "Pitch of the camera against the road less that of the reference, mean of the newest "
     "stretches, about y of ISO 8855 (left): nose DOWN positive. Only with a reference."},
    {"Mount_RollChange",
     {40, 12, 0.0002, -0.4096},
     "rad",
     when_valid<Mount>([](const Mount& m) { return m.recent_rad[1] - m.reference_rad[1]; }),
     "Roll of the camera against the road less that of the reference, mean of the newest "
     "stretches, about x of ISO 8855 (forward): right side down positive. Only with a reference."},
    {"Mount_YawChange",
     {52, 12, 0.0002, -0.4096},
     "rad",
     when_valid<Mount>([](const Mount& m) { return m.recent_rad[2] - m.reference_rad[2]; }),
     "Yaw of the camera against the direction of travel less that of the reference, mean of the "
     "newest stretches, about z of ISO 8855 (up): to the left positive. Only with a reference."},
};
static_assert(fit_message(kMountSignals));

constexpr SignalTable kMountTables[] = {
    {message_index("Mount"), kMountSignals},
};

}  // namespace

std::span<const SignalTable> mount_signals() { return kMountTables; }

}  // namespace plumb
