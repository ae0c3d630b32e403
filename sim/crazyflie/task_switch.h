// task_switch.h - one task of the firmware beside the stabilizer: a function that never returns and rests by
// vTaskDelay, run for as long as it wants and no longer, in the thread of its caller.
#ifndef SIM_CRAZYFLIE_TASK_SWITCH_H
#define SIM_CRAZYFLIE_TASK_SWITCH_H

#include <stdbool.h>
#include <stdint.h>

typedef struct task_switch task_switch_t;

// A null pointer: no memory.
task_switch_t *task_open(void (*task)(void));
void task_close(task_switch_t *t);

// Runs it, if it is due, until it rests.
void task_run(task_switch_t *t, uint32_t now_ms);

// In the task: it rests for so long.
void task_rest(task_switch_t *t, uint32_t ms);

bool task_runs(const task_switch_t *t);

#endif
