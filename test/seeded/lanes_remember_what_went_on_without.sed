# Of a flight that comes back to its lane what the lane was meanwhile is remembered, and hides a change.
# file: sim/flight/woven.c
# test: woven_tells_of_a_flight_that_is_back
/weave_put(&w->looked, lanes_looked/d
