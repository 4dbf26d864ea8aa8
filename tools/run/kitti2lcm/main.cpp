/// plumb-kitti2lcm: converts a KITTI sequence to an LCM log for lcm-logplayer and plumb-replay.

#include <iostream>
#include <string>

#include "core/input_error.hpp"
#include "modules/datasets/text.hpp"
#include "platform/command_line.hpp"
#include "platform/overwrite_guard.hpp"
#include "tools/run/kitti2lcm/convert.hpp"
#include "tools/support/stop_flag.hpp"
#include "tools/support/tool_main.hpp"

namespace {

constexpr const char* kFooter =
    R"(SEQ_DIR is an odometry sequence (image_0/000000.png.., calib.txt, times.txt, perhaps poses.txt; numbers may
start anywhere) or a raw drive, synced and rectified (image_00/data, image_00/timestamps.txt, oxts, and
calib_cam_to_cam.txt in it or one folder up).

Examples
  plumb-kitti2lcm dataset/sequences/05 --poses dataset/poses/05.txt --out 05.lcm
  plumb-kitti2lcm 2011_09_26/2011_09_26_drive_0009_sync --out 0009.lcm --camera-height 1.65
  plumb-kitti2lcm dataset/sequences/00 --camera 2 --start 100 --end 299 --compress jpeg --out part.lcm)";

void add_options(plumb::CommandLine* app, plumb::SequenceOptions* sequence,
                 plumb::ConvertOptions* convert, std::string* compress) {
  app->footer(kFooter);
  app->add_option("SEQ_DIR", sequence->folder, "folder of the sequence").required();
  app->add_option("--out", convert->out, "log to write").required();
  app->add_option("--camera", sequence->camera,
                  "0 left grey, 1 right grey, 2 left colour, 3 right colour")
      .check(plumb::within(0, 3))
      .capture_default_str();
  app->add_option("--compress", *compress,
                  "none: plain pixels; jpeg: quality 95, about a third of the size")
      .check(plumb::one_of({"none", "jpeg"}))
      .capture_default_str();
  app->add_option("--poses", sequence->poses,
                  "true poses [SEQ_DIR/poses.txt, or a raw drive's oxts]");
  app->add_option("--planes", sequence->planes,
                  "true ground planes [SEQ_DIR/gt_ground_plane*.txt]");
  app->add_option("--detections", convert->detections,
                  "boxes: KITTI tracking labels, or a tracker's output [SEQ_DIR/label_02.txt]");
  app->add_option("--candidates", convert->candidates,
                  "the detector's boxes before suppression, rows 'frame type left top right bottom "
                  "score'");
  app->add_flag("--vehicle-speed", convert->vehicle_speed,
                "write the true speed as VEHICLE_SPEED, as if the vehicle stated it");
  app->add_option(
         "--residual-k1", sequence->residual_k1,
         "radial term of r^2 left in the rectified images [calib.txt's residual_k1, else 0.0256]")
      .check(plumb::within(-0.2, 0.2));
  app->add_option(
         "--residual-k2", sequence->residual_k2,
         "radial term of r^4 [calib.txt's residual_k2, else -0.0076; 0 beside a stated k1]")
      .check(plumb::within(-0.2, 0.2));
  app->add_option(
         "--camera-height", sequence->camera_height_m,
         "optical centre above the road [calib.txt's camera_height_m, else the configuration's]")
      .check(plumb::within(0.3, 4.0));
  app->add_option(
         "--readout", sequence->readout_s,
         "readout time of a rolling shutter, first row to last, s [calib.txt's readout_s, else 0]")
      .check(plumb::within(0.0, 0.1));
  app->add_option("--start", sequence->start, "first frame number").check(plumb::at_least(0));
  app->add_option("--end", sequence->end, "last frame number").check(plumb::at_least(0));
}

void refuse_overwriting(const plumb::SequenceOptions& sequence,
                        const plumb::ConvertOptions& convert) {
  plumb::OverwriteGuard()
      .reads("--poses", sequence.poses)
      .reads("--planes", sequence.planes)
      .reads("--detections", convert.detections)
      .reads("--candidates", convert.candidates)
      .reads_folder("SEQ_DIR", sequence.folder, {".txt", ".png"})
      .writes("--out", convert.out)
      .check();
}

int run(const plumb::SequenceOptions& options, plumb::ConvertOptions convert_options) {
  refuse_overwriting(options, convert_options);
  plumb::catch_stop_signals();
  const plumb::Sequence sequence = plumb::read_sequence(options);
  const std::filesystem::path labels = options.folder / "label_02.txt";
  if (convert_options.detections.empty() && std::filesystem::exists(labels)) {
    convert_options.detections = labels;
    std::cerr << "plumb-kitti2lcm: boxes from " << labels.string() << "\n";
  }
  if (!convert_options.candidates.empty() && convert_options.detections.empty())
    throw plumb::InputError("--candidates belong to boxes: give --detections, too");
  for (const std::string& note : sequence.notes) std::cerr << "plumb-kitti2lcm: " << note << "\n";
  const plumb::ConvertResult result = plumb::convert(sequence, convert_options);
  std::cout << plumb::format(
      "%s: %lld frames, %.1f s, %.1f MB; %lld with a pose, %lld with a plane; %lld boxes%s\n",
      convert_options.out.c_str(), static_cast<long long>(result.num_frames), result.duration_s,
      1e-6 * static_cast<double>(result.log_bytes), static_cast<long long>(result.num_poses),
      static_cast<long long>(result.num_planes), static_cast<long long>(result.num_detections),
      result.stopped ? "; stopped early" : "");
  if (result.concern != nullptr) {
    std::cerr << "plumb-kitti2lcm: warning: " << result.concern << "\n";
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  plumb::SequenceOptions sequence;
  plumb::ConvertOptions convert;
  std::string compress = "none";
  plumb::CommandLine app("Converts a KITTI sequence to an LCM log", "plumb-kitti2lcm");
  add_options(&app, &sequence, &convert, &compress);
  return plumb::tool_main(&app, argc, argv, [&] {
    convert.jpeg = compress == "jpeg";
    return run(sequence, convert);
  });
}
