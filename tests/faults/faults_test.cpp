/// Tests the fault matrix itself: each row injects what it says, and the judge tells right results
/// from wrong ones.

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "tests/replay/street_log.hpp"
#include "tools/evaluate/faults/fault_judge.hpp"

namespace plumb {
namespace {

/// The rendered street with its exact speed: 9 m/s at 10 images/s.
const FaultDrive& street() {
  static const FaultDrive drive = [] {
    const test::Scene scene(test::scene_camera());
    FaultDrive made{"street", scene.camera(), {}};
    for (std::size_t i = 0; i < test::street_drive().size(); ++i) {
      const auto image = scene.render(test::street_drive()[i], 1.5, static_cast<unsigned>(i + 1));
      made.images.push_back({test::kStreetStart_us + static_cast<std::int64_t>(i) * 100'000,
                             static_cast<std::int64_t>(i),
                             std::make_shared<std::vector<std::uint8_t>>(image.pixels), 9.0,
                             0.9 * static_cast<double>(i)});
    }
    return made;
  }();
  return drive;
}

const Fault& fault(const std::string& name) {
  for (const Fault& one : all_faults())
    if (one.name == name) return one;
  throw std::runtime_error("no fault " + name);
}

TEST(Faults, NamesAreUniqueAndTheFirstRowIsTheSoundDrive) {
  std::set<std::string> names;
  for (const Fault& one : all_faults()) EXPECT_TRUE(names.insert(one.name).second) << one.name;
  EXPECT_EQ(all_faults().front().name, "sound");
}

TEST(Faults, EveryRowMarksWhatIsFaultyAndKeepsTheTrueTimeInOrder) {
  for (const Fault& one : all_faults()) {
    const FaultRun run = one.make(street());
    ASSERT_FALSE(run.shots.empty()) << one.name;
    std::int64_t last_us = 0;
    for (const Shot& shot : run.shots) {
      EXPECT_GE(shot.true_us, last_us) << one.name;
      last_us = shot.true_us;
      EXPECT_EQ(shot.pixels->size(), street().images.front().pixels->size()) << one.name;
    }
  }
  for (const Shot& shot : fault("sound").make(street()).shots) EXPECT_FALSE(shot.faulty);
}

TEST(Faults, ARingShowsTheSameFewPicturesAgain) {
  const FaultRun run = fault("ring_3").make(street());
  for (std::size_t i = 3; i < run.shots.size(); ++i) {
    if (!run.shots[i].faulty || !run.shots[i - 3].faulty) continue;
    double difference = 0.0;
    for (std::size_t k = 0; k < run.shots[i].pixels->size(); ++k) {
      difference += std::abs((*run.shots[i].pixels)[k] - (*run.shots[i - 3].pixels)[k]);
    }
    EXPECT_LT(difference / static_cast<double>(run.shots[i].pixels->size()), 1.0);
  }
}

TEST(Faults, TheSoundStreetIsRight) {
  const FaultResult result = run_fault(fault("sound").make(street()), PlumbConfig{});
  EXPECT_GT(result.num_valid, 25);
  EXPECT_EQ(result.num_wrong, 0) << result.worst_error_m_s;
}

/// docs/faults.md says which faults are open.
bool is_open(const Fault& one) {
  return one.name == "upside_down" || one.name == "focal_length_doubled";
}

TEST(Faults, NoneLeavesAWrongSpeedThatIsMarkedAsValid) {
  for (const Fault& one : all_faults()) {
    if (is_open(one)) continue;
    const FaultResult result = run_fault(one.make(street()), PlumbConfig{});
    EXPECT_EQ(result.num_wrong, 0) << one.name << ": " << result.worst_error_m_s << " m/s";
  }
}

TEST(Faults, SeveralDrivesKeepTheLargestErrorAndTheLongestTime) {
  FaultResult first, second, lost;
  first.num_valid = 8;
  first.num_wrong = 1;
  first.worst_error_m_s = 2.0;
  second.num_valid = 9;
  second.worst_error_m_s = 0.5;
  second.recover_s = 0.3;
  lost.recover_s = -1.0;
  FaultResult sum;
  sum.add(first);
  sum.add(second);
  EXPECT_NEAR(sum.wrong_ratio(), 1.0 / 17.0, 1e-12);
  EXPECT_EQ(sum.worst_error_m_s, 2.0);
  EXPECT_EQ(sum.recover_s, 0.3);
  sum.add(lost);
  sum.add(second);
  EXPECT_LT(sum.recover_s, 0.0) << "one drive never recovers";
}

TEST(Faults, TheJudgeSeesASpeedThatIsNotTheTruth) {
  FaultRun run = fault("sound").make(street());
  for (Shot& shot : run.shots) shot.true_speed_m_s += 5.0;
  const FaultResult result = run_fault(run, PlumbConfig{});
  EXPECT_EQ(result.num_wrong, result.num_valid);
  EXPECT_NEAR(result.worst_error_m_s, 5.0, 1.0);
}

TEST(Faults, ACameraThatIsUpsideDownIsNeverBelieved) {
  const FaultResult result = run_fault(fault("upside_down").make(street()), PlumbConfig{});
  EXPECT_EQ(result.num_valid, 0);
  EXPECT_EQ(result.last_reason, "image_upside_down");
}

TEST(Faults, ACameraThatIsTurnedUprightIsBelievedAgain) {
  const FaultResult result = run_fault(fault("upside_down_at_first").make(street()), PlumbConfig{});
  EXPECT_EQ(result.num_wrong, 0) << result.worst_error_m_s;
  EXPECT_GT(result.num_valid, 0);
}

}  // namespace
}  // namespace plumb
