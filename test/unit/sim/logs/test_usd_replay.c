// test_usd_replay.c - flights that the uSD deck wrote, flown again: what is the same to the bit, and what is
// not.
#include "crazyflie/sections.h"
#include "crazyflie/usd_deck.h"
#include "flight/scenario.h"
#include "logs/replay.h"
#include "rig/programs.h"
#include "rig/scratch.h"
#include "rig/test.h"
#include "rig/usd_rows.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define CONFIG "tools/usd/config.txt"

// A flight with the deck on board, as `name` in the scratch folder, and the parameters that it flew.
static usd_deck_t fly_with_deck(const char *scenario, usd_card_t card, const char *name,
                                flight_param_t *param) {
  usd_deck_t deck;
  why_t why;
  FILE *const file = fopen(scratch_path(name), "wb");
  if (!file) abort();
  CHECK_OK(usd_deck_init(&deck, CONFIG, file, &why));
  deck.card = card;
  const request_t request = {.seed = 1, .integrate = INTEGRATE_RK4, .usd = &deck};
  result_t result;
  CHECK_OK(result_init(&result, &why));
  CHECK_OK(scenario_find(scenario)->run(&request, &result, &why));
  usd_deck_stop(&deck);
  if (fclose(file) != 0) abort();
  CHECK(deck.flights == 1);
  params_default(param);
  for (int i = 0; i < params_count && result.record.param; i++)
    CHECK_OK(params_set(param, &params_table[i], result.record.param[i]));
  cJSON_Delete(result.json);
  record_free(&result.record);
  return deck;
}

static replay_t replay_of(const char *name, const flight_param_t *param) {
  replay_t r;
  why_t why = {""};
  char path[400];
  snprintf(path, sizeof path, "%s", scratch_path(name));
  CHECK_OK(replay_fly(path, param, &r, &why));
  CHECK_TEXT(why.text, "");
  return r;
}

TEST(usd_config_of_the_project_names_logs_that_the_app_has_and_all_that_a_replay_needs) {
  usd_config_t c;
  why_t why = {""};
  CHECK_OK(usd_config_read(CONFIG, &c, &why));
  CHECK_OK(usd_config_check(CONFIG, &c, &why));
  CHECK_TEXT(why.text, "");
  CHECK(c.n == 3 && !c.at_start);
  // The firmware's heap has 30,000 bytes, of which its queues take most.
  CHECK(c.buffer_bytes >= 1024 && c.buffer_bytes <= 8192);
  char name[32];
  const section_log_t *log;
  for (int i = 0; (log = sections_log_at(i, name)) != NULL; i++) {
    const bool needed = strncmp(name, "indiIn.", 7) == 0 || strncmp(name, "indiSet.", 8) == 0 ||
                        strncmp(name, "indiRec.", 8) == 0 || strncmp(name, "indi.m", 6) == 0;
    int times = 0;
    for (int e = 0; e < c.n; e++)
      for (int k = 0; k < c.event[e].n; k++) times += strcmp(c.event[e].variable[k], name) == 0;
    ROW("%s", name);
    if (strcmp(name, "indi.model") == 0) continue;
    // The stamps of state and set stand in the call's row too.
    const bool twice = strcmp(name, "indiRec.state") == 0 || strcmp(name, "indiRec.set") == 0;
    CHECK_NEAR(times, needed ? (twice ? 2 : 1) : 0, 0.0);
  }
  for (int e = 0; e < c.n; e++) CHECK(c.event[e].n <= 20);
}

#define HEAD4 "1 # version\n512\nlog\n0\n"
#define FOUR  "indiIn.p\nindiIn.q\nindiIn.r\nindiIn.ax\n"

TEST(usd_config_refuses_what_the_deck_would_skip_in_silence) {
  static const struct {
    const char *text, *want;
  } row[] = {
      {HEAD4 "on:indiCall\n" FOUR FOUR FOUR FOUR FOUR, ""},
      {HEAD4 "# a comment\n\non:indiCall # every call\n indiIn.p \n", ""},
      {HEAD4 "on:fixedFrequency\n500\n1\nindiIn.p\n", ""},
      {HEAD4 "on:indiCall\n" FOUR FOUR FOUR FOUR FOUR "indiIn.ay\n",
       "c.txt:26: `indiIn.ay`: one variable too many; the deck takes 20 an event"},
      {HEAD4 "on:indiCall\nindiIn.p\nindiIn.none\n",
       "c.txt:7: indiIn.none: the app has no such log; allowed: those of fly --logs"},
      {HEAD4 "on:indiNone\nindiIn.p\n", "c.txt:5: on:indiNone: the app triggers no such event"},
      {HEAD4 "on:indiCall\nindiIn.abcdefghijklmnopqrstuvwxyz\n",
       "c.txt:6: `indiIn.abcdefghijklmnopqrstuvwx`: too long; the deck takes 31 characters a line"},
      {HEAD4 "indiIn.p\n", "c.txt:5: `indiIn.p`: before any event; allowed: on:NAME"},
      {HEAD4 "on:indiCall\nindiIn.p",
       "c.txt:6: `indiIn.p`: the last line; allowed: one that ends with a newline"},
      {HEAD4, "c.txt: no event; allowed: one on:NAME or more"},
      {"2\n512\nlog\n0\n", "c.txt:1: `2`: the version; allowed: 1"},
      {"1\n70000\nlog\n0\n", "c.txt:2: `70000`: bytes of the buffer; allowed: a whole number up to 65535"},
      {"1\n512\nelevenchars\n0\n", "c.txt:3: `elevenchars`: the file's name; allowed: 1 to 10 characters"},
      {"1\n512\nlog\n2\n", "c.txt:4: `2`: start with the power; allowed: 0, 1"},
      {HEAD4 "on:fixedFrequency\n2000\n1\n", "c.txt:6: `2000`: the frequency; allowed: 0 to 1000 Hz"},
      {"", "c.txt:1: ``: the version; allowed: 1"},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].want[0] ? row[i].want : "good");
    usd_config_t c;
    why_t why = {""};
    const char *const path = scratch_file("c.txt", row[i].text, -1);
    done_t status = usd_config_read(path, &c, &why);
    if (status == DONE) status = usd_config_check(path, &c, &why);
    CHECK_STATUS(row[i].want[0] ? BAD_INPUT : DONE, status);
    CHECK_TEXT(scratch_short(why.text), row[i].want);
  }
}

TEST(usd_replay_of_what_the_deck_wrote_has_the_same_bits) {
  static const char *const scenario[] = {"inner-loop", "learning-flight"};
  for (unsigned i = 0; i < sizeof scenario / sizeof *scenario; i++) {
    ROW("%s", scenario[i]);
    flight_param_t param;
    const usd_deck_t deck = fly_with_deck(scenario[i], (usd_card_t){0}, "log00", &param);
    const replay_t r = replay_of("log00", &param);
    CHECK(r.first_call == 1 && r.known.calls > 60000 && r.settling.calls == 0 && r.settled.calls == 0);
    CHECK(r.known.differ == 0 && r.missing == 0 && r.torn == 0 && r.tuned_line == 0);
    CHECK_TEXT(r.damage, "");
    CHECK(deck.written == deck.asked);
  }
}

// --- what is lost -----------------------------------------------------------------------------------------

typedef struct {
  const char *what, *event; // null: of all events
  double from_s, to_s;
  bool torn; // its last byte is of another row: it stays
  // What is told of it.
  long missing_min, missing_max;
  bool incomplete;
} loss_t;

static const loss_t lost[] = {
    {"nothing", NULL, 0.0, 0.0, false, 0, 0, false},
    {"one call", "indiCall", 20.0, 20.001, false, 1, 1, false},
    // One of the estimate: what flew until the next one is not known.
    {"one estimate", "indiState", 20.0, 20.009, false, 1, 20, true},
    {"one set point, which stands for 10 s", "indiSet", 20.0, 20.101, false, 1, 100, true},
    // The hole may hold the call in which the set point was due anew.
    {"40 ms of all", NULL, 20.0, 20.04, false, 40, 110, true},
    {"0.3 s of all", NULL, 20.0, 20.3, false, 300, 400, true},
    {"2 s of all", NULL, 20.0, 22.0, false, 2000, 2100, false},
    {"the start", NULL, 0.0, 8.003, false, 0, 0, true},
    {"a call torn", "indiCall", 20.0, 20.001, true, 1, 1, false},
    {"an estimate torn", "indiState", 20.0, 20.009, true, 1, 20, true},
};

static bool keep(void *context, const char *event, double t_s, unsigned char *value, size_t n) {
  const loss_t *const l = context;
  if (l->event && strcmp(event, l->event) != 0) return true;
  if (!(t_s >= l->from_s - 1e-9 && t_s < l->to_s - 1e-9)) return true;
  if (l->torn) value[n - 1] ^= 1;
  return l->torn;
}

TEST(usd_replay_says_what_is_lost_and_is_back_to_half_a_millinewton_within_a_second) {
  flight_param_t param;
  (void)fly_with_deck("test-flight", (usd_card_t){0}, "log00", &param);
  for (unsigned i = 0; i < sizeof lost / sizeof *lost; i++) {
    const loss_t *const l = &lost[i];
    ROW("%s", l->what);
    const bool any = l->to_s > 0.0, start = l->from_s <= 0.0;
    loss_t context = *l;
    const long left_out = usd_rows_edit("log00", "log01", keep, &context);
    CHECK(l->torn ? left_out == 0 : any == (left_out > 0));
    const replay_t r = replay_of("log01", &param);
    CHECK(r.missing >= l->missing_min && r.missing <= l->missing_max);
    CHECK(l->torn ? r.torn >= 1 && r.torn <= 3
                  : r.torn == 0); // a range sample or a row anew may fall between
    CHECK((r.incomplete > 0) == l->incomplete);
    CHECK((r.first_call > 1) == (any && start));
    // What the history is known of is the same to the bit.
    CHECK(r.known.differ == 0);
    CHECK((r.known.calls > 19990) == !(any && start));
    CHECK_NEAR(r.settling.calls, any ? REPLAY_SETTLE_CALLS : 0.0, 0.0);
    // 20 mN are a quarter of what a motor gives in hover: the filters start from what they first see, and the
    // law answers with quick times kdz.
    CHECK(r.settling.worst_N < 2e-2);
    CHECK((r.settled.calls > 15000) == any);
    // The observer of the accelerometer's bias forgets at 1 rad/s: without it 1e-7 N are left.
    CHECK(r.settled.worst_N < 5e-4);
  }
}

TEST(usd_replay_follows_a_card_that_loses_rows) {
  flight_param_t param;
  // 150 kB/s, busy for 20 ms every 3 s: the 4096 bytes of the buffer last 45 ms. Then for 80 ms: rows are
  // lost.
  static const struct {
    usd_card_t card;
    bool loses;
  } row[] = {
      {{150e3, 0.02, 3.0}, false},
      {{150e3, 0.08, 3.0}, true},
      {{80e3, 0.0, 0.0}, true},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("busy for %g s, %g B/s", row[i].card.busy_s, row[i].card.speed_Bps);
    const usd_deck_t deck = fly_with_deck("test-flight", row[i].card, "log00", &param);
    const replay_t r = replay_of("log00", &param);
    CHECK((deck.written < deck.asked) == row[i].loses);
    CHECK((r.missing > 0) == row[i].loses);
    CHECK(r.known.calls > 0 && r.known.differ == 0);
    CHECK(r.settled.worst_N < 2.5e-4);
  }
}

TEST(usd_replay_sees_another_parameter_and_a_file_that_is_cut_off) {
  flight_param_t param;
  (void)fly_with_deck("test-flight", (usd_card_t){0}, "log00", &param);
  param.att.kp_per_s *= 1.1f;
  CHECK(replay_of("log00", &param).known.differ > 1000);
  char text[400];
  CHECK(program_run("head -c 2000000 $S/log00 >$S/cut && fly --replay $S/cut", STREAM_OUTPUT, text,
                    sizeof text) == 0);
  CHECK(strstr(text, "the file is cut off\n") != NULL);
}

TEST(usd_replay_is_what_fly_does) {
  static const struct {
    const char *shell;
    int status;
    stream_t stream;
    const char *want;
  } row[] = {
      {"fly test-flight --integrator rk4 --usd $S/log --usd-config " CONFIG
       " --params-to $S/p >$S/said && fly --replay $S/log --set-from $S/p",
       0, STREAM_OUTPUT,
       "42002 calls replayed, 0 between them left out, 0 differ in a motor's command, by 0 N at most\n"},
      {"fly test-flight --usd $S/log2", 2, STREAM_ERROR,
       "fly: --usd, --usd-config: both are needed; the config is tools/usd/config.txt\n"},
      {"fly learning-1d --usd $S/log2 --usd-config " CONFIG, 2, STREAM_ERROR,
       "fly: --usd: 0 flights of the app in 6-DoF; allowed is one\n"},
      {"fly test-flight --controller stock-pid --usd $S/log2 --usd-config " CONFIG, 2, STREAM_ERROR,
       "fly: --usd: 0 flights of the app in 6-DoF; allowed is one\n"},
      {"fly test-flight --seeds 2 --usd $S/log2 --usd-config " CONFIG, 2, STREAM_ERROR,
       "fly: --usd: one flight can be written; leave out --seeds\n"},
      {"test ! -e $S/log2", 0, STREAM_OUTPUT, ""},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    char text[600];
    ROW("%s", row[i].shell);
    CHECK_NEAR(program_run(row[i].shell, row[i].stream, text, sizeof text), row[i].status, 0.0);
    CHECK_TEXT(text, row[i].want);
  }
}
