# Of an effect in many forms the one that fits speaks alone, with its part of the prior.
# file: sim/gap/5_infer/evidence.c
# test: gap_evidence_speaks_for
s/return best + log(sum);/return best + 0.0 * log(sum);/
