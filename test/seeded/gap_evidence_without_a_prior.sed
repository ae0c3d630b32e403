# A set's evidence is not charged for the room of its prior.
# file: sim/gap/5_infer/information.c
# test: gap_evidence_is
s/ - log(Q\[i \* (n + 1)\]) + 0\.5 \* log(p\[i\]);/;/
