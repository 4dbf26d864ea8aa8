// The signals of the chain's state and of versions. Their reasons come out of the messages.

#include "modules/can/judge_wire.hpp"
#include "modules/can/signals/rows.hpp"
#include "modules/can/signals/signal_tables.hpp"
#include "plumb/status_names.hpp"

namespace plumb {
namespace {

using Ego = JudgedMotion;
using Plane = JudgedPlane;
using State = CanState;

constexpr Signal kStatusSignals[] = {
    crc("Status_Crc"),
    alive_counter("Status_AliveCtr"),
    {"Status_Mode",
     {12, 3},
     "",
     when_received<State>([](const State& s) { return s.mode; }),
     "What the whole chain does. TOO_OLD and AGE_UNKNOWN: there is input, but it is not sent, "
     "because its image is too old, or because the time of its capture is not known.",
     kModeNames},
    {"Status_EgoStatus",
     {15, 3},
     "",
     when_received<Ego>([](const Ego& m) { return m.status; }),
     "Status of the ego motion, as in EgoDetail_Status.",
     kEgoMotionStatusNames},
    {"Status_EgoReason",
     {18, 6},
     "",
     when_received<Ego>([](const Ego& m) { return m.reason; }),
     "Why the ego motion is not fully valid; IMPLAUSIBLE also where a value was refused here, see "
     "Frame_SpeedDoubt.",
     kVoMotionReasonNames},
    {"Status_GroundStatus",
     {24, 3},
     "",
     when_received<Plane>([](const Plane& m) { return m.status; }),
     "Status of the ground plane, as in GroundDetail_Status.",
     kGroundPlaneStatusNames},
    {"Status_GroundReason",
     {27, 5},
     "",
     when_received<Plane>([](const Plane& m) { return m.reason; }),
     "Why the ground plane is not fully valid, as in GroundDetail_Reason.",
     kGroundPlaneReasonNames},
    {"Status_NumMissed", staying({32, 8}), "",
     when_received<State>([](const State& s) { return s.num_missed; }),
     "Camera frames missing by sequence number since start; stays at 254."},
    {"Status_NumOverflowed", staying({40, 8}), "",
     when_received<State>([](const State& s) { return s.num_overflowed; }),
     "Camera frames dropped because they came faster than they could be sent; stays at 254."},
    {"Status_NumRejected", staying({48, 8}), "",
     when_received<State>([](const State& s) { return s.num_rejected; }),
     "Input messages refused since start because they broke their contract; stays at 254."},
    {"Status_NumUnsent", staying({56, 8}), "",
     when_received<State>([](const State& s) { return s.num_unsent; }),
     "CAN frames that the bus did not take since start; stays at 254."},
};
static_assert(fit_message(kStatusSignals));

constexpr Signal kInfoSignals[] = {
    crc("Info_Crc"),
    alive_counter("Info_AliveCtr"),
    {"Info_DatabaseVersion",
     {16, 8},
     "",
     when_received<State>([](const State&) { return kDatabaseVersion; }),
     "Version of this database's layout; receivers refuse another one."},
    {"Info_VersionMajor",
     {24, 8},
     "",
     when_received<State>([](const State&) { return PLUMB_VERSION_MAJOR; }),
     "Program version, major."},
    {"Info_VersionMinor",
     {32, 8},
     "",
     when_received<State>([](const State&) { return PLUMB_VERSION_MINOR; }),
     "Program version, minor."},
    {"Info_VersionPatch",
     {40, 8},
     "",
     when_received<State>([](const State&) { return PLUMB_VERSION_PATCH; }),
     "Program version, patch."},
    {"Info_Uptime", staying({48, 16}), "s",
     when_received<State>([](const State& s) { return s.uptime_s; }),
     "Time since start; stays at 65534."},
};
static_assert(fit_message(kInfoSignals));

constexpr SignalTable kStatusTables[] = {
    {message_index("Status"), kStatusSignals},
    {message_index("Info"), kInfoSignals},
};

}  // namespace

std::span<const SignalTable> status_signals() { return kStatusTables; }

}  // namespace plumb
