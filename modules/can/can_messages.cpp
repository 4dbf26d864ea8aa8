// The signal tables. Column order: name, start bit, length, factor, offset, value, [has_sna].
// tests/can/dbc_test.cpp compares every row with config/plumbline.dbc.
#include "modules/can/can_codec.hpp"

namespace plumb {
namespace {

using V = CanValues;

constexpr Signal kEgoMotion[] = {
    {"EgoMotion_Crc", 0, 8, 1.0, 0.0, nullptr, false},
    {"EgoMotion_AliveCtr", 8, 4, 1.0, 0.0, nullptr},
    {"EgoMotion_Validity", 12, 2, 1.0, 0.0, &V::ego_validity},
    {"EgoMotion_Standstill", 14, 2, 1.0, 0.0, &V::standstill},
    {"EgoMotion_FrameCtr", 16, 8, 1.0, 0.0, &V::frame_counter, false},
    {"EgoMotion_Speed", 24, 16, 0.005, -100.0, &V::speed_m_s},
    {"EgoMotion_YawRate", 40, 16, 0.00005, -1.6384, &V::yaw_rate_rad_s},
    {"EgoMotion_SpeedStd", 56, 8, 0.02, 0.0, &V::speed_std_m_s},
};

constexpr Signal kEgoMotionDetail[] = {
    {"EgoDetail_Crc", 0, 8, 1.0, 0.0, nullptr, false},
    {"EgoDetail_AliveCtr", 8, 4, 1.0, 0.0, nullptr},
    {"EgoDetail_Status", 12, 4, 1.0, 0.0, &V::ego_status},
    {"EgoDetail_FrameCtr", 16, 8, 1.0, 0.0, &V::frame_counter, false},
    {"EgoDetail_AccelX", 24, 12, 0.01, -20.0, &V::accel_m_s2},
    {"EgoDetail_AccelXStd", 36, 8, 0.02, 0.0, &V::accel_std_m_s2},
    {"EgoDetail_YawRateStd", 44, 10, 0.0001, 0.0, &V::yaw_rate_std_rad_s},
    {"EgoDetail_SpeedY", 54, 10, 0.02, -10.0, &V::lateral_speed_m_s},
};

constexpr Signal kGroundPlane[] = {
    {"GroundPlane_Crc", 0, 8, 1.0, 0.0, nullptr, false},
    {"GroundPlane_AliveCtr", 8, 4, 1.0, 0.0, nullptr},
    {"GroundPlane_Validity", 12, 2, 1.0, 0.0, &V::plane_validity},
    {"GroundPlane_FrameCtr", 16, 8, 1.0, 0.0, &V::frame_counter, false},
    {"GroundPlane_Pitch", 24, 16, 0.00002, -0.65536, &V::pitch_rad},
    {"GroundPlane_Roll", 40, 12, 0.0002, -0.4096, &V::roll_rad},
    {"GroundPlane_Height", 52, 12, 0.001, 0.0, &V::height_m},
};

constexpr Signal kGroundPlaneDetail[] = {
    {"GroundDetail_Crc", 0, 8, 1.0, 0.0, nullptr, false},
    {"GroundDetail_AliveCtr", 8, 4, 1.0, 0.0, nullptr},
    {"GroundDetail_Status", 12, 4, 1.0, 0.0, &V::plane_status},
    {"GroundDetail_FrameCtr", 16, 8, 1.0, 0.0, &V::frame_counter, false},
    {"GroundDetail_PitchStd", 24, 10, 0.00005, 0.0, &V::pitch_std_rad},
    {"GroundDetail_RollStd", 34, 10, 0.00005, 0.0, &V::roll_std_rad},
    {"GroundDetail_HeightStd", 44, 10, 0.0005, 0.0, &V::height_std_m},
    {"GroundDetail_Reason", 54, 4, 1.0, 0.0, &V::plane_reason},
    {"GroundDetail_CuesUsed", 58, 4, 1.0, 0.0, &V::cues_used},
};

constexpr Signal kOdometryX[] = {
    {"OdomX_Crc", 0, 8, 1.0, 0.0, nullptr, false},
    {"OdomX_AliveCtr", 8, 4, 1.0, 0.0, nullptr},
    {"OdomX_Validity", 12, 2, 1.0, 0.0, &V::ego_validity},
    {"OdomX_FrameCtr", 16, 8, 1.0, 0.0, &V::frame_counter, false},
    {"OdomX_PosX", 24, 24, 0.005, -41943.04, &V::x_m},
    {"OdomX_Heading", 48, 16, 0.0001, -3.2768, &V::heading_rad},
};

constexpr Signal kOdometryY[] = {
    {"OdomY_Crc", 0, 8, 1.0, 0.0, nullptr, false},
    {"OdomY_AliveCtr", 8, 4, 1.0, 0.0, nullptr},
    {"OdomY_Validity", 12, 2, 1.0, 0.0, &V::ego_validity},
    {"OdomY_FrameCtr", 16, 8, 1.0, 0.0, &V::frame_counter, false},
    {"OdomY_PosY", 24, 24, 0.005, -41943.04, &V::y_m},
    {"OdomY_PosZ", 48, 16, 0.05, -1638.4, &V::z_m},
};

constexpr Signal kOdometryDistance[] = {
    {"OdomDist_Crc", 0, 8, 1.0, 0.0, nullptr, false},
    {"OdomDist_AliveCtr", 8, 4, 1.0, 0.0, nullptr},
    {"OdomDist_Validity", 12, 2, 1.0, 0.0, &V::ego_validity},
    {"OdomDist_FrameCtr", 16, 8, 1.0, 0.0, &V::frame_counter, false},
    {"OdomDist_Distance", 24, 24, 0.05, 0.0, &V::distance_m},
    {"OdomDist_ResetCtr", 48, 8, 1.0, 0.0, &V::reset_counter},
    {"OdomDist_ScaleStd", 56, 8, 0.002, 0.0, &V::scale_std_ratio},
};

constexpr Signal kStatus[] = {
    {"Status_Crc", 0, 8, 1.0, 0.0, nullptr, false},
    {"Status_AliveCtr", 8, 4, 1.0, 0.0, nullptr},
    {"Status_Mode", 12, 4, 1.0, 0.0, &V::mode},
    {"Status_EgoStatus", 16, 4, 1.0, 0.0, &V::ego_status},
    {"Status_EgoReason", 20, 4, 1.0, 0.0, &V::ego_reason},
    {"Status_GroundStatus", 24, 4, 1.0, 0.0, &V::plane_status},
    {"Status_GroundReason", 28, 4, 1.0, 0.0, &V::plane_reason},
    {"Status_NumMissed", 32, 8, 1.0, 0.0, &V::num_missed},
    {"Status_NumOverflowed", 40, 8, 1.0, 0.0, &V::num_overflowed},
    {"Status_NumRejected", 48, 8, 1.0, 0.0, &V::num_rejected},
    {"Status_NumUnsent", 56, 8, 1.0, 0.0, &V::num_unsent},
};

constexpr Signal kInfo[] = {
    {"Info_Crc", 0, 8, 1.0, 0.0, nullptr, false},
    {"Info_AliveCtr", 8, 4, 1.0, 0.0, nullptr},
    {"Info_DatabaseVersion", 16, 8, 1.0, 0.0, &V::database_version},
    {"Info_VersionMajor", 24, 8, 1.0, 0.0, &V::version_major},
    {"Info_VersionMinor", 32, 8, 1.0, 0.0, &V::version_minor},
    {"Info_VersionPatch", 40, 8, 1.0, 0.0, &V::version_patch},
    {"Info_Uptime", 48, 16, 1.0, 0.0, &V::uptime_s},
};

constexpr Signal kMountState[] = {
    {"Mount_Crc", 0, 8, 1.0, 0.0, nullptr, false},
    {"Mount_AliveCtr", 8, 4, 1.0, 0.0, nullptr},
    {"Mount_Status", 12, 4, 1.0, 0.0, &V::mount_status},
    {"Mount_Reason", 16, 4, 1.0, 0.0, &V::mount_reason},
    {"Mount_Progress", 20, 8, 0.005, 0.0, &V::mount_progress},
    {"Mount_PitchChange", 28, 12, 0.0002, -0.4096, &V::mount_pitch_rad},
    {"Mount_RollChange", 40, 12, 0.0002, -0.4096, &V::mount_roll_rad},
    {"Mount_YawChange", 52, 12, 0.0002, -0.4096, &V::mount_yaw_rad},
};

constexpr Signal kObjectList[] = {
    {"ObjList_Crc", 0, 8, 1.0, 0.0, nullptr, false},
    {"ObjList_AliveCtr", 8, 4, 1.0, 0.0, nullptr},
    {"ObjList_Count", 12, 4, 1.0, 0.0, &V::num_objects},
    {"ObjList_FrameCtr", 16, 8, 1.0, 0.0, &V::object_frame_counter, false},
    {"ObjList_NumLeftOut", 24, 8, 1.0, 0.0, &V::num_objects_left_out},
};

constexpr Signal kObjectPosition[] = {
    {"ObjPos_Crc", 0, 8, 1.0, 0.0, nullptr, false},
    {"ObjPos_AliveCtr", 8, 4, 1.0, 0.0, nullptr},
    {"ObjPos_Index", 12, 4, 1.0, 0.0, &V::object_index, false},
    {"ObjPos_FrameCtr", 16, 8, 1.0, 0.0, &V::object_frame_counter, false},
    {"ObjPos_PosX", 24, 12, 0.05, -4.0, &V::object_x_m},
    {"ObjPos_PosY", 36, 12, 0.05, -102.4, &V::object_y_m},
    {"ObjPos_PosXStd", 48, 8, 0.05, 0.0, &V::object_x_std_m},
    {"ObjPos_PosYStd", 56, 8, 0.02, 0.0, &V::object_y_std_m},
};

constexpr Signal kObjectMotion[] = {
    {"ObjMot_Crc", 0, 8, 1.0, 0.0, nullptr, false},
    {"ObjMot_AliveCtr", 8, 4, 1.0, 0.0, nullptr},
    {"ObjMot_Index", 12, 4, 1.0, 0.0, &V::object_index, false},
    {"ObjMot_FrameCtr", 16, 8, 1.0, 0.0, &V::object_frame_counter, false},
    {"ObjMot_VelX", 24, 12, 0.05, -102.4, &V::object_vx_m_s},
    {"ObjMot_VelY", 36, 12, 0.02, -40.96, &V::object_vy_m_s},
    {"ObjMot_VelXStd", 48, 8, 0.05, 0.0, &V::object_vx_std_m_s},
    {"ObjMot_VelYStd", 56, 8, 0.05, 0.0, &V::object_vy_std_m_s},
};

constexpr Signal kObjectState[] = {
    {"ObjState_Crc", 0, 8, 1.0, 0.0, nullptr, false},
    {"ObjState_AliveCtr", 8, 4, 1.0, 0.0, nullptr},
    {"ObjState_Index", 12, 4, 1.0, 0.0, &V::object_index, false},
    {"ObjState_FrameCtr", 16, 8, 1.0, 0.0, &V::object_frame_counter, false},
    {"ObjState_Id", 24, 8, 1.0, 0.0, &V::object_id},
    {"ObjState_Class", 32, 4, 1.0, 0.0, &V::object_class},
    {"ObjState_Status", 36, 3, 1.0, 0.0, &V::object_status},
    {"ObjState_Age", 39, 9, 0.1, 0.0, &V::object_age_s},
    {"ObjState_TimeToCollision", 48, 9, 0.05, 0.0, &V::object_ttc_s},
    {"ObjState_Width", 57, 7, 0.05, 0.0, &V::object_width_m},
};

constexpr CanTrigger kCyclic = CanTrigger::kNone;
constexpr CanTrigger kPerFrame = CanTrigger::kCameraFrame;

constexpr std::array<Message, kNumMessages> kMessages = {{
    {"PLB_EgoMotion", 0x3A0, 0x3A01, 10, kCyclic, kEgoMotion},
    {"PLB_EgoMotionDetail", 0x3A1, 0x3A02, 10, kCyclic, kEgoMotionDetail},
    {"PLB_GroundPlane", 0x3A2, 0x3A03, 10, kCyclic, kGroundPlane},
    {"PLB_GroundPlaneDetail", 0x3A3, 0x3A04, 10, kCyclic, kGroundPlaneDetail},
    {"PLB_OdometryX", 0x3A4, 0x3A05, 20, kPerFrame, kOdometryX},
    {"PLB_OdometryY", 0x3A5, 0x3A06, 20, kPerFrame, kOdometryY},
    {"PLB_OdometryDistance", 0x3A6, 0x3A07, 20, kPerFrame, kOdometryDistance},
    {"PLB_Status", 0x3A7, 0x3A08, 100, kCyclic, kStatus},
    {"PLB_Info", 0x3A8, 0x3A09, 1000, kCyclic, kInfo},
    {"PLB_Mount", 0x3A9, 0x3A0E, 1000, CanTrigger::kMountMessage, kMountState},
}};

constexpr std::array<Message, kNumObjectMessages> kObjectMessages = {{
    {"PLB_ObjectList", 0x3B0, 0x3A0A, 100, kPerFrame, kObjectList},
    {"PLB_ObjectPosition", 0x3B1, 0x3A0B, 0, kPerFrame, kObjectPosition},
    {"PLB_ObjectMotion", 0x3B2, 0x3A0C, 0, kPerFrame, kObjectMotion},
    {"PLB_ObjectState", 0x3B3, 0x3A0D, 0, kPerFrame, kObjectState},
}};

}  // namespace

const std::array<Message, kNumMessages>& messages() { return kMessages; }
const std::array<Message, kNumObjectMessages>& object_messages() { return kObjectMessages; }

}  // namespace plumb
