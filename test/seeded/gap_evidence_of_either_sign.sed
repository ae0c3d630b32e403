# A prior that has a sign counts as one that has none.
# file: sim/gap/5_infer/information.c
# test: gap_evidence_is
s/if (!positive\[i\]) continue;/if (!positive[i] || n) continue;/
