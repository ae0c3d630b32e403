# Threads that wait for others hold them up, where the cores are busy.
# file: sim/base/threads.c
# test: programs_of_many_threads_sleep
s/"passive", 0/"active", 0/
