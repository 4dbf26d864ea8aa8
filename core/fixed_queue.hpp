/// First in, first out; up to N values in place. A full queue lets the oldest go.
#pragma once

#include <array>
#include <cstddef>

namespace plumb {

template <typename T, std::size_t N>
class FixedQueue {
 public:
  /// False when the oldest value had to make room.
  [[nodiscard]] bool push(const T& value) {
    const bool fits = size_ < N;
    if (!fits) drop_front();
    items_[(first_ + size_) % N] = value;
    ++size_;
    return fits;
  }
  /// @pre not empty, for the three below
  void drop_front() {
    first_ = (first_ + 1) % N;
    --size_;
  }
  [[nodiscard]] const T& front() const { return items_[first_]; }
  [[nodiscard]] T& back() { return items_[(first_ + size_ - 1) % N]; }
  [[nodiscard]] bool empty() const { return size_ == 0; }
  [[nodiscard]] bool full() const { return size_ == N; }
  void clear() { size_ = 0; }

 private:
  std::array<T, N> items_{};
  std::size_t first_ = 0;
  std::size_t size_ = 0;
};

}  // namespace plumb
