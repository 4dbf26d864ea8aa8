/// Reads the LCM log of one plumb-camera session and checks it against
/// the expectations of the session.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "core/channels.hpp"
#include "modules/camera/image_wire.hpp"
#include "platform/bounded_decode.hpp"
#include "platform/log_file.hpp"
#include "plumb/process_health_t.hpp"

namespace {

struct Frame {
  std::int64_t capture_us;
  std::int64_t seq;
};

struct Session {
  std::vector<Frame> frames;
  cv::Mat last_image;
  int num_calibrations = 0;
  bool calibration_came_first = false;
  std::vector<plumb::process_health_t> health;
  std::vector<std::string> problems;
};

struct Expectation {
  std::string log;
  int width = 0;
  int height = 0;
  double rate_hz = 0.0;
  int min_frames = 1;
  int min_dropped = 0;
  int min_rejected = 0;
  std::vector<std::string> reasons;
  std::string raw;
  std::string raw_format;
};

void take_image(const plumb::LogEvent& event, const Expectation& expected, Session* session) {
  plumb::ImageFrame image;
  if (const char* why = plumb::read_image(event.data, &image)) {
    session->problems.emplace_back(why);
    return;
  }
  if (image.width_px != expected.width || image.height_px != expected.height || image.compressed) {
    session->problems.push_back("an image is " + std::to_string(image.width_px) + "x" +
                                std::to_string(image.height_px));
    return;
  }
  if (session->frames.empty()) session->calibration_came_first = session->num_calibrations == 1;
  session->frames.push_back({image.capture_us, image.seq});
  cv::Mat(image.height_px, image.width_px, CV_8U, const_cast<std::uint8_t*>(image.data.data()),
          static_cast<std::size_t>(image.row_stride_bytes))
      .copyTo(session->last_image);
}

Session read(const Expectation& expected) {
  Session session;
  plumb::LogReader reader(expected.log);
  plumb::LogEvent event;
  while (reader.next(&event)) {
    if (event.channel == plumb::kCamera.name) take_image(event, expected, &session);
    if (event.channel == plumb::kCameraCalibration.name) ++session.num_calibrations;
    if (event.channel == plumb::kHealthCamera.name) {
      plumb::process_health_t health;
      if (plumb::decode_bounded(event.data, &health)) {
        session.health.push_back(health);
      } else {
        session.problems.emplace_back("a health message does not decode");
      }
    }
  }
  return session;
}

void check_frames(const Expectation& expected, Session* s) {
  const auto problem = [s](const std::string& text) { s->problems.push_back(text); };
  if (static_cast<int>(s->frames.size()) < expected.min_frames) problem("too few frames");
  if (!s->calibration_came_first) problem("no calibration before the first image");
  std::vector<std::int64_t> steps_us;
  for (std::size_t i = 1; i < s->frames.size(); ++i) {
    if (s->frames[i].seq <= s->frames[i - 1].seq) problem("seq does not increase");
    if (s->frames[i].capture_us <= s->frames[i - 1].capture_us) problem("utime does not increase");
    if (s->frames[i].seq == s->frames[i - 1].seq + 1) {
      steps_us.push_back(s->frames[i].capture_us - s->frames[i - 1].capture_us);
    }
  }
  if (steps_us.empty() || s->health.empty()) return;
  std::nth_element(steps_us.begin(),
                   steps_us.begin() + static_cast<std::ptrdiff_t>(steps_us.size() / 2),
                   steps_us.end());
  const double period_us = static_cast<double>(steps_us[steps_us.size() / 2]);
  std::printf("  median frame period %.1f ms\n", period_us * 1e-3);
  if (std::abs(period_us * expected.rate_hz * 1e-6 - 1.0) > 0.1)
    problem("frame period is not the driver's");
  // Time stamps and health share CLOCK_MONOTONIC. vivid stamps the end of a frame when it begins
  // it, up to a period ahead. The device may be missing during the last seconds of a session.
  const std::int64_t ahead_us = s->frames.back().capture_us - s->health.back().utime;
  if (ahead_us > 300'000 || ahead_us < -15'000'000) problem("stamps are from another clock");
}

void check_counters(const Expectation& expected, Session* s) {
  if (s->health.size() < 2) return s->problems.push_back("no health messages");
  // The last message announces the stop and repeats the counters of the one before it.
  const plumb::process_health_t& last = s->health[s->health.size() - 2];
  std::int64_t num_gaps = 0;
  for (std::size_t i = 1; i < s->frames.size(); ++i)
    num_gaps += s->frames[i].seq - s->frames[i - 1].seq - 1;
  std::printf("  %zu frames, seq %" PRId64 "..%" PRId64 ", missing %" PRId64
              "; health: received %" PRId64 ", rejected %" PRId64 ", dropped %" PRId64 "\n",
              s->frames.size(), s->frames.empty() ? -1 : s->frames.front().seq,
              s->frames.empty() ? -1 : s->frames.back().seq, num_gaps, last.num_received,
              last.num_rejected, last.num_dropped);
  if (last.num_dropped < expected.min_dropped) s->problems.emplace_back("too few drops counted");
  if (last.num_rejected < expected.min_rejected)
    s->problems.emplace_back("too few rejections counted");
  if (num_gaps != last.num_dropped + last.num_rejected) {
    s->problems.emplace_back("seq gaps differ from dropped + rejected: a loss went uncounted");
  }
}

void check_reasons(const Expectation& expected, Session* s) {
  auto at = s->health.begin();
  for (const std::string& reason : expected.reasons) {
    at = std::find_if(at, s->health.end(), [&](const plumb::process_health_t& h) {
      return reason == "running" ? h.state == 0 : h.state_reason.find(reason) != std::string::npos;
    });
    if (at == s->health.end()) {
      s->problems.push_back("health never said, in its turn: " + reason);
      return;
    }
    if (reason != "running") {
      std::printf("  health at %.1f s: state %d, %s\n", static_cast<double>(at->utime) * 1e-6,
                  at->state, at->state_reason.c_str());
    }
  }
}

/// Compares with the same still picture from v4l2-ctl, whose luma OpenCV computes.
void check_raw(const Expectation& expected, Session* s) {
  std::ifstream stream(expected.raw, std::ios::binary);
  std::vector<char> bytes((std::istreambuf_iterator<char>(stream)),
                          std::istreambuf_iterator<char>());
  const cv::Size size(expected.width, expected.height);
  cv::Mat luma;
  const std::size_t pixels = static_cast<std::size_t>(size.area());
  if (expected.raw_format == "YUYV" && bytes.size() == 2 * pixels) {
    cv::cvtColor(cv::Mat(size, CV_8UC2, bytes.data()), luma, cv::COLOR_YUV2GRAY_YUY2);
  } else if (expected.raw_format == "NV12" && bytes.size() == pixels * 3 / 2) {
    cv::cvtColor(cv::Mat(size.height * 3 / 2, size.width, CV_8U, bytes.data()), luma,
                 cv::COLOR_YUV2GRAY_NV12);
  } else if (expected.raw_format == "GREY" && bytes.size() == pixels) {
    luma = cv::Mat(size, CV_8U, bytes.data());
  } else {
    return s->problems.push_back(expected.raw + " has " + std::to_string(bytes.size()) + " bytes");
  }
  if (s->last_image.size() != size) return s->problems.push_back("no image to compare");
  cv::Scalar mean;
  cv::Scalar spread;
  cv::meanStdDev(luma, mean, spread);
  const double difference = cv::norm(luma, s->last_image, cv::NORM_INF);
  std::printf(
      "  against v4l2-ctl: greatest difference %.0f grey levels (picture: mean %.0f, spread "
      "%.0f)\n",
      difference, mean[0], spread[0]);
  if (difference != 0.0)
    s->problems.emplace_back("image differs from the one another program captures");
  if (spread[0] < 10.0) s->problems.emplace_back("the picture has no structure to compare");
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Checks the LCM log of one plumb-camera session");
  Expectation expected;
  app.add_option("log", expected.log)->required();
  app.add_option("--width", expected.width)->required();
  app.add_option("--height", expected.height)->required();
  app.add_option("--rate", expected.rate_hz)->required();
  app.add_option("--min-frames", expected.min_frames);
  app.add_option("--min-dropped", expected.min_dropped);
  app.add_option("--min-rejected", expected.min_rejected);
  app.add_option("--health", expected.reasons,
                 "part of a state_reason, or 'running'; in this order");
  app.add_option("--raw", expected.raw, "one frame as v4l2-ctl stored it");
  app.add_option("--raw-format", expected.raw_format);
  CLI11_PARSE(app, argc, argv);
  try {
    Session session = read(expected);
    check_counters(expected, &session);
    check_frames(expected, &session);
    check_reasons(expected, &session);
    if (!expected.raw.empty()) check_raw(expected, &session);
    for (const std::string& problem : session.problems)
      std::printf("  FAILED: %s\n", problem.c_str());
    return session.problems.empty() ? 0 : 1;
  } catch (const std::exception& error) {
    std::printf("  FAILED: %s\n", error.what());
    return 1;
  }
}
