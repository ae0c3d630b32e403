# Weights fly without a commit.
# file: src/firmware/settings.c
# test: app_
s/put_weights(&GLUE\.candidate, weights_from);/(void)weights_from;/
