# A name is told as strong that held-out flights speak against.
# file: sim/gap/8_report/finding.c
# test: gap_tells_no_name_as_strong
s/report_contradicted(r) ||/false ||/
