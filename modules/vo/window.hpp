/// The frames that refinement may move: keyframes with their images, and the last few frames.
///
/// A frame sits in one slot for as long as it stays. The history keeps every recent frame's pose relative to some
/// frame of the window, so poses handed out follow later refinements.
///
/// Frames   world: cam of the first frame.  Lengths in [vo].
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
inline constexpr int kNumRecent = 3;
inline constexpr int kHistory = 12;

struct Frame {
  std::int64_t seq = 0;
  Se3 T_cam_world;
  int image = -1;  ///< store index of a keyframe's image, -1 for other frames
  [[nodiscard]] bool is_keyframe() const { return image >= 0; }
};

class Window {
 public:
  Window(int width_px, int height_px);

  void clear();
  /// Adds the newest frame and returns its slot.
  /// @pre a slot is free (Keyframes::trim_recent() frees one per frame)
  int add(std::int64_t seq, const Se3& T_cam_world);
  /// Stores `image` with the frame, which makes it a host. @pre num_keyframes() <= kMaxKeyframes
  void make_keyframe(int slot, const ImageView& image);
  void remove(int slot);

  /// Slots, oldest frame first.
  [[nodiscard]] const FixedVector<int, kMaxFrames>& order() const { return order_; }
  [[nodiscard]] Frame& operator[](int slot) { return frames_[static_cast<std::size_t>(slot)]; }
  [[nodiscard]] const Frame& operator[](int slot) const {
    return frames_[static_cast<std::size_t>(slot)];
  }
  [[nodiscard]] const ImageView& image(int slot) const {
    return views_[static_cast<std::size_t>((*this)[slot].image)];
  }
  [[nodiscard]] int num_keyframes() const { return num_keyframes_; }
  [[nodiscard]] int newest() const { return order_[order_.size() - 1]; }
  /// Newest keyframe's slot, -1 without one.
  [[nodiscard]] int newest_keyframe() const;
  [[nodiscard]] int oldest_keyframe() const;
  /// Oldest frame that is neither a keyframe nor one of the last kNumRecent, -1 without one.
  [[nodiscard]] int stale_frame() const;

  /// A frame that was handed out, whether or not it has a slot.
  struct Past {
    std::int64_t seq = 0;
    int slot = -1;     ///< frame it hangs on
    Se3 T_cam_slot;    ///< identity when it is that frame
    bool seen = true;  ///< its pose was measured, not predicted
  };
  /// Newest first.
  [[nodiscard]] const std::array<Past, kHistory>& history() const { return history_; }
  [[nodiscard]] int num_history() const { return num_history_; }
  [[nodiscard]] Se3 past_pose(const Past& past) const {
    return past.T_cam_slot * (*this)[past.slot].T_cam_world;
  }
  /// Remembers a frame that gets no slot of its own: it hangs on the newest one.
  void remember(std::int64_t seq, const Se3& T_cam_world, bool seen);

 private:
  void push_history(const Past& past);

  std::array<Frame, kMaxFrames> frames_{};
  std::array<bool, kMaxFrames> used_{};
  FixedVector<int, kMaxFrames> order_;
  int num_keyframes_ = 0;
  std::array<Past, kHistory> history_{};
  int num_history_ = 0;
  std::vector<std::uint8_t> pixels_;
  std::array<ImageView, kMaxKeyframes + 1> views_{};
  std::array<bool, kMaxKeyframes + 1> image_used_{};
};

}  // namespace plumb::vo
