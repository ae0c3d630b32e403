# Weights are taken while they are learned.
# file: src/firmware/settings.c
# test: app_
s/if (settings_learning() || /if (/
