// lanes_ms.cpp - milliseconds of eight flights. Compiled twice: for AVX2 and for AVX-512.
#include "flight/lanes_ms.h"
#ifdef __AVX2__
#include "base/lane_c.hpp"
#include "flight/lanes_eight.hpp"

namespace lanes {

constinit thread_local stand_in_t *stand_in = nullptr;

// Calls that are so rare that each flight makes them alone: all leave the lanes.
void stand_in_print(const char *, ...) {
  lanes_in = 0;
}
void controllerPid(control_t *, const setpoint_t *, const sensorData_t *, const state_t *,
                   const stabilizerStep_t) {
  lanes_in = 0;
}
status_t params_check(const flight_param_t *) {
  lanes_in = 0;
  return ST_OK;
}
void params_default(flight_param_t *) {
  lanes_in = 0;
}
float params_get(const flight_param_t *, const param_row_t *) {
  lanes_in = 0;
  return 0.0f;
}
status_t params_set(flight_param_t *, const param_row_t *, float) {
  lanes_in = 0;
  return ST_OK;
}
const param_row_t params_table[] = {{}};
const int params_count = 0;

static plain_unsigned senses(plain_unsigned in, void *of) {
  state_of_eight *const now = static_cast<state_of_eight *>(of);
  lanes_in = in;
  senses_take(&now->senses, &now->imu_param, &now->range_param, now->drawn, now->truth, now->in);
  return lanes_in;
}

static plain_unsigned vehicle(plain_unsigned in, void *of, const void *told) {
  state_of_eight *const now = static_cast<state_of_eight *>(of);
  // In other modes control_t holds something else in the place of the forces, which is in no lane.
  lanes_in = in & (now->vehicle.control.controlMode == controlModeForce || !now->vehicle.called).bits();
  if (!lanes_in) return 0;
  crazyflie_ms(&now->vehicle, static_cast<const pilot_in_t *>(told), now->motors.N);
  return lanes_in;
}

} // namespace lanes

#define MS                                                                                                   \
  { lanes::leave<lanes::senses>, lanes::leave<lanes::vehicle> }
#else // never called: lane_possible() is false
#define MS                                                                                                   \
  {}
#endif

#ifdef LANES_512
const lanes_ms_t lanes_ms_512 = MS;
#else
const lanes_ms_t lanes_ms_256 = MS;
#endif
