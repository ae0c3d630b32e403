# The delay of commands is left out of the filter's motors.
# file: src/height.c
# test: height_motors
s/(HEIGHT_COMMAND_S + delay_s)/(HEIGHT_COMMAND_S + 0.0f * delay_s)/
