# Stock INDI, fault 1: a yaw rate turns the nose to heading 0.
# file: src/flight.c
# test: flight_
s/if (sp->yaw == YAW_ANGLE) {/if (true) {/
