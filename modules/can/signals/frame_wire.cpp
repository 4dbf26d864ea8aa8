// The signals about a camera frame as a whole: its age, and which of its values were refused.
#include "modules/can/judge_wire.hpp"
#include "modules/can/signals/rows.hpp"
#include "modules/can/signals/signal_tables.hpp"

namespace plumb {
namespace {

using Ego = JudgedMotion;
using Plane = JudgedPlane;
using State = CanState;

/// In the order of PlausibilityReason.
constexpr std::array<const char*, 8> kDoubtNames = {"none",         "not_measured", "out_of_range",
                                                    "too_fast",     "recovering",   "interval",
                                                    "inconsistent", "dependent"};

template <VehicleSignal kSignal, typename Source>
constexpr SignalValue doubt() {
  return when_received<Source>([](const Source& m) { return m.verdict[kSignal]; });
}

constexpr Signal kFrameSignals[] = {
    crc("Frame_Crc"),
    alive_counter("Frame_AliveCtr"),
    {"Frame_SpeedDoubt",
     {12, 4},
     "",
     doubt<VehicleSignal::kSpeed, Ego>(),
     "Why the speed was not believed: 0 it was, 1 it is not measured, 2 no road vehicle is that "
     "fast, 3 none changes its speed that fast, 4 it has not been plausible for long enough, 5 the "
     "time between the images is not known, 6 it contradicts the step between the images.",
     kDoubtNames},
    frame_counter("Frame_FrameCtr"),
    {"Frame_Age",
     {24, 12, 0.001},
     "s",
     when_received<State>([](const State& s) { return s.age_s; }),
     "Time since the middle of the exposure of the newest camera frame, at transmission. It is "
     "also sent when the frame is too old to be used.",
     {},
     "it is not known"},
    {"Frame_YawRateDoubt",
     {36, 4},
     "",
     doubt<VehicleSignal::kYawRate, Ego>(),
     "Why the yaw rate was not believed, as Frame_SpeedDoubt.",
     kDoubtNames},
    {"Frame_PoseDoubt",
     {40, 4},
     "",
     doubt<VehicleSignal::kPose, Ego>(),
     "Why the integrated pose was not believed, as Frame_SpeedDoubt; 7: the speed was not, then "
     "the pose is degraded.",
     kDoubtNames},
    {"Frame_HeightDoubt",
     {44, 4},
     "",
     doubt<VehicleSignal::kHeight, Plane>(),
     "Why the camera height was not believed, as Frame_SpeedDoubt.",
     kDoubtNames},
    {"Frame_PitchDoubt",
     {48, 4},
     "",
     doubt<VehicleSignal::kPitch, Plane>(),
     "Why the pitch was not believed, as Frame_SpeedDoubt; about y of ISO 8855, nose DOWN "
     "positive.",
     kDoubtNames},
    {"Frame_RollDoubt",
     {52, 4},
     "",
     doubt<VehicleSignal::kRoll, Plane>(),
     "Why the roll was not believed, as Frame_SpeedDoubt; about x of ISO 8855, right side down "
     "positive.",
     kDoubtNames},
    {"Frame_StartCtr",
     {56, 8},
     "",
     when_received<State>([](const State& s) { return s.start; }),
     "Differs from one run of the sending program to the next: counters and sums began anew."},
};
static_assert(fit_message(kFrameSignals));

constexpr SignalTable kFrameTables[] = {
    {message_index("Frame"), kFrameSignals},
};

}  // namespace

std::span<const SignalTable> frame_signals() { return kFrameTables; }

}  // namespace plumb
