# A recorded packet is flown a tick late.
# file: sim/drone/flown_anew.c
# test: test_flown_anew
s/while (drone_now_ms(d) < ms)/while (drone_now_ms(d) <= ms)/
