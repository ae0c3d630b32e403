// test_logs_page.c - the files that LOGS.md tells a newcomer to write are accepted.
#include "logs/columns.h"
#include "rig/test.h"
#include "vehicle/model_file.h"

#include <stdio.h>
#include <string.h>

// Copies the block of the page that begins with this line.
static bool block_of(const char *first, char *text, size_t size) {
  FILE *const page = fopen("sim/gap/LOGS.md", "r");
  char line[600];
  size_t used = 0;
  bool in = false, ended = false;
  if (!page) return false;
  while (!ended && fgets(line, sizeof line, page)) {
    in = in || strcmp(line, first) == 0;
    ended = in && strncmp(line, "```", 3) == 0;
    if (in && !ended) used += (size_t)snprintf(text + used, size - used, "%s", line);
  }
  fclose(page);
  return ended;
}

TEST(logs_page_has_a_vehicle_of_another_simulator) {
  char text[2000];
  model_t m;
  why_t why = {""};
  CHECK(block_of("name = \"mine\"\n", text, sizeof text));
  CHECK_OK(model_read_text("mine.toml", text, &m, &why));
  CHECK_TEXT(why.text, "");
  CHECK(m.frame_told && m.map.kind == THRUST_MAP_SPEED);
}

TEST(logs_page_has_the_vehicle_of_crazyflow) {
  char text[2000];
  model_t m;
  why_t why = {""};
  CHECK(block_of("name = \"crazyflow cf2x_L250\"\n", text, sizeof text));
  CHECK_OK(model_read_text("crazyflow.toml", text, &m, &why));
  CHECK_TEXT(why.text, "");
  CHECK(m.frame_told && m.map.kind == THRUST_MAP_SPEED);
}

// Crazyflow's commands are means, which acted before their row.
TEST(logs_page_has_columns_of_crazyflow) {
  columns_t c;
  why_t why = {""};
  CHECK_OK(columns_read("tools/columns/crazyflow.toml", &c, &why));
  CHECK_TEXT(why.text, "");
  CHECK(c.acc == ACC_WORLD && c.motors == MOTORS_RADPS && !c.rows_are_means);
  CHECK_NEAR(c.of[SIG_M1].late_s, 0.005, 1e-12);
  CHECK(c.of[SIG_AX].optional && !c.of[SIG_QW].optional);
}

// These are rotorpy's own names, so that its user writes nothing.
TEST(logs_page_has_columns_of_another_simulator) {
  columns_t c;
  why_t why = {""};
  CHECK_OK(columns_read("tools/columns/rotorpy.toml", &c, &why));
  CHECK_TEXT(why.text, "");
  CHECK(c.motors == MOTORS_RADPS && !c.rows_are_means);
  CHECK_TEXT(c.of[SIG_M4].column, "r4des");
  CHECK(c.of[SIG_SET_X].optional && !c.of[SIG_M1].optional);
}
