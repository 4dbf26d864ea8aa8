/// What plumb-replay's tables say of the images of a drive, as figures to draw onto them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tools/run/draw/overlay.hpp"
#include "tools/support/csv_table.hpp"

namespace plumb {

class DriveFigures {
 public:
  /// Takes the table of frames. Throws InputError with file, line and column.
  explicit DriveFigures(const CsvTable& frames);
  /// Add what plumb-replay --objects and --features wrote, to the frames that the table of frames
  /// names. Throw InputError as above.
  void add_objects(const CsvTable& objects);
  void add_features(const CsvTable& features);

  [[nodiscard]] std::size_t size() const { return frames_.size(); }
  [[nodiscard]] std::int64_t seq(std::size_t index) const { return frames_[index].seq; }
  /// Index of the first frame with this sequence number.
  [[nodiscard]] std::optional<std::size_t> find(std::int64_t seq) const;
  /// Figures of a frame, with the path up to it.
  [[nodiscard]] FrameFigures frame(std::size_t index) const;

 private:
  struct Frame {
    std::int64_t seq = 0;
    FrameFigures figures;  ///< without the path
    std::size_t num_path_points = 0;
  };
  FrameFigures* figures_of(const CsvTable& table, std::size_t row);

  std::vector<Frame> frames_;
  std::map<std::int64_t, std::size_t> places_;
  std::vector<Eigen::Vector2d> path_m_;  ///< of the whole drive
};

/// "car 20 m", for an object at this place.
[[nodiscard]] std::string object_label(const std::string& class_name,
                                       const Eigen::Vector2d& place_m);

}  // namespace plumb
