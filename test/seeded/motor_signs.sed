# Two motors' roll exchanged.
# file: src/mixer.c
# test: mixer
s/{lift - same, lift - other, lift + same, lift + other}/{lift + other, lift + same, lift - other, lift - same}/
