# Weights that are far out give a ratio below 1, and the thrust steps.
# file: src/curve.c
# test: faults_of_the_list
s/f_max(at\.ratio, 1\.0f)/f_max(at.ratio, 0.8f)/
