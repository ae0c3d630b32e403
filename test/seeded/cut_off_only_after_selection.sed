# Stock INDI, fault 8: a cut-off acts only after the controller was selected again.
# file: src/outer.c
# test: flight_
/^status_t outer_take/,/^}/ s/TRY(sync_tune.*;$//
