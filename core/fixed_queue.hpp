/// A first-in-first-out queue of up to N values. A full queue drops its oldest value.
///
/// Memory:
///   The values are stored in place; nothing is allocated.
#pragma once

#include <array>
#include <cstddef>

namespace plumb {

template <typename T, std::size_t N>
class FixedQueue {
 public:
  /// Appends `value`. Returns false when the queue was full and dropped its oldest value.
  [[nodiscard]] bool push(const T& value) {
    const bool fits = size_ < N;
    if (!fits) drop_front();
    items_[(first_ + size_) % N] = value;
    ++size_;
    return fits;
  }
  /// @pre not empty; the same holds for front() and back()
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
