// threads.h - how threads that share a program's work wait for one another.
#ifndef SIM_BASE_THREADS_H
#define SIM_BASE_THREADS_H

// Lets them sleep while they wait. To be called before main() has read, written or opened anything; argv: as
// it got it. By default gcc's OpenMP lets a thread that waits turn on the spot for some milliseconds. Beside
// other work it holds up the very thread that it waits for: a diagnosis then took five times as long on two
// cores. It is told otherwise by the environment, and reads that before main(): so the program starts itself
// anew, once. Nothing happens where the environment says already how to wait, as it should for valgrind
// (OMP_WAIT_POLICY=passive), or allows one thread only; where the program was not started by its own name, as
// by a loader; or built without OpenMP.
void threads_sleep(char **argv);

#endif
