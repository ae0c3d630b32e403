# A kick about z takes all that the motors have.
# file: sim/gap/3_feedback/nominal_pilot.c
# test: is_told_its_heading
s/return f->w->kicks ? larger(-most_radps2/return f->w->kicks \&\& false ? larger(-most_radps2/
