#include "modules/can/can_source.hpp"

#include "modules/can/can_time.hpp"

namespace plumb {

bool CanSourceGuard::take(std::int64_t session, std::int64_t now_us) {
  const bool is_own = !has_session_ || session == session_;
  if (!is_own) {
    num_challenges_ = session == challenger_ ? num_challenges_ + 1 : 1;
    challenger_ = session;
    const bool is_silent = age_us(now_us, heard_us_) > silent_us_;
    if (!is_silent && num_challenges_ <= kMaxRefused) {
      ++num_refused_;
      return false;
    }
  }
  has_session_ = true;
  session_ = session;
  heard_us_ = now_us;
  num_challenges_ = 0;
  return true;
}

}  // namespace plumb
