// abreast.h - many flights in one thread, whose vehicles are moved eight at a time. Each gets the bits that
// it gets alone.
//
// A flight is any function that calls body_tick(), whatever it does in between; where it calls, it waits for
// the others. Those that are alike (effects that are on, lag, integrator, length of the tick) and away from
// surfaces are moved together (body/lanes.h), the others one by one. Effects with measured points
// (form=table), or that are in no table, always are.
#ifndef SIM_BODY_ABREAST_H
#define SIM_BODY_ABREAST_H

// Fewer are moved one by one: five take as long together (fly close-flight --from 1 --to 5, one thread), two
// half as long again, for what is computed is computed for eight.
#define ABREAST_FEWEST 6

// Calls flight(context, i), i from 0 to n-1; the calls overlap. Where the processor cannot do it, or there is
// no memory, they come one after the other. Returns how many ticks of a vehicle were moved with others.
long abreast(int n, void (*flight)(void *context, int i), void *context);

#endif
