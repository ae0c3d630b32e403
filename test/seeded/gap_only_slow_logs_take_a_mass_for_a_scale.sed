# Mass and thrust scale are each other's rivals where commands are missed alone.
# file: sim/gap/5_infer/family.c
# test: turning_does_not_tell_them_apart
s/&& !r->turning_told;/\&\& candidates_slow(r->s);/
