/// Reads and writes a detector's boxes from before suppression, with their scores: the candidates
/// of equation (10) of Song and Chandraker, CVPR 2014.
///
/// Format:
///   Each line has frame, type, left, top, right, bottom and score; types are those of KITTI's
///   labels. Lines that begin with # are comments.
/// Frames:
///   img, as in detection.hpp.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "modules/detections/detection.hpp"

namespace plumb {

struct CandidateRow {
  int frame = 0;
  ObjectClass object_class = ObjectClass::kUnknown;
  Candidate candidate;
};

/// Rows in the order of the file. Throws InputError ("FILE:LINE: reason").
[[nodiscard]] std::vector<CandidateRow> read_candidates(const std::filesystem::path& path);

/// The line of one candidate, with its end.
[[nodiscard]] std::string candidate_line(const CandidateRow& row);

/// Gives the frame's detections their candidates: each candidate of image `frame->seq` goes to the
/// detection of its class with which it overlaps most, by half of the union or more. A detection
/// keeps the best kMaxCandidates by their scores, in that order.
void attach_candidates(const std::vector<CandidateRow>& rows, DetectionFrame* frame);

}  // namespace plumb
