#include "tools/evaluate/trust/trust_rows.hpp"

#include <algorithm>

namespace plumb {
namespace {

constexpr std::size_t kStartImages = 24;  // of a run that asks how a start comes out
constexpr std::size_t kStartEvery = 8;    // images of the drive from one start to the next

TrustRow starts(std::size_t n) {
  return {"starts_x" + std::to_string(n), "starts all over the drive, every n-th image", n,
          [n](const FaultDrive& drive) {
            std::vector<FaultRun> runs;
            const std::size_t every = kStartEvery;
            for (std::size_t i = 0; i + 12 * n < drive.images.size(); i += every) {
              runs.push_back(faster_run(drive, i, n, kStartImages));
            }
            return runs;
          }};
}

TrustRow fast(std::size_t n) {
  return {"fast_x" + std::to_string(n), "every n-th image, each n-th of the drives", n,
          [n](const FaultDrive& drive) {
            std::vector<FaultRun> runs;
            for (std::size_t i = 0; i < n; ++i) {
              runs.push_back(faster_run(drive, i, n, drive.images.size()));
            }
            return runs;
          }};
}

TrustRow gaps(const std::string& name, std::size_t missing) {
  return {name, "images are missing, at several places", 1, [missing](const FaultDrive& drive) {
            std::vector<FaultRun> runs;
            for (std::size_t at = 15; at + missing + 15 < drive.images.size(); at += 12) {
              FaultRun run = sound_run(drive);
              const auto from = run.shots.begin() + static_cast<std::ptrdiff_t>(at);
              run.shots.erase(from, from + static_cast<std::ptrdiff_t>(missing));
              // Enough of the drive before the gap and after it.
              const std::size_t end = std::min(run.shots.size(), at + 40);
              run.shots.erase(run.shots.begin() + static_cast<std::ptrdiff_t>(end),
                              run.shots.end());
              const std::size_t begin = at > 40 ? at - 40 : 0;
              run.shots.erase(run.shots.begin(),
                              run.shots.begin() + static_cast<std::ptrdiff_t>(begin));
              runs.push_back(std::move(run));
            }
            return runs;
          }};
}

/// From a quarter of the drive on, the lower part of the picture has next to no contrast.
FaultRun dark_road(const FaultDrive& drive) {
  FaultRun run = sound_run(drive);
  for (std::size_t i = run.shots.size() / 4; i < run.shots.size(); ++i) {
    run.shots[i].pixels = edited_picture(run.shots[i].pixels, [](auto* pixels) {
      const std::size_t from = pixels->size() * 11 / 20;
      for (std::size_t k = from; k < pixels->size(); ++k) {
        (*pixels)[k] = static_cast<std::uint8_t>(24 + (*pixels)[k] / 24);
      }
    });
  }
  return run;
}

}  // namespace

const std::vector<TrustRow>& all_trust_rows() {
  static const std::vector<TrustRow> rows = {
      {"sound", "nothing", 1,
       [](const FaultDrive& drive) { return std::vector{sound_run(drive)}; }},
      starts(1),
      starts(2),
      starts(3),
      starts(4),
      fast(2),
      fast(3),
      fast(4),
      gaps("gap_300ms", 3),
      gaps("gap_1s", 10),
      gaps("gap_2s", 20),
      {"dark_road", "the road shows nothing from a quarter of the drive on", 1,
       [](const FaultDrive& drive) { return std::vector{dark_road(drive)}; }}};
  return rows;
}

}  // namespace plumb
