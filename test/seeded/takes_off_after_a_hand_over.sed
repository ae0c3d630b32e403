# The supervisor's empty set point lets a hand-over go.
# file: src/firmware/controller.c
# test: a_vehicle_that_handed_over
s/return (could_fly \&\& GLUE.could_fly) || .*/return true || could_fly;/
