#include "modules/camera/player_node.hpp"

#include "platform/clock.hpp"

namespace plumb {

PlayerNode::PlayerNode(Process& process, RecordedSource& source, PublishNode& output, double speed)
    : process_(process),
      source_(source),
      output_(output),
      pacer_(speed),
      due_timer_(process.loop().timer([this] { on_due(); })) {
  load_next();
}

void PlayerNode::load_next() {
  if (!source_.read(&frame_)) return process_.loop().stop();
  due_us_ = pacer_.due_us(frame_.capture_us, monotonic_us());
  process_.loop().arm_at(due_timer_, due_us_);
}

void PlayerNode::on_due() {
  Counters& counters = process_.counters();
  if (monotonic_us() - due_us_ > kLate_us) ++counters.num_late;
  ++counters.num_received;
  (void)losses_.take(frame_.seq);
  counters.num_dropped = losses_.num_lost();

  process_.timer().begin();
  output_.publish(frame_);
  output_.show_fault();
  load_next();  // reading ahead finishes the decoding before the frame is due
  process_.timer().mark("read");
  process_.timer().end();
}

}  // namespace plumb
