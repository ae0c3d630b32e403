# A name that feedback made stays.
# file: sim/gap/5_infer/confirm.h
# test: users_logs_are_not_given
s/return a->answer == CONFIRM_NO && a->apart;/return a->answer == CONFIRM_NO \&\& a->apart \&\& a->p_apart < 0.0;/
