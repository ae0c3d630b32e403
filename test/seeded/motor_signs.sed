# Two motors' roll exchanged.
# file: src/mixer.c
# test: mixer
s/ROLL\[MOTORS\] = {-1\.0f, -1\.0f, 1\.0f, 1\.0f}/ROLL[MOTORS] = {1.0f, 1.0f, -1.0f, -1.0f}/
