// The height of the camera as the chain learns it from the speed of the vehicle.
#include <gtest/gtest.h>

#include "plumb/vehicle_speed_t.hpp"
#include "tests/replay/street_log.hpp"

namespace plumb {
namespace {

using test::StoredEvent;

constexpr double kTrueHeight_m = 1.65;
constexpr double kStep_m = 0.9;
constexpr double kSpeed_m_s = 9.0;

StoredEvent speed_event(std::int64_t time_us, double speed_m_s) {
  vehicle_speed_t message{};
  message.utime = time_us;
  message.speed_m_s = speed_m_s;
  message.scale_std = 0.005;
  return test::stored(time_us, kVehicleSpeed, message);
}

/// A straight drive on the street, with the vehicle's speed after each image.
std::vector<StoredEvent> speaking_street(double speed_m_s) {
  std::vector<StoredEvent> events;
  for (StoredEvent& event : test::street_log(test::drive(45, kStep_m))) {
    const bool is_image = event.channel == kCamera.name;
    const std::int64_t time_us = event.log_us;
    events.push_back(std::move(event));
    if (is_image) events.push_back(speed_event(time_us, speed_m_s));
  }
  return events;
}

PlumbConfig unsure_of_the_height() {
  PlumbConfig config;
  config.ground.camera_height_m = 1.8;
  config.ground.camera_height_std_m = 0.3;
  config.mount.height_stretch_m = 5.0;
  return config;
}

struct Drive {
  HeightReport height;
  double speed_m_s = kNan;
  double speed_std_m_s = kNan;
  std::int64_t num_refused = 0;
};

Drive drive_along(const std::vector<StoredEvent>& events) {
  Drive drive;
  Chain chain(unsure_of_the_height(), 1, nullptr, [&](const FrameRecord& record) {
    drive.speed_m_s = record.ego->velocity_ground_m_s[0];
    drive.speed_std_m_s = record.ego->speed_std_m_s;
  });
  for (const StoredEvent& event : events) chain.take(event.view());
  drive.height = chain.height();
  drive.num_refused = chain.num_refused();
  return drive;
}

TEST(VehicleSpeed, TeachesTheHeightWhileDriving) {
  const Drive drive = drive_along(speaking_street(kSpeed_m_s));
  EXPECT_EQ(drive.num_refused, 0);
  EXPECT_EQ(drive.height.status, HeightStatus::kLearned);
  EXPECT_NEAR(drive.height.by_vehicle.height_m, kTrueHeight_m, 0.02);
  EXPECT_NEAR(drive.height.by_vehicle.height_m, kTrueHeight_m, 3.0 * drive.height.by_vehicle.std_m);
  EXPECT_LT(drive.height.used.height_m, 1.79) << "on its way from the stated height";
  EXPECT_NEAR(drive.speed_m_s, kSpeed_m_s * drive.height.used.height_m / kTrueHeight_m, 0.15)
      << "the scale is that of the height in use";
  EXPECT_NEAR(drive.speed_m_s, kSpeed_m_s, drive.speed_std_m_s);
}

TEST(VehicleSpeed, ChangesNothingWhenNoneArrives) {
  const Drive drive = drive_along(test::street_log(test::drive(45, kStep_m)));
  EXPECT_EQ(drive.height.status, HeightStatus::kStated);
  EXPECT_EQ(drive.height.used.height_m, 1.8);
  EXPECT_NEAR(drive.speed_m_s, kSpeed_m_s * 1.8 / kTrueHeight_m, 0.15);
}

TEST(VehicleSpeed, RefusesWhatIsNoSpeed) {
  std::vector<StoredEvent> events = test::street_log(test::drive(3, kStep_m));
  events.push_back(speed_event(test::kStreetStart_us, 500.0));
  events.push_back({test::kStreetStart_us, kVehicleSpeed.name, {1, 2, 3}});
  EXPECT_EQ(drive_along(events).num_refused, 2);
}

}  // namespace
}  // namespace plumb
