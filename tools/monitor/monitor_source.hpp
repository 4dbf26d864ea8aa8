/// Where the web server gets what it sends: from the bus, or from a log. The server calls these
/// functions in its own thread.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "tools/monitor/packet.hpp"

namespace plumb {

/// How far one page has been told.
struct NewsCursor {
  std::int64_t event = 0;
  std::int64_t row = 0;
  bool told_end = false;  ///< that a log has been read to its end
};

class MonitorSource {
 public:
  virtual ~MonitorSource() = default;
  /// The first message to a page, as JSON: mode, names, the table of CAN signals.
  [[nodiscard]] virtual std::string hello() = 0;
  /// Events, and rows of a log, that the page has not been told; null when there are none.
  [[nodiscard]] virtual std::shared_ptr<const Packet> news(NewsCursor* cursor) = 0;
  /// The frame `index` of a log; null for one that is not there, and while it watches a bus.
  [[nodiscard]] virtual std::shared_ptr<const Packet> frame(std::int64_t index) = 0;
  /// A page has drawn the packet `id`.
  virtual void acknowledge(std::int64_t id) = 0;
};

}  // namespace plumb
