# A vehicle that contradicts itself takes off.
# file: src/firmware/controller.c
# test: app_
s/GLUE.flyable.not_flyable != 0;/GLUE.flyable.not_flyable > 1000000;/
