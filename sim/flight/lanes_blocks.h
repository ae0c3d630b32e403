// lanes_blocks.h - the parts of a flight that are kept in lanes: LANES_BLOCKS(X) with X(name, type, place in
// state_of_eight).
//
// The compiler tells where the numbers of each struct lie (lanes_fields.cpp). Pointers are not copied.
#ifndef SIM_FLIGHT_LANES_BLOCKS_H
#define SIM_FLIGHT_LANES_BLOCKS_H

#include "crazyflie/stand_in.h"
#include "crazyflie/stabilizer_types.h"
#include "crazyflie/stock_units.h"
#include "crazyflie/supervised.h"
#include "firmware/glue.h"
#include "flight/senses.h"
#include "plant/thrust_map.h"

typedef struct {
  float N[PILOT_MOTORS];
} lanes_forces_t;
typedef struct {
  double N[PILOT_MOTORS];
} lanes_motors_t;
typedef struct {
  bool it;
} lanes_flag_t;

// The part of the vehicle that a millisecond changes.
#define LANES_BLOCKS_OF_VEHICLE(X)                                                                           \
  X(supervised, supervised_t, vehicle.supervised)                                                            \
  X(setpoint, setpoint_t, vehicle.setpoint)                                                                  \
  X(sensors, sensorData_t, vehicle.sensors)                                                                  \
  X(state, state_t, vehicle.state)                                                                           \
  X(power, stock_power_t, vehicle.power)                                                                     \
  X(forces, lanes_forces_t, vehicle.control.normalizedForces)                                                \
  X(mode, control_mode_t, vehicle.control.controlMode)                                                       \
  X(q_wb, dq_t, vehicle.q_wb)                                                                                \
  X(ordered, lanes_flag_t, vehicle.ordered)                                                                  \
  X(asked, pilot_setpoint_t, vehicle.asked)                                                                  \
  X(called, lanes_flag_t, vehicle.called)
// The part of the vehicle that it does not change.
#define LANES_BLOCKS_OF_BUILD(X)                                                                             \
  X(supervised_by, supervised_param_t, vehicle.supervised_by)                                                \
  X(stop, lanes_flag_t, vehicle.stop)                                                                        \
  X(firmware, stock_power_param_t, vehicle.firmware)                                                         \
  X(compensates, lanes_flag_t, vehicle.compensates)                                                          \
  X(map, thrust_map_t, vehicle.map)
#define LANES_BLOCKS_OF_SENSES(X)                                                                            \
  X(imu, imu_t, senses.imu)                                                                                  \
  X(seen, ekf_in_t, senses.seen)                                                                             \
  X(ekf, ekf_t, senses.ekf)                                                                                  \
  X(estimate, ekf_out_t, senses.estimate)
// Blocks of which copies keep parts only (app, around, range), and inputs and outputs.
#define LANES_BLOCKS_BETWEEN(X)                                                                              \
  X(app, glue_t, vehicle.app)                                                                                \
  X(around, stand_in_t, vehicle.around)                                                                      \
  X(range, range_t, senses.range)                                                                            \
  X(imu_param, imu_param_t, imu_param)                                                                       \
  X(range_param, range_param_t, range_param)                                                                 \
  X(drawn, senses_drawn_t, drawn[0])                                                                         \
  X(truth, truth_t, truth[0])                                                                                \
  X(in, pilot_in_t, in[0])                                                                                   \
  X(motors, lanes_motors_t, motors)
#define LANES_BLOCKS(X)                                                                                      \
  LANES_BLOCKS_OF_VEHICLE(X)                                                                                 \
  LANES_BLOCKS_OF_BUILD(X) LANES_BLOCKS_OF_SENSES(X) LANES_BLOCKS_BETWEEN(X)

#define LANES_BLOCK_NAME(name, type, where) LANES_##name,
enum { LANES_BLOCKS(LANES_BLOCK_NAME) LANES_BLOCK_COUNT };

#endif
