// catalogue.h - prints what there is to fly to standard output, for people.
#ifndef SIM_FLIGHT_CATALOGUE_H
#define SIM_FLIGHT_CATALOGUE_H

#include <stdbool.h>

// Scenarios, controllers, effects with their forms and parameters, noise levels.
void catalogue_all(void);

// Every effect, as a table in Markdown: what it is, what it does, its numbers.
void catalogue_effects(void);

// Every parameter of the flight code: unit, default, range, what it does; aligned, or as a table in Markdown.
void catalogue_params(bool markdown);

// Every log of the app, as a table in Markdown, a row for each group.
void catalogue_logs(void);

#endif
