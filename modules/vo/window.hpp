/// The sliding window of frames that refinement may move: keyframes with their images, and the last
/// few frames.
///
/// A frame has a slot for as long as it is in the window. The history has every recent frame, in
/// the window or not, with its pose relative to a frame of the window. Poses that were published
/// therefore follow later refinements.
///
/// Frames:
///   world: cam of the first image.  T_a_b maps coordinates in b to coordinates in a.
/// Units:
///   Lengths in [vo].
/// Memory:
///   The images of kMaxKeyframes + 1 keyframes, allocated by the constructor; the rest in place.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "core/fixed_vector.hpp"
#include "core/image_view.hpp"
#include "core/se3.hpp"
#include "modules/vo/track.hpp"

namespace plumb::vo {

inline constexpr int kMaxKeyframes = 8;
inline constexpr int kNumRecent = 3;  ///< number of newest frames that stay without being keyframes
inline constexpr int kHistory = 12;

struct Frame {
  std::int64_t seq = 0;
  Se3 T_cam_world;
  int image = -1;  ///< index of a keyframe's image, -1 for other frames
  [[nodiscard]] bool is_keyframe() const { return image >= 0; }
};

/// A recent frame, whether or not it still has a slot.
struct PastFrame {
  std::int64_t seq = 0;
  int slot = -1;         ///< frame of the window to which its pose is relative
  Se3 T_cam_slot;        ///< from cam of that frame; the identity when it is that frame
  bool measured = true;  ///< false when its pose was predicted
};

class Window {
 public:
  Window(int width_px, int height_px);

  /// Removes all frames and the history.
  void clear();
  /// Adds a frame as the newest one and returns its slot.
  /// @pre a slot is free; Keyframes::trim_recent() and promote() see to that
  int add(std::int64_t seq, const Se3& T_cam_world);
  /// Copies `image`, which makes the frame a keyframe. @pre num_keyframes() <= kMaxKeyframes
  void make_keyframe(int slot, const ImageView& image);
  /// Removes a frame. The history that is relative to it becomes relative to the next frame in
  /// time.
  void remove(int slot);

  /// Returns the slots in order of time, the oldest frame first.
  [[nodiscard]] const FixedVector<int, kMaxFrames>& order() const { return order_; }
  [[nodiscard]] Frame& operator[](int slot) { return frames_[static_cast<std::size_t>(slot)]; }
  [[nodiscard]] const Frame& operator[](int slot) const {
    return frames_[static_cast<std::size_t>(slot)];
  }
  /// Returns the image of a keyframe.
  [[nodiscard]] const ImageView& image(int slot) const {
    return views_[static_cast<std::size_t>((*this)[slot].image)];
  }
  [[nodiscard]] int num_keyframes() const { return num_keyframes_; }
  /// Returns the slot of the newest frame. @pre the window is not empty
  [[nodiscard]] int newest() const { return order_[order_.size() - 1]; }
  /// Returns the slot of the newest or the oldest keyframe, -1 when there is none.
  [[nodiscard]] int newest_keyframe() const;
  [[nodiscard]] int oldest_keyframe() const;
  /// Returns the slot of the oldest frame that is neither a keyframe nor one of the last kNumRecent
  /// frames, -1 when there is none.
  [[nodiscard]] int stale_frame() const;

  /// Returns the recent frames, the newest one first. The first num_history() are valid.
  [[nodiscard]] const std::array<PastFrame, kHistory>& history() const { return history_; }
  [[nodiscard]] int num_history() const { return num_history_; }
  /// Returns the pose T_cam_world of a frame of the history, as it is refined now.
  [[nodiscard]] Se3 past_pose(const PastFrame& past) const {
    return past.T_cam_slot * (*this)[past.slot].T_cam_world;
  }
  /// Returns, by slot, what maps coordinates in each frame to those in a camera at T_cam_world.
  /// Only the slots of order() are set.
  [[nodiscard]] std::array<Se3, kMaxFrames> slots_to_cam(const Se3& T_cam_world) const;
  /// Adds a frame to the history that gets no slot. Its pose is kept relative to the newest frame.
  void remember(std::int64_t seq, const Se3& T_cam_world, bool measured);
  /// Gives the frame before the newest one another pose. @pre num_history() > 1
  void move_previous(const Se3& T_cam_world);

 private:
  void push_history(const PastFrame& past);

  std::array<Frame, kMaxFrames> frames_{};  // by slot
  std::array<bool, kMaxFrames> used_{};
  FixedVector<int, kMaxFrames> order_;
  int num_keyframes_ = 0;
  std::array<PastFrame, kHistory> history_{};
  int num_history_ = 0;
  std::vector<std::uint8_t> pixels_;                  // of all images
  std::array<ImageView, kMaxKeyframes + 1> views_{};  // into pixels_, by Frame::image
  std::array<bool, kMaxKeyframes + 1> image_used_{};
};

}  // namespace plumb::vo
