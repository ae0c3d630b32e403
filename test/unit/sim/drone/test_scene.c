// test_scene.c - where drones of the desk fly, and what happens to them there.
#include "rig/desk_drone.h"
#include "rig/scratch.h"
#include "rig/test.h"
#include <math.h>
#include <string.h>

TEST(a_motor_s_damage_is_the_scene_s_until_another_is_asked_for) {
  static const char text[] = "[[effect]]\nis = \"motor_damage:rotor=1,loss=0.3\"\n";
  static const char *const scene_text[] = {"", text};
  double yaw_moment[2];
  for (int i = 0; i < 2; i++) {
    drone_t *const d = desk_drone_in(scene_text[i]);
    why_t why;
    const fx_use_t *const use = model_fx(loop_model(d->loop), fx_find("motor_damage"));
    yaw_moment[i] = use->p[1];
    CHECK_OK(drone_set(d, "weakMotor", 2.0, &why));
    desk_pass(d, 0.1);
    CHECK_NEAR(use->p[0], 2, 0);
    CHECK_NEAR(use->p[1], 0.2, 1e-6);
    CHECK_OK(drone_set(d, "weakMotor", 0.0, &why));
    desk_pass(d, 0.1);
    CHECK(use->p[1] == yaw_moment[i]);
    desk_end(d);
  }
  CHECK(yaw_moment[0] == 0.0 && yaw_moment[1] == 0.3);
}

TEST(events_of_a_scene_happen_when_they_should_and_again_after_a_restart) {
  static const char text[] =
      "[[event]]\nat_s = 2.0\nset = \"windX=30\"\n[[event]]\nat_s = 3.0\nset = \"windX=0\"\n";
  drone_t *const d = desk_drone_in(text);
  for (int flight = 0; flight < 2; flight++) {
    static const double at_s[] = {1.5, 2.5, 3.5}, want[] = {0.0, 30.0, 0.0};
    for (int i = 0; i < 3; i++) {
      ROW("flight %d, %g s", flight, at_s[i]);
      desk_pass(d, i == 0 ? 1.5 : 1.0);
      CHECK_NEAR(d->params.windX, want[i], 0);
    }
    desk_set(d, "desk.restart", 1);
  }
  desk_end(d);
}

TEST(a_wall_of_a_scene_is_touched) {
  static const char *const row[] = {"", "wall_y_m = 0.25\n"};
  double y_m[2];
  for (int i = 0; i < 2; i++) {
    drone_t *const d = desk_drone_in(row[i]);
    why_t why;
    desk_pass(d, 1.0);
    desk_climb(d, 0.6f);
    desk_pass(d, 3.0);
    CHECK_OK(drone_set(d, "windY", 60.0, &why));
    y_m[i] = -1.0;
    for (int ms = 0; ms < 2000; ms += 20) {
      desk_pass(d, 0.02);
      y_m[i] = fmax(y_m[i], desk_log(d, "desk.y"));
    }
    desk_end(d);
  }

  CHECK(y_m[0] > 0.35 && y_m[1] > 0.1 && y_m[1] < 0.25);
}

TEST(a_scene_is_what_its_file_says) {
  static const char text[] =
      "vehicle = \"cf21_plus\"\nnoise = \"flown\"\nseed = 7\nceiling_m = 0.8\nbattery = 0.5\n"
      "[[effect]]\nis = \"mass:add=0.003,start=20\"\n";
  scene_t scene;
  why_t why = {""};
  CHECK_OK(scene_default(&scene, &why));
  CHECK_OK(scene_read(scratch_file("scene.toml", text, -1), &scene, &why));
  CHECK_TEXT(why.text, "");
  CHECK_NEAR(scene.setup.model.ceiling_m, 0.8, 0);
  CHECK_NEAR(scene.battery, 0.5, 0);
  CHECK(scene.seed == 7);
  CHECK(model_fx(&scene.setup.model, fx_find("mass")) != NULL);
  CHECK(scene.setup.plan.noise.vary.mass > 0.0);
}

TEST(a_scene_that_is_none_is_refused_with_its_line) {
  static const struct {
    const char *text, *says;
  } row[] = {
      {"celing_m = 1.0\n", "celing_m"},
      {"ceiling_m = -1.0\n", "scene.toml:1: ceiling_m"},
      {"\nnoise = \"loud\"\n", "scene.toml:2: noise"},
      {"vehicle = \"cf99\"\n", "vehicle: cf99: allowed is one of sim/vehicle/vehicles"},
      {"[[effect]]\nis = \"magic\"\n", "scene.toml:2: is"},
      {"battery = 2\n", "battery"},
      {"seed = 1.5\n", "seed: 1.5; allowed: a whole number"},
      {"[[event]]\nat_s = 1\nset = \"wind=1\"\n", "scene.toml:3: set: wind: there is no such parameter"},
      {"[[event]]\nat_s = 1\nset = \"cover=0.5\"\n", "set: desk.cover: allowed is a whole number"},
      {"[[event]]\nat_s = 1\nset = \"cover\"\n", "set: cover; allowed: NAME=VALUE"},
      {"[[event]]\nat_s = 2\nset = \"cover=1\"\n[[event]]\nat_s = 1\nset = \"cover=0\"\n",
       "scene.toml:5: at_s"},
      {"battery\n", "scene.toml:1"}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].text);
    scene_t scene;
    why_t why = {""};
    CHECK_OK(scene_default(&scene, &why));
    CHECK_STATUS(BAD_INPUT, scene_read(scratch_file("scene.toml", row[i].text, -1), &scene, &why));
    if (!CHECK(strstr(why.text, row[i].says) != NULL)) CHECK_TEXT(why.text, row[i].says);
  }
}
