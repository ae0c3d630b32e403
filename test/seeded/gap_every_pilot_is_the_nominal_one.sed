# Of what control commands, nominal flights' numbers are the log's.
# file: sim/gap/5_infer/information.c
# test: gap_information_takes_of_another_pilot
s/if (fx->control_makes) p->wide/if (!fx) p->wide/
