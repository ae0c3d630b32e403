// pil.h - processor in the loop: one call of the app as a record of words, and all that it logs as the
// answer.
//
// The same source runs on the host and on the emulated Cortex-M4F: what goes in is what the firmware would
// pass to controllerOutOfTree(), what comes out are the commands and every log of the app, bit by bit.
#ifndef PIL_H
#define PIL_H

#include "stabilizer_types.h"
#include <stdint.h>

enum {
  PIL_START = 1,
  PIL_FLYING = 2,
  PIL_ALLOWED = 4,
  PIL_CAN_FLY = 8
}; // PIL_START: the controller is selected before this call
enum { PIL_NO_PARAM = -1, PIL_COMMIT = -2 };

// Only words of 32 bits: enumerations have another size on the target.
typedef struct {
  uint32_t step, flags, range_mm, down_mm, in_body;
  int32_t param; // row of params_table that is written before the call, PIL_COMMIT, or PIL_NO_PARAM
  float value;
  float battery_V;
  uint32_t duty[4]; // of the motors in the last millisecond
  float applied[4]; // with PIL_START: the commands before, over THRUST_MAX
  float acc[3], gyro[3], pos[3], vel[3], q[4], att[3];
  uint32_t mode[7];
  float sp_att[3], sp_rate[3], sp_q[4], sp_thrust, sp_pos[3], sp_vel[3], sp_acc[3];
} pil_in_t;

#define PIL_WORDS 128 // forces, then the app's logs, groups by name; the rest 0

typedef struct {
  uint32_t word[PIL_WORDS];
} pil_out_t;

void pil_pack(pil_in_t *in, const setpoint_t *setpoint, const sensorData_t *sensors, const state_t *state,
              uint32_t step);

void pil_unpack(const pil_in_t *in, setpoint_t *setpoint, sensorData_t *sensors, state_t *state);

// The parts of a call, on the app's one state: start and parameters; the call; reading the logs.
void pil_before(const pil_in_t *in);
void pil_call(void);
void pil_after(pil_out_t *out);

// How many words of an answer are used, and how many of them are floats.
int pil_words(void);
int pil_floats(void);

#endif
