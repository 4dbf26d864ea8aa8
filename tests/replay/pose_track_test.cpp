#include "tools/run/replay/pose_track.hpp"

#include <gtest/gtest.h>

namespace plumb {
namespace {

ego_motion_t at(double z_m, std::int8_t status) {
  ego_motion_t ego{};
  ego.status = status;
  ego.q_world_cam[0] = 1.0;
  ego.t_world_cam_m[2] = z_m;
  return ego;
}

TEST(PoseTrack, BeginsWithTheIdentityAndRepeatsWhatHeldLast) {
  PoseTrack track;
  const std::string identity = pose_row(PoseMatrix::Identity());
  const ego_motion_t starting = at(5.0, ego_motion_t::STATUS_INITIALIZING);
  const ego_motion_t good = at(2.0, ego_motion_t::STATUS_OK);
  const ego_motion_t lost = at(9.0, ego_motion_t::STATUS_LOST);
  EXPECT_EQ(track.row(nullptr), identity);
  EXPECT_EQ(track.row(&starting), identity);
  const std::string row = track.row(&good);
  EXPECT_NE(row, identity);
  EXPECT_EQ(track.row(&lost), row);
  EXPECT_EQ(track.row(nullptr), row);
}

TEST(PoseTrack, TakesEveryStatusUnderWhichMotionHolds) {
  for (const std::int8_t status :
       {ego_motion_t::STATUS_OK, ego_motion_t::STATUS_SCALE_HELD, ego_motion_t::STATUS_STANDSTILL,
        ego_motion_t::STATUS_COASTING}) {
    PoseTrack track;
    const ego_motion_t ego = at(2.0, status);
    EXPECT_NE(track.row(&ego), pose_row(PoseMatrix::Identity())) << int{status};
  }
}

}  // namespace
}  // namespace plumb
