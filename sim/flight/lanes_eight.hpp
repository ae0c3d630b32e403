// lanes_eight.hpp - the state of eight flights in lanes; include it after base/lane_c.hpp. Its layout is the
// same for registers of either width (flight/lanes_ms.cpp).
#ifndef SIM_FLIGHT_LANES_EIGHT_HPP
#define SIM_FLIGHT_LANES_EIGHT_HPP

namespace lanes {

#include "crazyflie/crazyflie.h"
#include "flight/lanes_blocks.h"

// All that a millisecond changes, and its inputs, which are others in each, because earlier ones are kept
// where they are (lanes_state.cpp).
struct state_of_eight {
  crazyflie_t vehicle;
  senses_t senses;
  imu_param_t imu_param;
  range_param_t range_param;
  lanes_motors_t motors;
  senses_drawn_t *drawn;
  truth_t *truth;
  pilot_in_t *in;
};

} // namespace lanes

#endif
