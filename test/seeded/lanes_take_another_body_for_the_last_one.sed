# A body at the address of one that was there before is taken for that one.
# file: sim/body/side_by_side.c
# test: side_by_side
/abreast_forget_one/d
