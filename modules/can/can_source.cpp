#include "modules/can/can_source.hpp"

#include "modules/can/can_time.hpp"

namespace plumb {

bool CanSourceGuard::take(std::int64_t session, std::int64_t now_us) {
  if (age_us(now_us, heard_us_) > silent_us_) sender_.forget();
  if (sender_.take(session) == OneSender::Verdict::kForeign) {
    ++num_refused_;
    return false;
  }
  heard_us_ = now_us;
  return true;
}

}  // namespace plumb
