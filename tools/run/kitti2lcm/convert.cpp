#include "tools/run/kitti2lcm/convert.hpp"

#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>

#include "core/channels.hpp"
#include "core/input_error.hpp"
#include "core/principal_point.hpp"
#include "modules/camera/image_wire.hpp"
#include "modules/datasets/kitti/png_image.hpp"
#include "modules/datasets/text.hpp"
#include "modules/detections/detections_wire.hpp"
#include "plumb/ground_truth_t.hpp"
#include "plumb/vehicle_speed_t.hpp"
#include "tools/datasets/kitti_tracking/candidate_file.hpp"
#include "tools/datasets/kitti_tracking/kitti_tracking.hpp"
#include "tools/support/camera_log.hpp"
#include "tools/support/progress.hpp"
#include "tools/support/stop_flag.hpp"

namespace plumb {
namespace {

CameraModel with_size(CameraModel camera, const cv::Mat& image) {
  camera.width_px = image.cols;
  camera.height_px = image.rows;
  return camera;
}

class Converter {
 public:
  Converter(const Sequence& sequence, const ConvertOptions& options, const cv::Mat& first_image,
            std::vector<TrackingRow> boxes)
      : options_(options),
        boxes_(std::move(boxes)),
        candidates_(options.candidates.empty() ? std::vector<CandidateRow>{}
                                               : read_candidates(options.candidates)),
        log_(options.out, with_size(sequence.camera, first_image), options.jpeg) {}

  void add(const SequenceFrame& frame, const cv::Mat& image) {
    const CameraModel& camera = log_.camera();
    if (image.cols != camera.width_px || image.rows != camera.height_px) {
      throw InputError(format("%s is %d x %d pixels, the images before it are %d x %d",
                              frame.image.string().c_str(), image.cols, image.rows, camera.width_px,
                              camera.height_px));
    }
    log_.begin_image(frame.capture_us);
    if (frame.T_world_cam || frame.plane) write_truth(frame);
    log_.write_image(frame.seq, {image.data, image.cols, image.rows,
                                 static_cast<std::ptrdiff_t>(image.step[0])});
    if (!options_.detections.empty()) write_detections(frame);
    if (options_.vehicle_speed && frame.T_world_cam) write_vehicle_speed(frame);
  }

  ConvertResult finish() {
    result_.num_frames = log_.num_images();
    result_.duration_s = log_.duration_s();
    result_.log_bytes = log_.close();
    return result_;
  }
  [[nodiscard]] std::int64_t num_frames() const { return log_.num_images(); }
  [[nodiscard]] const CameraModel& camera() const { return log_.camera(); }

 private:
  /// An image without boxes gets an empty message, as from a detector that found nothing.
  void write_detections(const SequenceFrame& frame) {
    DetectionFrame detections = detections_of_frame(boxes_, static_cast<int>(frame.seq));
    detections.capture_us = frame.capture_us;
    attach_candidates(candidates_, &detections);
    result_.num_detections += static_cast<std::int64_t>(detections.detections.size());
    to_wire(detections, &detections_);
    log_.write(kDetections, detections_);
  }

  void write_vehicle_speed(const SequenceFrame& frame) {
    const Eigen::Vector3d t_m = frame.T_world_cam->topRightCorner<3, 1>();
    if (last_pose_us_ != 0) {
      vehicle_speed_t message{};
      message.utime = (frame.capture_us + last_pose_us_) / 2;
      message.speed_m_s =
          (t_m - last_t_m_).norm() / (1e-6 * static_cast<double>(frame.capture_us - last_pose_us_));
      log_.write(kVehicleSpeed, message);
    }
    last_pose_us_ = frame.capture_us;
    last_t_m_ = t_m;
  }

  void write_truth(const SequenceFrame& frame) {
    ground_truth_t truth{};
    truth.utime = frame.capture_us;
    truth.seq = frame.seq;
    truth.q_world_cam[0] = 1.0;
    if (frame.T_world_cam) {
      ++result_.num_poses;
      truth.has_pose = 1;
      const Eigen::Matrix3d R = frame.T_world_cam->topLeftCorner<3, 3>();
      const Eigen::Quaterniond q = Eigen::Quaterniond(R).normalized();
      const double wxyz[] = {q.w(), q.x(), q.y(), q.z()};
      std::copy(std::begin(wxyz), std::end(wxyz), truth.q_world_cam);
      for (int i = 0; i < 3; ++i) truth.t_world_cam_m[i] = (*frame.T_world_cam)(i, 3);
    }
    if (frame.plane) {
      ++result_.num_planes;
      truth.has_plane = 1;
      for (int i = 0; i < 3; ++i) truth.normal_cam[i] = frame.plane->normal_cam[i];
      truth.height_m = frame.plane->height_m;
    }
    log_.write(kGroundTruth, truth);
  }

  const ConvertOptions& options_;
  std::vector<TrackingRow> boxes_;
  std::vector<CandidateRow> candidates_;
  CameraLog log_;
  ConvertResult result_;
  detections_t detections_{};
  std::int64_t last_pose_us_ = 0;
  Eigen::Vector3d last_t_m_ = Eigen::Vector3d::Zero();
};

cv::Mat load_first(const Sequence& sequence) {
  const SequenceFrame& frame = sequence.frames.front();
  cv::Mat image = load_grey_png(frame.image, sequence.colour_allowed);
  const CameraModel& camera = sequence.camera;
  if (camera.width_px != 0 && (camera.width_px != image.cols || camera.height_px != image.rows)) {
    throw InputError(format(
        "%s is %d x %d pixels, the calibration says %d x %d after rectification",
        frame.image.string().c_str(), image.cols, image.rows, camera.width_px, camera.height_px));
  }
  CameraModel checked;
  if (const char* why = from_wire(to_wire(with_size(camera, image), frame.capture_us), &checked))
    throw InputError(why);
  return image;
}

}  // namespace

ConvertResult convert(const Sequence& sequence, const ConvertOptions& options) {
  cv::Mat image = load_first(sequence);
  std::vector<TrackingRow> boxes;
  if (!options.detections.empty()) boxes = read_tracking(options.detections);
  Converter converter(sequence, options, image, std::move(boxes));
  const auto total = static_cast<std::int64_t>(sequence.frames.size());
  Progress progress("converting", "frames", total);
  try {
    for (const SequenceFrame& frame : sequence.frames) {
      if (stop_requested()) break;
      if (converter.num_frames() > 0) image = load_grey_png(frame.image, sequence.colour_allowed);
      converter.add(frame, image);
      progress.update(converter.num_frames(), converter.num_frames());
    }
  } catch (const InputError& error) {
    progress.finish(false);
    const ConvertResult result = converter.finish();
    throw InputError(format("%s; %s holds the %lld frames before it", error.what(),
                            options.out.string().c_str(),
                            static_cast<long long>(result.num_frames)));
  }
  ConvertResult result = converter.finish();
  if (!is_principal_point_central(converter.camera())) result.concern = kPrincipalPointIsOff;
  result.stopped = result.num_frames < total;
  progress.finish(!result.stopped);
  return result;
}

}  // namespace plumb
