/* A receiver of Plumbline's CAN messages in C99: E2E check, age, one value. docs/can.md shows it. */
#include <stdbool.h>
#include <stdint.h>

typedef struct {
  uint16_t data_id;    /* attribute E2EDataID of the message in the DBC */
  uint32_t timeout_ms; /* for example five cycles */
  uint8_t max_gap;     /* largest step of the alive counter that is accepted */
  bool has_counter;
  uint8_t counter;
  uint32_t received_ms;
} Receiver;

typedef enum { FRAME_OK, FRAME_WRONG_CRC, FRAME_REPEATED, FRAMES_LOST } FrameCheck;

static inline uint8_t crc8_step(uint8_t crc, uint8_t byte) {
  crc ^= byte;
  for (int bit = 0; bit < 8; ++bit) {
    crc = (uint8_t)((crc & 0x80) != 0 ? (crc << 1) ^ 0x1D : crc << 1);
  }
  return crc;
}

/* AUTOSAR E2E profile 11A. The values of a frame may be used after FRAME_OK only. */
static inline FrameCheck receive(Receiver* r, const uint8_t data[8], uint32_t now_ms) {
  uint8_t crc = crc8_step(0, (uint8_t)(r->data_id & 0xFF));
  crc = crc8_step(crc, (uint8_t)(r->data_id >> 8));
  for (int i = 1; i < 8; ++i) crc = crc8_step(crc, data[i]);
  const uint8_t counter = data[1] & 0x0F;
  if (crc != data[0] || counter > 14) return FRAME_WRONG_CRC;

  const uint8_t step = (uint8_t)((counter + 15 - r->counter) % 15);
  const bool had_counter = r->has_counter;
  if (had_counter && step == 0) return FRAME_REPEATED; /* a stuck sender: its age must grow */
  r->has_counter = true;
  r->counter = counter;
  r->received_ms = now_ms;
  return had_counter && step > r->max_gap ? FRAMES_LOST : FRAME_OK;
}

static inline bool is_stale(const Receiver* r, uint32_t now_ms) {
  return !r->has_counter || now_ms - r->received_ms > r->timeout_ms;
}

/* EgoMotion_Speed of PLB_EgoMotion: 24|16@1+ (0.005,-100). False: not available. */
static inline bool ego_speed(const uint8_t data[8], double* speed_m_s) {
  const uint16_t raw = (uint16_t)(data[3] | data[4] << 8);
  if (raw == 0xFFFF) return false; /* all ones */
  *speed_m_s = raw * 0.005 - 100.0;
  return true;
}

/* EgoMotion_Validity: 0 invalid, 1 degraded, 2 valid, 3 not available. */
static inline unsigned ego_validity(const uint8_t data[8]) { return data[1] >> 4 & 3; }

/* Frame_Age of PLB_Frame: 24|12@1+ (0.001,0), at transmission. False: not available. */
static inline bool frame_age(const uint8_t data[8], double* age_s) {
  const uint16_t raw = (uint16_t)(data[3] | (data[4] & 0x0F) << 8);
  if (raw == 0xFFF) return false;
  *age_s = raw * 0.001;
  return true;
}
