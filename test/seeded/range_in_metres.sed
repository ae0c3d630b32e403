# The firmware's header says metres; the range is in millimetres.
# file: src/firmware/range_up.c
# test: app_
s/0\.001f \* value_mm/value_mm/g
