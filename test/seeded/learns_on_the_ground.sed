# Lessons on the ground.
# file: src/firmware/controller.c
# test: app_
s/in->no_lesson = !supervisorIsFlying();/in->no_lesson = false;/
