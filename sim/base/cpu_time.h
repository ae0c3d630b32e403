// cpu_time.h - the processor time of this thread.
//
// Real-time factors are measured by it, so that a busy machine, many flights at once or a clock that somebody
// sets do not make a flight look slower.
#ifndef SIM_BASE_CPU_TIME_H
#define SIM_BASE_CPU_TIME_H

// Seconds since some instant; only differences within one thread mean anything.
double cpu_time_s(void);

// The real-time factor: flight_s simulated seconds over the processor time since from_s (from cpu_time_s).
double cpu_time_factor(double flight_s, double from_s);

#endif
