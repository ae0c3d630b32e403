# Which of several logs has the moment is not told.
# file: sim/gap/8_report/unnamed.c
# test: gap_advises_to_fly_where
s/folder_file(c->log)/""/
