# The stock controller takes over with the heading that it last had.
# file: src/firmware/controller.c
# test: app_
s/if (!flew) start_stock(control, sensors, state);/(void)flew, (void)start_stock;/
