/* Compiles the guide's receiver as C. */
#include "receiver.h"
#include "sums.h"

bool receiver_is_fresh(const Receiver* r, uint32_t now_ms) { return !is_stale(r, now_ms); }
