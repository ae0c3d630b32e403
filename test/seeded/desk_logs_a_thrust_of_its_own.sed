# stabilizer.thrust is the stock controller's, whoever flies.
# file: sim/crazyflie/firmware_logs.c
# test: test_drone
s/l->stabilizer_thrust = c->thrust;/l->stabilizer_thrust = l->controller_cmd_thrust;/
