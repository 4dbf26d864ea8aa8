/* Differences of the integrated pose in a receiver of Plumbline's CAN messages, in C99. */
#include <stdbool.h>
#include <stdint.h>

typedef struct {
  bool has_counters;
  uint8_t reset; /* OdomDist_ResetCtr, byte 6 of PLB_OdometryDistance */
  uint8_t start; /* Frame_StartCtr, byte 7 of PLB_Frame */
} Continuity;

/* False: position, heading and distance began anew, so that differences to earlier ones mean
   nothing. */
static inline bool continues(Continuity* c, uint8_t reset, uint8_t start) {
  const bool is_same = c->has_counters && c->reset == reset && c->start == start;
  c->has_counters = true;
  c->reset = reset;
  c->start = start;
  return is_same;
}

/* Difference of two positions or distances that travel modulo 80000, 3200 or 1000000 m. */
static inline double travelled(double now_m, double before_m, double modulus_m) {
  double m = now_m - before_m;
  if (m >= 0.5 * modulus_m) m -= modulus_m;
  if (m < -0.5 * modulus_m) m += modulus_m;
  return m;
}
