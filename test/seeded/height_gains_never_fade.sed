# The gains of the own height stay when the estimator's is flown.
# file: src/height.c
# test: height
s/fly->law.quick += share \*/fly->law.quick += 1.0f */
