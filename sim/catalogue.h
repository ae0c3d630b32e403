// catalogue.h - what there is to fly, for people: on standard output.
#ifndef SIM_CATALOGUE_H
#define SIM_CATALOGUE_H

// Scenarios, controllers, effects with their forms and parameters, noise levels.
void catalogue_all(void);

// Every parameter of the flight code: unit, default, range, what it does.
void catalogue_params(void);

#endif
