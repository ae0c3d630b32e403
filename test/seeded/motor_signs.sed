# Roll turns the other way.
# file: src/mixer.c
# test: mixer
s/const float roll = f_bound(torque/const float roll = f_bound(-torque/
