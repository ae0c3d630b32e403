// orders.c - the commands of eight bodies, as rows.
#include "body/orders.h"

#define ROW(tick) ((tick) % ORDERS_DELAY)

bool orders_suffice(const body_t *b) {
  return b->n_tick == 0 && b->rigid.motor_tau_s >= LAG_LEAST_S && !b->broken &&
         body_delay_ticks(b) < ORDERS_DELAY;
}

void orders_begin(orders_t *o, int k, const body_t *b) {
  o->least_N[k] = b->model->thrust_min_N / ROTORS;
  o->most_N[k] = b->model->thrust_max_N / ROTORS;
  o->t_s[k] = b->t_s;
  o->queued[k] = b->queued;
  o->delay[k] = body_delay_ticks(b);
  for (unsigned j = 1; j <= o->delay[k]; j++)
    for (int i = 0; i < ROTORS; i++)
      o->command_N[ROW(o->tick - j)][i][k] = b->queue_N[(b->queued - j) % BODY_QUEUE][i];
}

void orders_take(orders_t *o, const double *command_N, double *applied_N) {
  double(*const now_N)[LANES] = o->command_N[ROW(o->tick)];
  for (int i = 0; i < ROTORS; i++)
    for (int k = 0; k < LANES; k++) { // NaN becomes the minimum
      const double N = command_N[LANES * i + k], more_N = N > o->least_N[k] ? N : o->least_N[k];
      applied_N[LANES * i + k] = now_N[i][k] = more_N < o->most_N[k] ? more_N : o->most_N[k];
    }
  for (int i = 0; i < ROTORS; i++)
    for (int k = 0; k < LANES; k++) o->due_N[i][k] = o->command_N[ROW(o->tick - o->delay[k])][i][k];
  for (int k = 0; k < LANES; k++) o->queued[k]++;
  o->tick++;
}

void orders_end(orders_t *o, unsigned in, double span_s) {
  for (int k = 0; k < LANES; k++) o->t_s[k] += span_s;
  o->ahead |= in;
}

// Of the queue, only the commands that the next ticks need.
void orders_give(orders_t *o, int k, body_t *b) {
  if (!(o->ahead >> k & 1)) return;
  o->ahead &= ~(1u << k);
  b->t_s = o->t_s[k];
  b->queued = o->queued[k];
  for (int i = 0; i < ROTORS; i++) {
    b->command_N[i] = o->command_N[ROW(o->tick - 1)][i][k];
    b->rigid.command_N[i] = o->due_N[i][k];
    for (unsigned j = 1; j <= o->delay[k]; j++)
      b->queue_N[(b->queued - j) % BODY_QUEUE][i] = o->command_N[ROW(o->tick - j)][i][k];
  }
}
