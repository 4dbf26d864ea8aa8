// The signals of the list of objects, out of OBJECTS.
#include <cmath>

#include "modules/can/signals/rows.hpp"
#include "modules/can/signals/signal_tables.hpp"
#include "modules/can/validity_wire.hpp"
#include "plumb/object_t.hpp"
#include "plumb/status_names.hpp"

namespace plumb {
namespace {

using Counts = CanObjectCounts;
using Object = object_t;

bool velocity_is_known(const Object& o) {
  return std::isfinite(o.velocity_ground_m_s[0]) && std::isfinite(o.velocity_ground_m_s[1]);
}

double velocity_std_m_s(const Object& o, int axis) {
  const double variance_m2_s2 = o.velocity_cov_m2_s2[axis][axis];
  return velocity_is_known(o) && is_std(variance_m2_s2) ? std::sqrt(variance_m2_s2) : kNotAvailable;
}

constexpr Signal kObjectListSignals[] = {
    crc("ObjList_Crc"),
    alive_counter("ObjList_AliveCtr"),
    {"ObjList_Count",
     {12, 4},
     "",
     when_valid<Counts>([](const Counts& c) { return c.num_objects; }),
     "Number of objects that follow in this burst, 0 to 8, the nearest ones.",
     {},
     "the newest list is too old, or its age is not known"},
    {"ObjList_FrameCtr",
     {16, 8, 1.0, 0.0, false},
     "",
     {Framing::kFrameCounter},
     "Low 8 bits of the sequence number of the camera frame that was searched; messages with the "
     "same value belong together. All 256 values are counts, there is no value for not available."},
    {"ObjList_NumLeftOut", staying({24, 8}), "",
     when_valid<Counts>([](const Counts& c) { return c.num_left_out; }),
     "Objects of this frame that are not sent: further away than those that are, or without a "
     "place on the road; stays at 254."},
    {"ObjList_Age",
     {32, 12, 0.001},
     "s",
     when_received<Counts>([](const Counts& c) { return c.age_s; }),
     "Time since the capture of the camera frame that was searched.",
     {},
     "it is not known"},
};
static_assert(fit_message(kObjectListSignals));

constexpr Signal kObjectPositionSignals[] = {
    crc("ObjPos_Crc"),
    alive_counter("ObjPos_AliveCtr"),
    {"ObjPos_Index",
     {12, 4, 1.0, 0.0, false},
     "",
     {Framing::kObjectIndex},
     "Number of the object in this burst, 0 to 7, nearest first; another burst may number it "
     "otherwise. There is no value for not available."},
    {"ObjPos_FrameCtr",
     {16, 8, 1.0, 0.0, false},
     "",
     {Framing::kFrameCounter},
     "As ObjList_FrameCtr. There is no value for not available."},
    {"Obj#_PosX",
     {24, 12, 0.05, -4.0},
     "m",
     with_deviation("Obj#_PosXStd",
                    when_received<Object>([](const Object& o) { return o.position_ground_m[0]; })),
     "Middle of the object's footprint, along x of ISO 8855 (forward) from the road under the "
     "camera, forward positive."},
    {"Obj#_PosY",
     {36, 12, 0.05, -102.4},
     "m",
     with_deviation("Obj#_PosYStd",
                    when_received<Object>([](const Object& o) { return o.position_ground_m[1]; })),
     "Middle of the object's footprint, along y of ISO 8855 (left) from the road under the "
     "camera, left positive."},
    {"Obj#_PosXStd",
     {48, 8, 0.05},
     "m",
     when_received<Object>([](const Object& o) { return std::sqrt(o.position_cov_m2[0][0]); }),
     "Standard deviation of Obj#_PosX."},
    {"Obj#_PosYStd",
     {56, 8, 0.02},
     "m",
     when_received<Object>([](const Object& o) { return std::sqrt(o.position_cov_m2[1][1]); }),
     "Standard deviation of Obj#_PosY."},
};
static_assert(fit_message(kObjectPositionSignals));

constexpr Signal kObjectMotionSignals[] = {
    crc("ObjMot_Crc"),
    alive_counter("ObjMot_AliveCtr"),
    {"ObjMot_Index",
     {12, 4, 1.0, 0.0, false},
     "",
     {Framing::kObjectIndex},
     "As ObjPos_Index. There is no value for not available."},
    {"ObjMot_FrameCtr",
     {16, 8, 1.0, 0.0, false},
     "",
     {Framing::kFrameCounter},
     "As ObjList_FrameCtr. There is no value for not available."},
    {"Obj#_VelX",
     {24, 12, 0.05, -102.4},
     "m/s",
     with_deviation("Obj#_VelXStd", when_received<Object>([](const Object& o) {
                      return velocity_is_known(o) ? o.velocity_ground_m_s[0] : kNotAvailable;
                    })),
     "Velocity of the object over ground, along x of ISO 8855 (forward), forward positive. Not "
     "available while the camera's own motion is not known."},
    {"Obj#_VelY",
     {36, 12, 0.02, -40.96},
     "m/s",
     with_deviation("Obj#_VelYStd", when_received<Object>([](const Object& o) {
                      return velocity_is_known(o) ? o.velocity_ground_m_s[1] : kNotAvailable;
                    })),
     "Velocity of the object over ground, along y of ISO 8855 (left), to the left positive."},
    {"Obj#_VelXStd",
     {48, 8, 0.05},
     "m/s",
     when_received<Object>([](const Object& o) { return velocity_std_m_s(o, 0); }),
     "Standard deviation of Obj#_VelX."},
    {"Obj#_VelYStd",
     {56, 8, 0.05},
     "m/s",
     when_received<Object>([](const Object& o) { return velocity_std_m_s(o, 1); }),
     "Standard deviation of Obj#_VelY."},
};
static_assert(fit_message(kObjectMotionSignals));

constexpr Signal kObjectStateSignals[] = {
    crc("ObjState_Crc"),
    alive_counter("ObjState_AliveCtr"),
    {"ObjState_Index",
     {12, 4, 1.0, 0.0, false},
     "",
     {Framing::kObjectIndex},
     "As ObjPos_Index. There is no value for not available."},
    {"ObjState_FrameCtr",
     {16, 8, 1.0, 0.0, false},
     "",
     {Framing::kFrameCounter},
     "As ObjList_FrameCtr. There is no value for not available."},
    {"Obj#_Id",
     {24, 8},
     "",
     when_received<Object>(
         [](const Object& o) { return modulo_255(static_cast<std::uint32_t>(o.track_id)); }),
     "Number of the track, modulo 255; the same over frames."},
    {"Obj#_Class",
     {32, 4},
     "",
     when_received<Object>([](const Object& o) { return o.class_id; }),
     "What the detector took the object for.",
     kDetectionClassNames},
    {"Obj#_Status",
     {36, 3},
     "",
     when_received<Object>([](const Object& o) { return o.status; }),
     "Whether this frame measured the object.",
     kObjectStatusNames},
    {"Obj#_Age", staying({39, 9, 0.1}), "s",
     when_received<Object>([](const Object& o) { return o.age_s; }),
     "Time since the track began; stays at 51.0."},
    {"Obj#_TimeToCollision", staying({48, 9, 0.05}), "s",
     when_received<Object>([](const Object& o) {
       return std::isfinite(o.time_to_collision_s) ? o.time_to_collision_s : kNotAvailable;
     }),
     "Distance over closing speed; not available while the distance does not shrink, stays at "
     "25.5."},
    {"Obj#_Width",
     {57, 7, 0.05},
     "m",
     when_received<Object>([](const Object& o) { return o.size_m[1]; }),
     "Width of the object across its heading."},
};
static_assert(fit_message(kObjectStateSignals));

constexpr SignalTable kObjectTables[] = {
    {message_index("ObjectList"), kObjectListSignals},
    {message_index("ObjectPosition"), kObjectPositionSignals},
    {message_index("ObjectMotion"), kObjectMotionSignals},
    {message_index("ObjectState"), kObjectStateSignals},
};

}  // namespace

std::span<const SignalTable> object_signals() { return kObjectTables; }

}  // namespace plumb
