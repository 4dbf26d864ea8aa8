/// plumb-planes: true ground planes of a drive from its Velodyne scans.

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "core/input_error.hpp"
#include "core/numbers.hpp"
#include "modules/datasets/text.hpp"
#include "platform/overwrite_guard.hpp"
#include "tools/kitti/road_scan.hpp"
#include "tools/support/progress.hpp"
#include "tools/support/tool_main.hpp"

namespace plumb {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFooter =
    R"(DRIVE is an odometry sequence (velodyne/000000.bin.., calib.txt with Tr) or a raw drive
(velodyne_points/data, calibration in it or one folder up). Scans that the data set lacks are left out.
The file is that of plumb-eval plane and of plumb-kitti2lcm --planes.

Examples
  plumb-planes dataset/sequences/04 --out 04_planes.txt
  plumb-planes dataset/sequences/04 --labels dataset/sequences/04/labels --out 04_planes.txt)";

struct PlanesArguments {
  std::string drive, labels, out, against, json;
  RoadScanOptions options;
};

fs::path scans_of(const fs::path& drive) {
  for (const fs::path& folder : {drive / "velodyne", drive / "velodyne_points" / "data"}) {
    if (fs::is_directory(folder)) return folder;
  }
  throw InputError(drive.string() + " has neither velodyne nor velodyne_points/data");
}

std::vector<fs::path> list_scans(const fs::path& folder) {
  std::vector<fs::path> scans;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".bin") scans.push_back(entry.path());
  }
  if (scans.empty()) throw InputError(folder.string() + " holds no scan (.bin)");
  std::sort(scans.begin(), scans.end());
  return scans;
}

/// The number in the name of a scan.
std::int64_t frame_of(const fs::path& scan) {
  const std::string stem = scan.stem().string();
  if (stem.empty() || stem.size() > 12 ||
      stem.find_first_not_of("0123456789") != std::string::npos) {
    throw InputError(scan.string() + ": its name is not the number of a frame");
  }
  return std::stoll(stem);
}

/// Says how far the planes are from those of a file, over the frames that both have.
void compare_with(const PlanesArguments& arguments,
                  const std::map<std::int64_t, TruePlane>& planes) {
  double height_sum = 0.0, pitch_sum = 0.0, roll_sum = 0.0;
  int num = 0;
  for (const auto& [frame, other] : read_planes(arguments.against)) {
    const auto found = planes.find(frame);
    if (found == planes.end()) continue;
    ++num;
    height_sum += std::pow(found->second.height_m - other.height_m, 2);
    pitch_sum += std::pow(found->second.pitch_rad() - other.pitch_rad(), 2);
    roll_sum += std::pow(found->second.roll_rad() - other.roll_rad(), 2);
  }
  if (num == 0) throw InputError(arguments.against + " has no frame of the scans");
  const double height_m = std::sqrt(height_sum / num);
  const double pitch_deg = degrees(std::sqrt(pitch_sum / num));
  const double roll_deg = degrees(std::sqrt(roll_sum / num));
  std::cout << format("against %s, %d frames, rms: height %.4f m, pitch %.4f deg, roll %.4f deg\n",
                      arguments.against.c_str(), num, height_m, pitch_deg, roll_deg);
  if (arguments.json.empty()) return;
  std::ofstream file(arguments.json);
  file << nlohmann::ordered_json{{"num_frames", num},
                                 {"height_rms_m", height_m},
                                 {"pitch_rms_deg", pitch_deg},
                                 {"roll_rms_deg", roll_deg}}
              .dump(2)
       << "\n";
  file.close();
  if (!file) throw InputError("cannot write " + arguments.json);
}

/// Fits every scan. Scans without a road are left out.
std::map<std::int64_t, TruePlane> fit_scans(const PlanesArguments& arguments,
                                            const std::vector<fs::path>& scans, std::string* rows) {
  const Se3 T_cam_velo = read_T_cam_velo(arguments.drive);
  std::map<std::int64_t, TruePlane> planes;
  std::int64_t num_done = 0;
  Progress progress("fitting", "scans", static_cast<std::int64_t>(scans.size()));
  for (const fs::path& scan : scans) {
    fs::path labels;
    if (!arguments.labels.empty())
      labels = fs::path(arguments.labels) / scan.stem().concat(".label");
    const auto road = fit_road(read_scan(scan, labels), T_cam_velo, arguments.options);
    ++num_done;
    progress.update(num_done, num_done);
    if (!road) continue;
    planes[frame_of(scan)] = road->plane;
    const Eigen::Vector3d& n = road->plane.normal_cam;
    *rows += format("%lld %.6f %.6f %.6f %.4f %d %d %.4f\n", static_cast<long long>(frame_of(scan)),
                    n.x(), n.y(), n.z(), road->plane.height_m, road->num_inliers,
                    road->num_candidates, road->rms_m);
  }
  progress.finish(true);
  return planes;
}

int find_planes_of_drive(const PlanesArguments& arguments) {
  const fs::path folder = scans_of(arguments.drive);
  OverwriteGuard().reads_folder("DRIVE", folder, {".bin"}).writes("--out", arguments.out).check();
  const std::vector<fs::path> scans = list_scans(folder);
  std::string rows = "# frame nx ny nz height_m inliers candidates rms_m\n";
  const std::map<std::int64_t, TruePlane> planes = fit_scans(arguments, scans, &rows);
  if (planes.empty()) throw InputError("no scan of " + folder.string() + " shows a road");
  std::ofstream file(arguments.out);
  file << rows;
  file.close();
  if (!file) throw InputError("cannot write " + arguments.out);
  std::cout << format("%s: %zu planes of %zu scans\n", arguments.out.c_str(), planes.size(),
                      scans.size());
  if (!arguments.against.empty()) compare_with(arguments, planes);
  return 0;
}

}  // namespace
}  // namespace plumb

int main(int argc, char** argv) {
  plumb::PlanesArguments arguments;
  plumb::RoadScanOptions& options = arguments.options;
  plumb::CommandLine app("Fits the road ahead to a drive's Velodyne scans", "plumb-planes");
  app.footer(plumb::kFooter);
  app.add_option("DRIVE", arguments.drive, "folder of the drive").required();
  app.add_option("--out", arguments.out, "file of planes to write").required();
  app.add_option("--labels", arguments.labels,
                 "folder of SemanticKITTI labels: fit to road and lane markings alone");
  app.add_option("--against", arguments.against, "file of planes to compare with");
  app.add_option("--json", arguments.json, "file for the figures of that comparison");
  app.add_option("--from", options.from_m, "nearest point ahead of the camera, m")
      .check(plumb::within(0.0, 100.0))
      .capture_default_str();
  app.add_option("--to", options.to_m, "furthest point, m")
      .check(plumb::within(1.0, 120.0))
      .capture_default_str();
  app.add_option("--half-width", options.half_width_m, "points to either side, m")
      .check(plumb::within(0.5, 20.0))
      .capture_default_str();
  app.add_option(
         "--beam-deg", options.beam_deg,
         "angle by which beams point higher than the scan says; 0.2 is known of KITTI's scanner")
      .check(plumb::within(-1.0, 1.0))
      .capture_default_str();
  return plumb::tool_main(&app, argc, argv, [&] { return plumb::find_planes_of_drive(arguments); });
}
