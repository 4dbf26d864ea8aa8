// A fuzz target for every message that a process takes: its decoder, and the check of its contract.
//
// The first byte says which message the rest is. Its fingerprint is left out, so that inputs
// outlive a change of the message. What a contract accepts must be accepted again when it is
// written anew.
#include <cmath>
#include <vector>

#include "modules/camera/calibration_keeper_wire.hpp"
#include "modules/camera/image_wire.hpp"
#include "modules/detections/detections_wire.hpp"
#include "modules/ground/ground_wire.hpp"
#include "modules/ground/pending_images.hpp"
#include "modules/mount/mount_wire.hpp"
#include "modules/objects/objects_wire.hpp"
#include "modules/vo/vo_wire.hpp"
#include "platform/bounded_decode.hpp"
#include "tests/fuzz/fuzz_input.hpp"
#include "tools/status/status_board.hpp"

namespace plumb {
namespace {

using fuzz::Bytes;
using fuzz::require;

template <typename Message>
fuzz::TightCopy with_fingerprint(Bytes payload) {
  std::vector<std::uint8_t> bytes(8);
  const auto hash = static_cast<std::uint64_t>(Message::getHash());
  for (std::size_t i = 0; i < 8; ++i) bytes[i] = static_cast<std::uint8_t>(hash >> (8U * (7U - i)));
  bytes.insert(bytes.end(), payload.begin(), payload.end());
  return fuzz::TightCopy(bytes);
}

template <typename Message>
bool decode_message(Bytes payload, Message* message) {
  const fuzz::TightCopy copy = with_fingerprint<Message>(payload);
  if (!decode_bounded(copy.bytes(), message)) return false;
  require(message->getEncodedSize() == static_cast<int>(copy.bytes().size()));
  return true;
}

/// A message whose contract turns it into `Output`, and back.
template <typename Message, typename Output>
void try_contract(Bytes payload) {
  Message message;
  Output output;
  if (!decode_message(payload, &message) || from_wire(message, &output) != nullptr) return;
  Message again;
  to_wire(output, &again);
  require(from_wire(again, &output) == nullptr);
}

void try_image(Bytes payload) {
  const fuzz::TightCopy copy = with_fingerprint<image_t>(payload);
  ImageFrame frame;
  if (read_image(copy.bytes(), &frame) != nullptr) return;
  require(frame.data.size() <= copy.bytes().size());
  if (!frame.compressed) {
    require(frame.row_stride_bytes >= frame.width_px);
    require(frame.data.size() == static_cast<std::size_t>(frame.row_stride_bytes) *
                                     static_cast<std::size_t>(frame.height_px));
  }
  static PendingImages pending(64, 48, 2);
  if (!pending.put(frame)) return;
  const ImageFrame* kept = pending.find(frame.seq, frame.capture_us);
  require(kept != nullptr);
  ImageDecoder decoder(64, 48);
  ImageView view;
  (void)decoder.decode(*kept, &view);
}

void try_calibration(Bytes payload) {
  camera_calibration_t message;
  CameraModel camera;
  if (!decode_message(payload, &message)) return;
  CalibrationKeeper keeper;
  const char* refused = from_wire(message, &camera);
  require((keeper.take(message) == nullptr) == (refused == nullptr));
  if (refused == nullptr) require(from_wire(to_wire(camera, 1), &camera) == nullptr);
}

/// Both messages of one image: the motion, whose size is fixed, and behind it the plane.
void try_ground(Bytes payload) {
  const auto ego_bytes = static_cast<std::size_t>(ego_motion_t().getEncodedSize()) - 8;
  if (payload.size() < ego_bytes) return;
  ego_motion_t ego;
  ground_plane_t plane;
  require(decode_message(payload.first(ego_bytes), &ego));
  if (!decode_message(payload.subspan(ego_bytes), &plane)) return;
  GroundOutput output;
  if (from_wire(plane, ego, &output) != nullptr) return;
  to_wire(output, &plane);
  to_wire(output, &ego);
  require(from_wire(plane, ego, &output) == nullptr);
}

void try_speed(Bytes payload) {
  vehicle_speed_t message;
  VehicleSpeed speed;
  if (!decode_message(payload, &message) || from_wire(message, &speed) != nullptr) return;
  require(std::isfinite(speed.speed_m_s) && std::isfinite(speed.scale_std));
  static SpeedTrack track;
  if (track.take(speed) != nullptr) return;
  require(track.reaches(speed.time_us));
  const auto way_m = track.way_m(speed.time_us - 100'000, speed.time_us);
  require(!way_m || std::isfinite(*way_m));
}

void try_health(Bytes payload) {
  process_health_t message;
  if (!decode_message(payload, &message)) return;
  StatusBoard board({"vo"});
  board.take(message, 1);
  (void)board.is_well(1);
  (void)board.text(1);
}

void try_one(fuzz::Orders orders) {
  const std::uint8_t kind = orders.byte() % 8;
  const Bytes payload = orders.rest();
  switch (kind) {
    case 0:
      return try_image(payload);
    case 1:
      return try_calibration(payload);
    case 2:
      return try_contract<vo_motion_t, VoOutput>(payload);
    case 3:
      return try_ground(payload);
    case 4:
      return try_contract<detections_t, DetectionFrame>(payload);
    case 5:
      return try_contract<objects_t, ObjectsOutput>(payload);
    case 6:
      return try_speed(payload);
    default:
      return try_health(payload);
  }
}

}  // namespace
}  // namespace plumb

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer's name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  plumb::try_one(plumb::fuzz::Orders({data, size}));
  return 0;
}
