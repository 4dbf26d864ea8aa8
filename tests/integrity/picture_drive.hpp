/// Runs images through a PictureMemory and puts faults into images.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "modules/integrity/picture_memory.hpp"
#include "tests/integrity/picture_scene.hpp"

namespace plumb::test {

using Pictures = std::vector<cv::Mat>;

/// Returns one letter per image: . is fresh, R repeated, F frozen, S stale, T torn, P partly
/// frozen, M mirrored, U upside down, ? unproven.
inline std::string verdicts(const Pictures& pictures, double interval_s = 0.1,
                            std::vector<PictureVerdict>* all = nullptr) {
  PictureMemory memory(pictures[0].cols, pictures[0].rows, {});
  std::string letters;
  for (const cv::Mat& picture : pictures) {
    const PictureVerdict verdict = memory.update(view_of(picture), {true, interval_s});
    letters += ".RFSTPMU?"[static_cast<std::size_t>(verdict.reason)];
    if (all != nullptr) all->push_back(verdict);
  }
  return letters;
}

/// Returns `pictures` with picture i replaced by change(pictures, i).
inline Pictures changed(const Pictures& pictures,
                        const std::function<cv::Mat(const Pictures&, std::size_t)>& change) {
  Pictures result;
  for (std::size_t i = 0; i < pictures.size(); ++i) result.push_back(change(pictures, i));
  return result;
}

/// Returns each picture `times` times, every time with its own noise.
inline Pictures multiplied(const Pictures& pictures, int times, double noise_grey) {
  Pictures result;
  int seed = 0;
  for (const cv::Mat& picture : pictures)
    for (int i = 0; i < times; ++i) result.push_back(with_noise(picture, noise_grey, ++seed));
  return result;
}

/// Returns a copy of `target` with the rows [from, to) of `source`, which are shares of the height.
inline cv::Mat with_rows(const cv::Mat& target, const cv::Mat& source, double from, double to) {
  cv::Mat result = target.clone();
  const cv::Range rows(static_cast<int>(from * target.rows), static_cast<int>(to * target.rows));
  source.rowRange(rows).copyTo(result.rowRange(rows));
  return result;
}

}  // namespace plumb::test
