# What an inertia leaves of the turning shakes nominal flights, which find as much where there is none.
# file: sim/gap/diagnose.c
# test: users_logs_are_given_the_inertia
s/TRY(both_ways_take(.*/\/\/ no scale/
