# Noise of the rates kicks, too.
# file: sim/gap/3_feedback/nominal_pilot.c
# test: is_told_its_heading
s/: 0.0), error_radps);/: 0.0), 0.0 * error_radps);/
