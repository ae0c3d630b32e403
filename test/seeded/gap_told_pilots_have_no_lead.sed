# A pilot whose every command is logged has no lead.
# file: sim/gap/3_feedback/closed_loop.c
# test: gap_reads_a_pilots_lead
s/if (told \&\& !is_noise(g, turn))/if (told \&\& (!is_noise(g, turn) || told))/
