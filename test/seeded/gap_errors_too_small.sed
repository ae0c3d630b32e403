# Standard errors are half of what they are.
# file: sim/gap/5_infer/score_estimate.c
# test: gap_score_estimates
s/V\[i \* n + k\] += part\[i\] \* part\[k\];/V[i * n + k] += 0.25 * part[i] * part[k];/
