# A line that lost its end takes the next one with it.
# file: sim/flight/summary_file.c
# test: summary_refuses_a_line
s/cJSON_ParseWithOpts(line, NULL, true)/cJSON_ParseWithOpts(line, NULL, false)/
