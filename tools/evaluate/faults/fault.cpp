#include "tools/evaluate/faults/fault.hpp"

#include <algorithm>
#include <random>

namespace plumb {
namespace {

constexpr std::int64_t kHour_us = 3'600'000'000;

/// Where faults begin: two fifths into the drive, when the estimators run.
std::size_t middle(const FaultRun& run) { return run.shots.size() * 2 / 5; }

/// Applies `change(shot, i)` to the images [from, from + count) and marks them as faulty.
template <typename Change>
FaultRun changed(FaultRun run, std::size_t from, std::size_t count, Change change) {
  const std::size_t end = std::min(run.shots.size(), from + count);
  const std::vector<Shot> before = run.shots;
  for (std::size_t i = from; i < end; ++i) {
    change(&run.shots[i], before, i);
    run.shots[i].faulty = true;
  }
  return run;
}

/// Sensor noise of `std_grey` on top of a picture, so that a repeated one is not equal to the bit.
Pixels noisy(const Pixels& from, double std_grey, std::size_t seed) {
  if (std_grey <= 0.0) return from;
  return edited_picture(from, [&](std::vector<std::uint8_t>* pixels) {
    std::mt19937 random(static_cast<unsigned>(seed));
    std::normal_distribution<float> noise(0.0F, static_cast<float>(std_grey));
    for (std::uint8_t& p : *pixels) {
      const float value = static_cast<float>(p) + noise(random);
      p = static_cast<std::uint8_t>(std::clamp(value + 0.5F, 0.0F, 255.0F));
    }
  });
}

/// A white block that changes its place with every image, as a clock in the picture does.
Pixels with_overlay(const Pixels& from, int width_px, std::size_t tick) {
  return edited_picture(from, [&](std::vector<std::uint8_t>* pixels) {
    const auto width = static_cast<std::size_t>(width_px);
    for (std::size_t v = 10; v < 40; ++v) {
      for (std::size_t u = 20; u < 200; ++u) {
        (*pixels)[v * width + u] = ((u / 6 + v / 8 + tick) % 3 == 0) ? 255 : 16;
      }
    }
  });
}

// --- clock -------------------------------------------------------------------------------------

Fault stamps_shift(const std::string& name, std::int64_t by_us, std::size_t count,
                   const std::string& words) {
  return {name, count == 1 ? 'C' : 'D', words, [by_us, count](const FaultDrive& drive) {
            FaultRun run = sound_run(drive);
            const std::size_t from = middle(run);
            // A lasting shift is a fault at its first image alone: later ones agree among
            // themselves.
            for (std::size_t i = from; i < std::min(run.shots.size(), from + count); ++i) {
              run.shots[i].stamp_us += by_us;
              run.shots[i].faulty = i == from || count == 1;
            }
            return run;
          }};
}

Fault stamps_scaled(const std::string& name, double factor, const std::string& words) {
  return {name, 'D', words, [factor](const FaultDrive& drive) {
            FaultRun run = sound_run(drive);
            for (Shot& shot : run.shots) {
              shot.stamp_us =
                  static_cast<std::int64_t>(static_cast<double>(shot.stamp_us) * factor);
              shot.faulty = true;
            }
            return run;
          }};
}

FaultRun neighbours_swapped(const FaultDrive& drive) {
  FaultRun run = sound_run(drive);
  const std::size_t at = middle(run);
  Shot& early = run.shots[at];
  Shot& late = run.shots[at + 1];
  std::swap(early.stamp_us, late.stamp_us);
  std::swap(early.seq, late.seq);
  std::swap(early.pixels, late.pixels);
  early.faulty = late.faulty = true;
  return run;
}

// --- source ------------------------------------------------------------------------------------

FaultRun numbers_anew(const FaultDrive& drive) {
  FaultRun run = sound_run(drive);
  const std::size_t from = middle(run);
  const std::int64_t by = run.shots[from].seq;
  for (std::size_t i = from; i < run.shots.size(); ++i) run.shots[i].seq -= by;
  run.shots[from].faulty = true;
  return run;
}

FaultRun second_pass(const FaultDrive& drive) {
  FaultRun run = sound_run(drive);
  const std::vector<Shot> pass = run.shots;
  const std::int64_t length_us = pass.back().true_us - pass.front().true_us + 100'000;
  for (Shot shot : pass) {
    shot.true_us += length_us;
    shot.faulty = shot.seq == pass.front().seq;
    run.shots.push_back(shot);
  }
  return run;
}

FaultRun two_publishers(const FaultDrive& drive) {
  FaultRun run{drive.camera, {}};
  const FaultRun one = sound_run(drive);
  const std::size_t half = one.shots.size() / 2;
  for (std::size_t i = 0; i < one.shots.size(); ++i) {
    run.shots.push_back(one.shots[i]);
    if (i < middle(one)) continue;
    run.shots.back().faulty = true;
    Shot other = one.shots[i];
    other.pixels = one.shots[(i + half) % one.shots.size()].pixels;
    other.stamp_us += 50'000;
    other.true_us += 50'000;
    other.seq += 5000;
    other.faulty = true;
    run.shots.push_back(other);
  }
  return run;
}

Fault gap(const std::string& name, std::size_t count, const std::string& words) {
  return {name, 'I', words, [count](const FaultDrive& drive) {
            FaultRun run = sound_run(drive);
            const auto from = run.shots.begin() + static_cast<std::ptrdiff_t>(middle(run));
            const auto to =
                from + static_cast<std::ptrdiff_t>(std::min<std::size_t>(
                           count, static_cast<std::size_t>(run.shots.end() - from) / 2));
            run.shots.erase(from, to);
            return run;
          }};
}

Fault faster_car(std::size_t n) {
  return {"fast_x" + std::to_string(n), 'I',
          "every " + std::to_string(n) + ". image at the same rate: a car that many times as fast",
          [n](const FaultDrive& drive) { return faster_run(drive, 0, n, drive.images.size()); }};
}

// --- pictures ----------------------------------------------------------------------------------

Fault repeated_once(const std::string& name, double noise_grey) {
  return {name, 'E', "one image shows the picture before it again",
          [noise_grey](const FaultDrive& drive) {
            FaultRun run = sound_run(drive);
            const std::size_t at = middle(run);
            return changed(run, at, 1,
                           [&](Shot* shot, const std::vector<Shot>& before, std::size_t i) {
                             shot->pixels = noisy(before[i - 1].pixels, noise_grey, i);
                           });
          }};
}

/// Three seconds of a picture that `show` makes of the last sound one and the present one.
using Show = std::function<Pixels(const std::vector<Shot>& before, std::size_t from, std::size_t i,
                                  int width_px)>;
Fault wrong_pictures(const std::string& name, const std::string& words, const Show& show) {
  return {name, 'E', words, [show](const FaultDrive& drive) {
            FaultRun run = sound_run(drive);
            const std::size_t from = middle(run);
            const std::size_t count = std::min<std::size_t>(30, (run.shots.size() - from) / 2);
            return changed(run, from, count,
                           [&](Shot* shot, const std::vector<Shot>& before, std::size_t i) {
                             shot->pixels = show(before, from, i, drive.camera.width_px);
                           });
          }};
}

Pixels rows_of_two(const Pixels& upper, const Pixels& lower) {
  return edited_picture(upper, [&](std::vector<std::uint8_t>* pixels) {
    const auto half = static_cast<std::ptrdiff_t>(pixels->size() / 2);
    std::copy(lower->begin() + half, lower->end(), pixels->begin() + half);
  });
}

Pixels mirrored(const Pixels& from, int width_px) {
  return edited_picture(from, [&](std::vector<std::uint8_t>* pixels) {
    for (auto row = pixels->begin(); row != pixels->end(); row += width_px) {
      std::reverse(row, row + width_px);
    }
  });
}

Pixels upside_down(const Pixels& from) {
  return edited_picture(from, [](std::vector<std::uint8_t>* pixels) {
    std::reverse(pixels->begin(), pixels->end());
  });
}

Fault each_picture_n_times(std::size_t n) {
  return {"each_" + std::to_string(n) + "_times", 'E',
          "a slow video sent at a higher rate: each picture " + std::to_string(n) + " times",
          [n](const FaultDrive& drive) {
            FaultRun run{drive.camera, {}};
            std::int64_t seq = 0;
            for (std::size_t i = 0; i + 1 < drive.images.size(); ++i) {
              const RecordedImage& image = drive.images[i];
              const std::int64_t step_us = (drive.images[i + 1].capture_us - image.capture_us) /
                                           static_cast<std::int64_t>(n);
              for (std::size_t k = 0; k < n; ++k, ++seq) {
                const std::int64_t at_us =
                    image.capture_us + step_us * static_cast<std::int64_t>(k);
                run.shots.push_back({at_us, seq, noisy(image.pixels, 0.5, i * n + k), at_us,
                                     image.speed_m_s, k > 0, image.position_m});
              }
            }
            return run;
          }};
}

std::vector<Fault> picture_faults() {
  std::vector<Fault> rows = {repeated_once("repeat_exact", 0.0),
                             repeated_once("repeat_noise_1", 1.0),
                             repeated_once("repeat_noise_2", 2.0)};
  const auto first_sound = [](const std::vector<Shot>& before, std::size_t from) {
    return before[from - 1].pixels;
  };
  rows.push_back(wrong_pictures("frozen", "the picture is frozen for 3 s",
                                [=](const auto& before, std::size_t from, std::size_t, int) {
                                  return first_sound(before, from);
                                }));
  rows.push_back(wrong_pictures("frozen_overlay",
                                "the picture is frozen, a clock in its corner runs",
                                [=](const auto& before, std::size_t from, std::size_t i, int w) {
                                  return with_overlay(first_sound(before, from), w, i);
                                }));
  rows.push_back(wrong_pictures("frozen_pixel", "the picture is frozen but for one pixel",
                                [=](const auto& before, std::size_t from, std::size_t i, int) {
                                  return edited_picture(
                                      first_sound(before, from), [i](auto* pixels) {
                                        pixels->front() = static_cast<std::uint8_t>(i);
                                      });
                                }));
  rows.push_back(wrong_pictures("lower_half_frozen", "the lower half of the picture is frozen",
                                [=](const auto& before, std::size_t from, std::size_t i, int) {
                                  return rows_of_two(before[i].pixels, first_sound(before, from));
                                }));
  rows.push_back(wrong_pictures("torn", "the lower half of each picture is one image old",
                                [](const auto& before, std::size_t, std::size_t i, int) {
                                  return rows_of_two(before[i].pixels, before[i - 1].pixels);
                                }));
  for (const std::size_t n : {2UL, 3UL, 5UL}) {
    rows.push_back(wrong_pictures("ring_" + std::to_string(n),
                                  "a ring of " + std::to_string(n) + " stale buffers",
                                  [n](const auto& before, std::size_t from, std::size_t i, int) {
                                    return noisy(before[from - 1 - (i - from) % n].pixels, 0.5, i);
                                  }));
  }
  rows.push_back(wrong_pictures("mirrored", "the picture is mirrored for 3 s",
                                [](const auto& before, std::size_t, std::size_t i, int w) {
                                  return mirrored(before[i].pixels, w);
                                }));
  rows.push_back(wrong_pictures("black", "the picture is black for 3 s",
                                [](const auto& before, std::size_t, std::size_t i, int) {
                                  return edited_picture(before[i].pixels, [](auto* pixels) {
                                    std::fill(pixels->begin(), pixels->end(), std::uint8_t{3});
                                  });
                                }));
  return rows;
}

// --- geometry ----------------------------------------------------------------------------------

FaultRun all_upside_down(const FaultDrive& drive) {
  FaultRun run = sound_run(drive);
  for (Shot& shot : run.shots) {
    shot.pixels = upside_down(shot.pixels);
    shot.faulty = true;
  }
  return run;
}

FaultRun upside_down_at_first(const FaultDrive& drive) {
  FaultRun run = sound_run(drive);
  for (std::size_t i = 0; i < run.shots.size() / 3; ++i) {
    run.shots[i].pixels = upside_down(run.shots[i].pixels);
    run.shots[i].faulty = true;
  }
  return run;
}

/// Not a fault, but what a car does: the drive is run through from its end.
FaultRun reversing(const FaultDrive& drive) {
  FaultRun run = sound_run(drive);
  const std::size_t num = run.shots.size();
  for (std::size_t i = 0; i < num; ++i) {
    const RecordedImage& shown = drive.images[num - 1 - i];
    const RecordedImage& before = drive.images[std::min(num - 1, num - i)];
    Shot& shot = run.shots[i];
    shot.stamp_us = shot.true_us =
        drive.images.front().capture_us + (drive.images.back().capture_us - shown.capture_us);
    shot.pixels = shown.pixels;
    // The step to this image is the one that the recorded car made after it.
    shot.true_speed_m_s = -before.speed_m_s;
    shot.true_position_m = -shown.position_m;
  }
  return run;
}

FaultRun focal_length_doubled(const FaultDrive& drive) {
  FaultRun run = sound_run(drive);
  run.camera.fx_px *= 2.0;
  run.camera.fy_px *= 2.0;
  for (Shot& shot : run.shots) shot.faulty = true;
  return run;
}

std::vector<Fault> make_all() {
  std::vector<Fault> rows = {
      {"sound", '-', "nothing", sound_run},
      stamps_shift("jump_forward_200ms", 200'000, 10'000, "stamps are 200 ms later from here on"),
      stamps_shift("jump_back_80ms", -80'000, 10'000, "stamps are 80 ms earlier from here on"),
      stamps_shift("jump_back_1h", -kHour_us, 10'000, "stamps are 1 h earlier from here on"),
      stamps_shift("jump_forward_1h", kHour_us, 10'000, "stamps are 1 h later from here on"),
      stamps_shift("one_stamp_1h_ahead", kHour_us, 1, "one image is stamped 1 h ahead"),
      stamps_shift("one_stamp_1h_back", -kHour_us, 1, "one image is stamped 1 h back"),
      stamps_shift("one_stamp_60ms_late", 60'000, 1, "one image is stamped 60 ms late"),
      stamps_scaled("stamps_in_ms", 1e-3, "milliseconds in the field of microseconds"),
      stamps_scaled("stamps_in_ns", 1e3, "nanoseconds in the field of microseconds"),
      {"neighbours_swapped", 'C', "two neighbouring images come in the wrong order",
       neighbours_swapped},
      {"numbers_anew", 'J', "sequence numbers begin at 0 again", numbers_anew},
      {"second_pass", 'C', "the log is played twice", second_pass},
      {"two_publishers", 'J', "a second source publishes on CAMERA", two_publishers},
      gap("gap_300ms", 3, "three images are missing"),
      gap("gap_2s", 20, "20 images are missing"),
      faster_car(2),
      faster_car(3),
      faster_car(4)};
  for (Fault& fault : picture_faults()) rows.push_back(std::move(fault));
  rows.push_back(each_picture_n_times(2));
  rows.push_back(each_picture_n_times(3));
  rows.push_back({"upside_down", 'M', "the camera is mounted upside down", all_upside_down});
  rows.push_back({"upside_down_at_first", 'M',
                  "the camera is upside down for the first third of the drive",
                  upside_down_at_first});
  rows.push_back({"reversing", 'I', "no fault: the car reverses all the time", reversing});
  rows.push_back({"focal_length_doubled", 'H', "the calibration states twice the focal length",
                  focal_length_doubled});
  return rows;
}

}  // namespace

const std::vector<Fault>& all_faults() {
  static const std::vector<Fault> faults = make_all();
  return faults;
}

}  // namespace plumb
