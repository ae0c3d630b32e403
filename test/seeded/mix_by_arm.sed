# Rotors on an axis turn the body about the other one by nothing.
# file: sim/vehicle/model.c
# test: model_mix
s/roll \* f->rotor_y_m\[k\]/roll * f->rotor_y_m[0]/
