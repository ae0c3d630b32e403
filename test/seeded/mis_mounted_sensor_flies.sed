# A vehicle that contradicts itself takes off.
# file: src/firmware/controller.c
# test: app_
s/if (!supervisorIsFlying()) flyable_step/if (false) flyable_step/
