# While both fly, the stock controller finds our forces where it left its own command.
# file: src/firmware/controller.c
# test: app_
s/control->\(roll\|pitch\|yaw\) = GLUE\.stock\.[a-z]*;//
