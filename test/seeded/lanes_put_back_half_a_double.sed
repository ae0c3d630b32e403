# A double in what lanes put back by words of 32 bits, of which a double has two.
# file: sim/crazyflie/stabilizer_types.h
# test: compiler
s/^typedef struct setpoint_s {$/&\n  double sent_s;/
