# Which of several logs has the moment is not told.
# file: sim/gap/8_report/unnamed.c
# test: gap_advises_to_fly_where
s/report_log_name(r, c->log)/r ? "" : NULL/
