#include "tools/evaluate/faults/fault_run.hpp"

namespace plumb {

FaultRun sound_run(const FaultDrive& drive) {
  FaultRun run{drive.camera, {}};
  for (const RecordedImage& image : drive.images) {
    run.shots.push_back({image.capture_us, image.seq, image.pixels, image.capture_us,
                         image.speed_m_s, false, image.position_m});
  }
  return run;
}

FaultRun faster_run(const FaultDrive& drive, std::size_t first, std::size_t n, std::size_t count) {
  FaultRun run{drive.camera, {}};
  const std::int64_t start_us = drive.images.at(first).capture_us;
  for (std::size_t i = first; i < drive.images.size() && run.shots.size() < count; i += n) {
    const RecordedImage& image = drive.images[i];
    const std::int64_t at_us =
        start_us + (image.capture_us - start_us) / static_cast<std::int64_t>(n);
    Shot shot{at_us,
              static_cast<std::int64_t>(run.shots.size()),
              image.pixels,
              at_us,
              0.0,
              false,
              image.position_m};
    if (!run.shots.empty()) {
      // A car that is so fast brakes harder, too: the speed of this very step is the truth.
      const Shot& last = run.shots.back();
      shot.true_speed_m_s = 1e6 * (shot.true_position_m - last.true_position_m) /
                            static_cast<double>(at_us - last.true_us);
    }
    run.shots.push_back(shot);
  }
  return run;
}

Pixels edited_picture(const Pixels& from,
                      const std::function<void(std::vector<std::uint8_t>*)>& edit) {
  auto pixels = std::make_shared<std::vector<std::uint8_t>>(*from);
  edit(pixels.get());
  return pixels;
}

}  // namespace plumb
