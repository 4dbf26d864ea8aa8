#include "tools/datasets/kitti_tracking/candidate_file.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "core/input_error.hpp"
#include "modules/datasets/number_file.hpp"
#include "modules/datasets/text.hpp"
#include "tools/datasets/kitti_tracking/kitti_tracking.hpp"

namespace plumb {
namespace {

constexpr std::size_t kCandidateColumns = 7;
constexpr double kLeastUnionShare = 0.5;

CandidateRow parse_candidate(const std::vector<std::string_view>& words, const std::string& at) {
  const auto value = [&](std::size_t column) {
    const std::optional<double> number = parse_number(words[column]);
    if (number) return *number;
    throw InputError(at + "column " + std::to_string(column + 1) + ": '" +
                     std::string(words[column]) + "' is not a finite number");
  };
  CandidateRow row;
  row.frame = static_cast<int>(value(0));
  row.object_class = object_class_of(words[1]);
  row.candidate = {{value(2), value(3), value(4), value(5)}, value(6)};
  const Box& box = row.candidate.box;
  if (!(box.width_px() > 0.0) || !(box.height_px() > 0.0)) throw InputError(at + "an empty box");
  return row;
}

/// The detection to which a candidate belongs; null for none.
Detection* owner_of(const CandidateRow& row, DetectionFrame* frame) {
  Detection* owner = nullptr;
  double most = kLeastUnionShare;
  for (Detection& detection : frame->detections) {
    const double overlap = intersection_over_union(detection.box, row.candidate.box);
    if (detection.object_class != row.object_class || overlap < most) continue;
    most = overlap;
    owner = &detection;
  }
  return owner;
}

}  // namespace

std::vector<CandidateRow> read_candidates(const std::filesystem::path& path) {
  std::vector<CandidateRow> rows;
  int line = 0;
  for (const std::string& text : read_lines(path)) {
    ++line;
    const std::vector<std::string_view> words = split_words(text);
    if (words.empty() || words[0].starts_with('#')) continue;
    const std::string at = path.string() + ":" + std::to_string(line) + ": ";
    if (words.size() != kCandidateColumns)
      throw InputError(at + std::to_string(words.size()) + " columns, expected 7");
    rows.push_back(parse_candidate(words, at));
  }
  return rows;
}

std::string candidate_line(const CandidateRow& row) {
  const Box& box = row.candidate.box;
  return format("%d %s %.2f %.2f %.2f %.2f %.4f\n", row.frame, kitti_name_of(row.object_class),
                box.left_px, box.top_px, box.right_px, box.bottom_px, row.candidate.score);
}

void attach_candidates(const std::vector<CandidateRow>& rows, DetectionFrame* frame) {
  std::vector<const CandidateRow*> best_first;
  for (const CandidateRow& row : rows) {
    if (row.frame == frame->seq) best_first.push_back(&row);
  }
  std::stable_sort(best_first.begin(), best_first.end(),
                   [](const CandidateRow* a, const CandidateRow* b) {
                     return a->candidate.score > b->candidate.score;
                   });
  for (Detection& detection : frame->detections) detection.candidates.clear();
  for (const CandidateRow* row : best_first) {
    if (Detection* owner = owner_of(*row, frame)) (void)owner->candidates.push_back(row->candidate);
  }
}

}  // namespace plumb
