// Prints time and speed of every motion: live, or from the log that is named.
//   speed                       live, on this machine
//   speed 'file://LOG?speed=0'  from a log, as fast as possible
#include <cstdio>
#include <lcm/lcm-cpp.hpp>

#include "plumb/ego_motion_t.hpp"

void print(const lcm::ReceiveBuffer*, const std::string&, const plumb::ego_motion_t* motion, int) {
  if (motion->status != motion->STATUS_OK && motion->status != motion->STATUS_STANDSTILL) return;
  std::printf("%.3f s: %.2f +- %.2f m/s\n", 1e-6 * static_cast<double>(motion->utime),
              motion->velocity_ground_m_s[0], motion->speed_std_m_s);
  std::fflush(stdout);
}

int main(int argc, char** argv) {
  lcm::LCM lcm(argc > 1 ? argv[1] : "udpm://239.255.76.67:7667?ttl=0");
  lcm.subscribeFunction("EGO_MOTION", print, 0);
  while (lcm.good() && lcm.handle() == 0) {
  }
}
