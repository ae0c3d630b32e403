// law.h - what the tests of the position law share: its parameters.
#ifndef TEST_RIG_LAW_H
#define TEST_RIG_LAW_H

#include "flight/pos_indi.h"

#define LAW_PI 3.14159265358979323846

static const pos_indi_param_t law_param = {.kp_per_s = 1.0f,
                                           .kd_per_s = 5.0f,
                                           .kp_z_per_s = 1.0f,
                                           .kd_z_per_s = 5.0f,
                                           .quick = 1.0f,
                                           .law = LAW_THESIS,
                                           .mass_kg = 0.032f,
                                           .lead_s = 0.3f,
                                           .thrust_max_N = 0.6f,
                                           .thrust_floor = 0.4f,
                                           .tilt_max_rad = 0.35f,
                                           .acc_max_mps2 = 20.0f};

#endif
