# Stock INDI, fault 6: the accelerometer's bias shifts the height.
# file: src/outer.c
# test: bias
s/x->acc_w_mps2 = v3_sub(x->acc_w_mps2, f->bias\.bias_mps2);//
