# Of what the file has nothing can go.
# file: sim/gap/5_infer/evidence.c
# test: gap_evidence_finds
s/positive\[n++\] = c->least\[k\] >= 0\.0;/positive[n++] = c->use.fx->size[k].sign > 0;/
