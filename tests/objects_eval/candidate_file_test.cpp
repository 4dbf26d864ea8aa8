#include "tools/datasets/kitti_tracking/candidate_file.hpp"

#include <gtest/gtest.h>

#include "tests/support/expect_throw.hpp"
#include "tests/support/temp_folder.hpp"
#include "tools/datasets/kitti_tracking/kitti_tracking.hpp"

namespace plumb {
namespace {

CandidateRow row_of(int frame, ObjectClass object_class, const Box& box, double score) {
  return {frame, object_class, {box, score}};
}

TEST(CandidateFile, ReadsWhatItWrites) {
  const test::TempFolder folder;
  const std::vector<CandidateRow> rows{
      row_of(0, ObjectClass::kCar, {10.25, 20.5, 110.75, 80.0}, 0.8125),
      row_of(7, ObjectClass::kCyclist, {1.0, 2.0, 3.0, 4.0}, -0.5)};
  folder.write("c.txt", "# frame type left top right bottom score\n" + candidate_line(rows[0]) +
                            "\n" + candidate_line(rows[1]));
  const std::vector<CandidateRow> again = read_candidates(folder / "c.txt");
  ASSERT_EQ(again.size(), 2U);
  EXPECT_EQ(again[1].frame, 7);
  EXPECT_EQ(again[1].object_class, ObjectClass::kCyclist);
  EXPECT_DOUBLE_EQ(again[0].candidate.score, 0.8125);
  EXPECT_DOUBLE_EQ(again[0].candidate.box.right_px, 110.75);
  EXPECT_DOUBLE_EQ(again[1].candidate.score, -0.5);
}

TEST(CandidateFile, NamesTheLineThatIsWrong) {
  const test::TempFolder folder;
  const auto refusal = [&](const char* text) {
    folder.write("c.txt", text);
    return test::input_error_of([&] { (void)read_candidates(folder / "c.txt"); });
  };
  EXPECT_NE(refusal("0 Car 1 2 3 4 0.5\n1 Car 1 2 3 4\n").find("c.txt:2: 6 columns, expected 7"),
            std::string::npos);
  EXPECT_NE(refusal("0 Car 1 2 x 4 0.5\n").find("c.txt:1: column 5: 'x' is not a finite number"),
            std::string::npos);
  EXPECT_NE(refusal("0 Car 3 2 1 4 0.5\n").find("c.txt:1: an empty box"), std::string::npos);
}

TEST(CandidateFile, GivesEachDetectionItsOwnCandidatesBestFirst) {
  DetectionFrame frame;
  frame.seq = 3;
  const Box left{100.0, 100.0, 200.0, 180.0}, right{300.0, 100.0, 400.0, 180.0};
  for (const Box& box : {left, right}) {
    Detection detection;
    detection.object_class = ObjectClass::kCar;
    detection.box = box;
    (void)frame.detections.push_back(detection);
  }
  const auto near = [](Box box, double right_by_px) {
    box.left_px += right_by_px;
    box.right_px += right_by_px;
    return box;
  };
  std::vector<CandidateRow> rows{row_of(3, ObjectClass::kCar, near(left, 5.0), 0.3),
                                 row_of(3, ObjectClass::kCar, near(left, -2.0), 0.9),
                                 row_of(3, ObjectClass::kCar, near(right, 1.0), 0.7),
                                 row_of(3, ObjectClass::kCar, near(right, 60.0), 0.8),
                                 row_of(3, ObjectClass::kVan, left, 0.8),
                                 row_of(4, ObjectClass::kCar, left, 0.8)};
  attach_candidates(rows, &frame);
  ASSERT_EQ(frame.detections[0].candidates.size(), 2U);
  EXPECT_DOUBLE_EQ(frame.detections[0].candidates[0].score, 0.9);
  EXPECT_DOUBLE_EQ(frame.detections[0].candidates[1].score, 0.3);
  ASSERT_EQ(frame.detections[1].candidates.size(), 1U);
  EXPECT_DOUBLE_EQ(frame.detections[1].candidates[0].score, 0.7);
  // No more than a message holds, and those are the best ones.
  for (int k = 0; k < 40; ++k) rows.push_back(row_of(3, ObjectClass::kCar, left, 0.01 * k));
  attach_candidates(rows, &frame);
  ASSERT_EQ(frame.detections[0].candidates.size(), kMaxCandidates);
  EXPECT_DOUBLE_EQ(frame.detections[0].candidates[0].score, 0.9);
  EXPECT_DOUBLE_EQ(frame.detections[0].candidates[1].score, 0.39);
}

TEST(CandidateFile, KnowsTheTypesOfTheLabels) {
  for (std::size_t i = 1; i < kNumObjectClasses; ++i) {
    const auto object_class = static_cast<ObjectClass>(i);
    EXPECT_EQ(object_class_of(kitti_name_of(object_class)), object_class);
  }
  EXPECT_EQ(object_class_of("Person_sitting"), ObjectClass::kPedestrian);
  EXPECT_EQ(object_class_of("Tram"), ObjectClass::kUnknown);
}

}  // namespace
}  // namespace plumb
