#include "modules/vo/track.hpp"

namespace plumb::vo {

TrackTable::TrackTable(int capacity) : tracks_(static_cast<std::size_t>(capacity)) {
  active_.reserve(tracks_.size());
  passive_.reserve(tracks_.size());
  free_.reserve(tracks_.size());
  clear();
}

int TrackTable::add() {
  if (free_.empty()) return -1;
  const int index = free_.back();
  free_.pop_back();
  active_.push_back(index);
  (*this)[index] = Track{};
  return index;
}

void TrackTable::clear() {
  active_.clear();
  passive_.clear();
  free_.clear();
  for (auto i = static_cast<int>(tracks_.size()); i > 0; --i) free_.push_back(i - 1);
}

}  // namespace plumb::vo
