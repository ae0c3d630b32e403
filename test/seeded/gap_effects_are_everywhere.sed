# Nine effects in ten are there.
# file: sim/gap/5_infer/evidence.c
# test: gap_evidence_finds
s/^#define RARE 0\.01/#define RARE 0.9/
