# Left and right of the sideways range sensors are exchanged.
# file: sim/drone/beside.c
# test: test_beside
s/axes.y.y, -axes.y.y}/-axes.y.y, axes.y.y}/
