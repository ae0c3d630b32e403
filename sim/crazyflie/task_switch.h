// task_switch.h - one task of the firmware beside the stabilizer, as a coroutine: a function that never
// returns and rests in vTaskDelay. It runs in the thread of its caller, from one rest to the next.
#ifndef SIM_CRAZYFLIE_TASK_SWITCH_H
#define SIM_CRAZYFLIE_TASK_SWITCH_H

#include <stdbool.h>
#include <stdint.h>

typedef struct task_switch task_switch_t;

// Null: no memory.
task_switch_t *task_open(void (*task)(void));
void task_close(task_switch_t *t);

// Runs the task, if it is due, until it rests.
void task_run(task_switch_t *t, uint32_t now_ms);

// Called from within the task: rests for ms.
void task_rest(task_switch_t *t, uint32_t ms);

bool task_runs(const task_switch_t *t);

#endif
