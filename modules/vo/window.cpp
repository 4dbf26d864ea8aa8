#include "modules/vo/window.hpp"

#include <cstring>

namespace plumb::vo {
namespace {

constexpr std::size_t kRowAlignment = 32;
constexpr std::size_t kTailBytes = 64;  // vector loads may read beyond the last pixel

// The last one is returned when none is free, which the preconditions of the callers exclude.
template <std::size_t N>
int first_free(const std::array<bool, N>& used) {
  std::size_t i = 0;
  while (i + 1 < N && used[i]) ++i;
  return static_cast<int>(i);
}

}  // namespace

Window::Window(int width_px, int height_px) {
  const std::size_t stride =
      (static_cast<std::size_t>(width_px) + kRowAlignment - 1) / kRowAlignment * kRowAlignment;
  const std::size_t bytes = stride * static_cast<std::size_t>(height_px) + kTailBytes;
  pixels_.resize(bytes * views_.size());
  for (std::size_t i = 0; i < views_.size(); ++i) {
    views_[i] = {pixels_.data() + i * bytes, width_px, height_px,
                 static_cast<std::ptrdiff_t>(stride)};
  }
}

void Window::clear() {
  used_.fill(false);
  image_used_.fill(false);
  order_.clear();
  num_keyframes_ = 0;
  num_history_ = 0;
}

int Window::add(std::int64_t seq, const Se3& T_cam_world) {
  const int slot = first_free(used_);
  used_[static_cast<std::size_t>(slot)] = true;
  (*this)[slot] = {seq, T_cam_world, -1};
  static_cast<void>(order_.push_back(slot));
  push_history({seq, slot, Se3{}, true});
  return slot;
}

void Window::make_keyframe(int slot, const ImageView& image) {
  const int image_index = first_free(image_used_);
  image_used_[static_cast<std::size_t>(image_index)] = true;
  (*this)[slot].image = image_index;
  ++num_keyframes_;
  const ImageView& view = views_[static_cast<std::size_t>(image_index)];
  std::uint8_t* to = pixels_.data() + (view.data - pixels_.data());
  for (int v = 0; v < view.height_px; ++v) {
    std::memcpy(to + v * view.stride_bytes, image.row(v), static_cast<std::size_t>(view.width_px));
  }
}

void Window::remove(int slot) {
  FixedVector<int, kMaxFrames> rest;
  int successor = -1;  // the next frame in time, or the last one that is left
  bool passed = false;
  bool found_next = false;
  for (const int other : order_) {
    if (other == slot) {
      passed = true;
      continue;
    }
    static_cast<void>(rest.push_back(other));
    if (!found_next) successor = other;
    found_next = passed;
  }
  if (successor >= 0) {
    const Se3 T_slot_successor =
        (*this)[slot].T_cam_world * (*this)[successor].T_cam_world.inverse();
    for (int i = 0; i < num_history_; ++i) {
      PastFrame& past = history_[static_cast<std::size_t>(i)];
      if (past.slot != slot) continue;
      past.T_cam_slot = past.T_cam_slot * T_slot_successor;
      past.slot = successor;
    }
  }
  order_ = rest;
  used_[static_cast<std::size_t>(slot)] = false;
  if ((*this)[slot].is_keyframe()) {
    image_used_[static_cast<std::size_t>((*this)[slot].image)] = false;
    (*this)[slot].image = -1;
    --num_keyframes_;
  }
}

int Window::newest_keyframe() const {
  int found = -1;
  for (const int slot : order_) {
    if ((*this)[slot].is_keyframe()) found = slot;
  }
  return found;
}

int Window::oldest_keyframe() const {
  for (const int slot : order_) {
    if ((*this)[slot].is_keyframe()) return slot;
  }
  return -1;
}

int Window::stale_frame() const {
  for (std::size_t i = 0; i + kNumRecent < order_.size(); ++i) {
    if (!(*this)[order_[i]].is_keyframe()) return order_[i];
  }
  return -1;
}

void Window::remember(std::int64_t seq, const Se3& T_cam_world, bool measured) {
  const int slot = newest();
  push_history({seq, slot, T_cam_world * (*this)[slot].T_cam_world.inverse(), measured});
}

void Window::move_previous(const Se3& T_cam_world) {
  PastFrame& previous = history_[1];
  previous.T_cam_slot = T_cam_world * (*this)[previous.slot].T_cam_world.inverse();
}

void Window::push_history(const PastFrame& past) {
  if (num_history_ < kHistory) ++num_history_;
  for (int i = num_history_ - 1; i > 0; --i) {
    history_[static_cast<std::size_t>(i)] = history_[static_cast<std::size_t>(i - 1)];
  }
  history_[0] = past;
}

std::array<Se3, kMaxFrames> Window::slots_to_cam(const Se3& T_cam_world) const {
  std::array<Se3, kMaxFrames> T_cam_slot;
  for (const int slot : order_) {
    T_cam_slot[static_cast<std::size_t>(slot)] = T_cam_world * (*this)[slot].T_cam_world.inverse();
  }
  return T_cam_slot;
}

}  // namespace plumb::vo
