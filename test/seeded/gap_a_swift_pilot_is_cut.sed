# A pilot whose gains are those of the log's commands is cut to what does not ring, and answers disturbances less.
# file: sim/gap/3_feedback/closed_loop.c
# test: gap_believes_gains_that_explain
s/if (!w->unread && explains(&roll, /if (false \&\& explains(\&roll, /
