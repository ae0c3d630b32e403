// client.c - notifies the client on the ground of parameters.
//
// All of this runs in the firmware's parameter task, so that nothing else is written meanwhile. A
// notification writes the value that is there anyway, which calls back; `notifying` ends those calls.
#include "client.h"

#include "FreeRTOS.h"
#include "glue.h"
#include "param.h"
#include "settings.h"
#include "task.h"

#define COMMIT_WAIT_MS 20 // a tick takes a commit within 4 ms, unless another controller flies

static void notify_whole(const char *name, uint32_t value) {
  paramSetInt(paramGetVarIdFromComplete(name), (int)value);
}

static void notify_row(const param_row_t *row) {
  const float value = params_get(&GLUE.tuned, row);
  // Of the table's two type names, PARAM_INT is the one that the firmware does not define.
  if (row->type == PARAM_INT)
    notify_whole(row->name, (uint32_t)(int32_t)value);
  else
    paramSetFloat(paramGetVarIdFromComplete(row->name), value);
}

static void notify_rows(bool weights) {
  for (int i = 0; i < params_count; i++) {
    const bool is_put_back = GLUE.put_back[i / 32] & (1u << (i % 32));
    if (is_put_back || (weights && settings_is_weight(&params_table[i]))) notify_row(&params_table[i]);
  }
  for (int i = 0; i < PUT_BACK_WORDS; i++) GLUE.put_back[i] = 0;
}

static bool is_taken(void) {
  for (int ms = 0; GLUE.commit != 0; ms += 2) {
    if (ms >= COMMIT_WAIT_MS) return false;
    vTaskDelay(M2T(2));
  }
  return true;
}

void client_wrote(void) {
  if (GLUE.notifying) return;
  const unsigned asked = GLUE.commit;
  const uint32_t sum = GLUE.weights_sum;
  const uint8_t shadow = GLUE.shadow;
  settings_touched();
  const bool done = asked != 0 && is_taken();
  GLUE.notifying = 1;
  notify_rows(done && asked == COMMIT_LEARNED);
  if (done) notify_whole("ceil.commit", 0);
  if (GLUE.shadow != shadow) notify_whole("ceil.shadow", GLUE.shadow);
  if (GLUE.weights_sum != sum) notify_whole("ceil.wSum", GLUE.weights_sum);
  GLUE.notifying = 0;
}
