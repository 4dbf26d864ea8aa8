/// Writes the log of a made-up drive for the test of plumb-can on a real kernel.
///
///     drive_log LOG            writes GROUND_PLANE, EGO_MOTION, MOUNT and OBJECTS to LOG
///     drive_log LOG --trace T  reads a log with these channels, writes its replay's CAN trace to T
///     drive_log LOG --play URL SPEED   publishes it as if its images were taken at that moment
///
/// The drive has every status, values beyond every range, a lost frame, frames that lost one half,
/// and lists from no object to more objects than CAN carries. In between, a car can drive like it.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <span>
#include <thread>
#include <vector>

#include "core/channels.hpp"
#include "core/numbers.hpp"
#include "modules/can/can_wire.hpp"
#include "platform/bus.hpp"
#include "platform/can_trace.hpp"
#include "platform/clock.hpp"
#include "platform/log_file.hpp"

namespace plumb {
namespace {

constexpr int kFirstSeq = 100;  // the 8-bit frame counter wraps on the way
constexpr int kNumFrames = 200;
constexpr std::int64_t kFrameUs = 100'000;

std::int64_t time_of(int frame) { return (frame + 1) * kFrameUs; }

/// A sum of sines around `mean`, so that successive frames differ in every signal.
double wave(int frame, double mean, double amplitude, double period) {
  return mean + amplitude * std::sin(6.283185307179586 * frame / period);
}

ego_motion_t ego_of(int frame) {
  ego_motion_t m{};
  m.seq = kFirstSeq + frame;
  m.utime = m.capture_mono_us = time_of(frame);
  m.status = static_cast<std::int8_t>(frame / 10 % 6);
  m.reason = static_cast<std::int8_t>(frame % 12);
  m.reset_counter = frame / 90;
  // Every 50th frame leaves the ranges on both sides.
  const double wild = frame % 50 == 49 ? 1e6 : frame % 50 == 48 ? -1e6 : 0.0;
  m.velocity_ground_m_s[0] = wave(frame, 15.0, 10.0, 137.0) + wild;
  m.velocity_ground_m_s[1] = wave(frame, 0.0, 0.4, 23.0) - wild;
  m.speed_std_m_s = wave(frame, 0.2, 0.15, 19.0);
  m.rate_ground_rad_s[2] = wave(frame, 0.0, 0.3, 41.0) + wild;
  m.yaw_rate_std_rad_s = wave(frame, 0.01, 0.005, 13.0);
  m.accel_forward_m_s2 = frame % 7 == 0 ? kNan : wave(frame, 0.0, 3.0, 29.0);
  m.accel_forward_std_m_s2 = wave(frame, 0.5, 0.4, 17.0);
  const double left_rad = wave(frame, 0.0, 3.0, 211.0);
  m.q_world_cam[0] = std::cos(-left_rad / 2);
  m.q_world_cam[2] = std::sin(-left_rad / 2);
  m.t_world_cam_m[0] = wave(frame, 50.0, 300.0, 97.0) + wild;
  m.t_world_cam_m[1] = wave(frame, 0.0, 8.0, 83.0);
  m.t_world_cam_m[2] = 1.37 * frame - wild;
  m.distance_m = 1.5 * frame;
  m.log_scale_std = wave(frame, 0.05, 0.04, 31.0);
  return m;
}

ground_plane_t plane_of(int frame) {
  ground_plane_t m{};
  m.seq = kFirstSeq + frame;
  m.utime = m.capture_mono_us = time_of(frame);
  m.status = static_cast<std::int8_t>(frame / 15 % 4);
  m.reason = static_cast<std::int8_t>(frame % 9);
  const double wild = frame % 40 == 39 ? 100.0 : 0.0;
  m.pitch_rad = wave(frame, 0.01, 0.03, 27.0) - wild;
  m.roll_rad = wave(frame, 0.0, 0.05, 33.0) + wild;
  m.height_m = wave(frame, 1.65, 0.1, 21.0) + wild;
  for (int i = 0; i < 3; ++i) m.cov[i][i] = wave(frame + 5 * i, 3e-6, 2e-6, 15.0);
  m.num_cues = 3;
  m.cues.resize(3);
  for (int i = 0; i < 3; ++i) m.cues[i].status = static_cast<std::int8_t>((frame >> i) % 2);
  return m;
}

object_t object_of(int frame, int index) {
  object_t o{};
  const int phase = frame + 7 * index;
  o.track_id = 3 * index + frame / 40;
  o.class_id = static_cast<std::int8_t>(phase % 7);
  o.status = static_cast<std::int8_t>(phase % 9 == 0   ? object_t::STATUS_NOT_LOCALISED
                                      : phase % 4 == 0 ? object_t::STATUS_PREDICTED
                                                       : object_t::STATUS_MEASURED);
  const double wild = phase % 60 == 59 ? 1e6 : phase % 60 == 58 ? -1e6 : 0.0;
  o.position_ground_m[0] = wave(phase, 60.0, 55.0, 37.0) + wild;
  o.position_ground_m[1] = wave(phase, 0.0, 30.0, 23.0) - wild;
  o.velocity_ground_m_s[0] = phase % 5 == 0 ? kNan : wave(phase, 0.0, 30.0, 41.0) + wild;
  o.velocity_ground_m_s[1] = phase % 5 == 0 ? kNan : wave(phase, 0.0, 8.0, 19.0) - wild;
  for (int i = 0; i < 2; ++i) {
    o.position_cov_m2[i][i] = wave(phase + 3 * i, 4.0, 3.5, 29.0);
    o.velocity_cov_m2_s2[i][i] = wave(phase + 5 * i, 2.0, 1.9, 17.0);
  }
  o.size_m[1] = wave(phase, 1.8, 0.4, 13.0);
  o.time_to_collision_s = phase % 3 == 0 ? kNan : wave(phase, 10.0, 9.5, 31.0) + std::abs(wild);
  o.age_s = 0.1 * phase;
  return o;
}

objects_t objects_of(int frame) {
  objects_t m{};
  m.seq = kFirstSeq + frame;
  m.utime = m.capture_mono_us = time_of(frame);
  m.num_objects = frame % 12;
  for (int i = 0; i < m.num_objects; ++i) m.objects.push_back(object_of(frame, i));
  m.num_refused = frame % 50 == 49 ? 1'000 : 0;
  return m;
}

mount_t mount_of(int frame) {
  mount_t m{};
  m.utime = time_of(frame);
  m.status = static_cast<std::int8_t>(frame / 10 % 4);
  m.reason = static_cast<std::int8_t>(frame / 10 % 5);
  m.progress = 0.005 * frame;
  for (int i = 0; i < 3; ++i) m.recent_rad[i] = wave(frame + 7 * i, 0.0, 0.5, 70.0);
  return m;
}

template <typename MessageType>
void put(LogWriter& log, const Channel& channel, const MessageType& message) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  log.write(message.utime, channel.name, bytes);
}

void write_log(const char* path) {
  LogWriter log(path);
  for (int frame = 0; frame < kNumFrames; ++frame) {
    if (frame == 120) continue;  // a camera frame that nobody saw
    if (frame != 140) put(log, kGroundPlane, plane_of(frame));
    if (frame != 160) put(log, kEgoMotion, ego_of(frame));
    if (frame != 170) put(log, kObjects, objects_of(frame));
    if (frame % 10 == 5) put(log, kMount, mount_of(frame));
  }
  log.close();
}

template <typename MessageType>
bool take(const LogEvent& event, const Channel& channel, MessageType* message) {
  return event.channel == channel.name &&
         message->decode(event.data.data(), 0, static_cast<int>(event.data.size())) >= 0;
}

bool write_trace(const char* log_path, const char* trace_path) {
  LogReader log(log_path);
  CanTraceWriter trace(trace_path, "can0");
  CanOutput output{CanConfig{}};
  ground_plane_t plane;
  ego_motion_t ego;
  objects_t objects;
  mount_t mount;
  LogEvent event;
  while (log.next(&event)) {
    if (take(event, kGroundPlane, &plane)) {
      output.advance(plane.utime, trace);
      output.on_ground_plane(plane, plane.utime);
    } else if (take(event, kEgoMotion, &ego)) {
      output.advance(ego.utime, trace);
      output.on_ego_motion(ego, ego.utime);
    } else if (take(event, kObjects, &objects)) {
      output.advance(objects.utime, trace);
      if (const char* const fault = output.on_objects(objects, objects.utime))
        std::printf("objects of %lld: %s\n", static_cast<long long>(objects.seq), fault);
    } else if (take(event, kMount, &mount)) {
      output.advance(mount.utime, trace);
      output.on_mount(mount, mount.utime);
    }
  }
  output.finish(trace);
  std::printf("%lld camera frames\n", static_cast<long long>(output.counters().num_frames));
  return trace.flush();
}

/// Publishes a message with the present as the time of its image.
template <typename MessageType>
bool publish(Bus& bus, const LogEvent& event, const Channel& channel, MessageType* message) {
  if (!take(event, channel, message)) return false;
  if constexpr (requires { message->capture_mono_us; }) message->capture_mono_us = monotonic_us();
  Publisher<MessageType>(bus, channel).publish(*message);
  return true;
}

void play(const char* log_path, const char* url, double speed) {
  Counters counters;
  Bus bus(url, &counters);
  LogReader log(log_path);
  ground_plane_t plane;
  ego_motion_t ego;
  objects_t objects;
  mount_t mount;
  LogEvent event;
  const std::int64_t start_us = monotonic_us();
  while (log.next(&event)) {
    const auto due_us = start_us + std::llround(static_cast<double>(event.log_us) / speed);
    const std::int64_t wait_us = due_us - monotonic_us();
    if (wait_us > 0) std::this_thread::sleep_for(std::chrono::microseconds(wait_us));
    (void)(publish(bus, event, kGroundPlane, &plane) || publish(bus, event, kEgoMotion, &ego) ||
           publish(bus, event, kObjects, &objects) || publish(bus, event, kMount, &mount));
  }
}

}  // namespace
}  // namespace plumb

int main(int argc, char** argv) {
  try {
    if (argc == 2) {
      plumb::write_log(argv[1]);
      return 0;
    }
    if (argc == 4 && std::strcmp(argv[2], "--trace") == 0) {
      return plumb::write_trace(argv[1], argv[3]) ? 0 : 1;
    }
    if (argc == 5 && std::strcmp(argv[2], "--play") == 0) {
      plumb::play(argv[1], argv[3], std::atof(argv[4]));
      return 0;
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "drive_log: %s\n", error.what());
    return 1;
  }
  std::fprintf(stderr, "usage: drive_log LOG [--trace TRACE | --play URL SPEED]\n");
  return 2;
}
