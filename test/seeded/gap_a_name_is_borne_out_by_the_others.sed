# A name is told as strong where held-out flights are explained better by the other names alone.
# file: sim/gap/8_report/finding.c
# test: gap_tells_no_name_as_strong
s/held_share > 0.5;/held_share > -1e9;/
