# A climb out of the ground effect taken for one into it.
# file: src/outer.c
# test: outer_
s/w\.acc_mps2\.z += f->ground/w.acc_mps2.z -= f->ground/
