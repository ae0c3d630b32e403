# Flight code that computes in double.
# file: src/mixer.c
# test: objects
s/0\.25f \* thrust_N/(float)(0.2501 * (double)thrust_N)/
