// cpu_time.h - the time that this thread has had a processor.
//
// What a real-time factor is counted by: a busy machine, many flights at once or a clock that is set do not
// make a flight slower.
#ifndef SIM_BASE_CPU_TIME_H
#define SIM_BASE_CPU_TIME_H

// Seconds since some instant; only differences within one thread have a meaning.
double cpu_time_s(void);

// So many seconds of flight since from_s (cpu_time_s), as a ratio to real time.
double cpu_time_factor(double flight_s, double from_s);

#endif
