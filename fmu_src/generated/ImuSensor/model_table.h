/* Generated from the block ImuSensor; do not edit. */
#ifndef MODEL_TABLE_H
#define MODEL_TABLE_H

#include <math.h>

#include "block.h"

#define MODEL_NAME "ImuSensor"
#define MODEL_TOKEN "{ac87dd89-e758-1d36-c337-8f79c8f8c443}"
#define MODEL_STEP step
#define MODEL_INITIAL initial
#define MODEL_SEED UINT64_C(0)

enum {
    N_INPUTS = 7,
    N_PARAMETERS = 10,
    N_OUTPUTS = 6,
    N_STATES = 3,
    N_NOISE = 6,
    N_VARIABLES = 26
};

/* Room that the generated functions need. */
enum { WORK_ARG = 5, WORK_RES = 2, WORK_IW = 0, WORK_W = 8 };

/* Places in the table of variables, which are value references. */
enum {
    TIME = 0,
    FIRST_INPUT = TIME + 1,
    FIRST_PARAMETER = FIRST_INPUT + N_INPUTS,
    FIRST_OUTPUT = FIRST_PARAMETER + N_PARAMETERS,
    SAMPLE_PERIOD = FIRST_OUTPUT + N_OUTPUTS,
    SEED = SAMPLE_PERIOD + 1
};

static const BlockVariable variables[] = {
    {"time", KIND_REAL, ROLE_TIME, 0.0},
    {"rate[1]", KIND_REAL, ROLE_INPUT, 0.0},
    {"rate[2]", KIND_REAL, ROLE_INPUT, 0.0},
    {"rate[3]", KIND_REAL, ROLE_INPUT, 0.0},
    {"specific_force[1]", KIND_REAL, ROLE_INPUT, 0.0},
    {"specific_force[2]", KIND_REAL, ROLE_INPUT, 0.0},
    {"specific_force[3]", KIND_REAL, ROLE_INPUT, 9.80665},
    {"temperature", KIND_REAL, ROLE_INPUT, 25.0},
    {"gyro_error.thermal_bias.kT[1]", KIND_REAL, ROLE_TUNABLE, 0.00034906585039886593},
    {"gyro_error.thermal_bias.kT[2]", KIND_REAL, ROLE_TUNABLE, 0.0009773843811168245},
    {"gyro_error.thermal_bias.kT[3]", KIND_REAL, ROLE_TUNABLE, 0.0008726646259971648},
    {"gyro_error.thermal_bias.T0", KIND_REAL, ROLE_TUNABLE, 25.0},
    {"gyro_error.angle_random_walk.N[1]", KIND_REAL, ROLE_TUNABLE, 6.0400027647350424e-05},
    {"gyro_error.angle_random_walk.N[2]", KIND_REAL, ROLE_TUNABLE, 6.940010882346785e-05},
    {"gyro_error.angle_random_walk.N[3]", KIND_REAL, ROLE_TUNABLE, 5.960008507351969e-05},
    {"gyro_error.rate_random_walk.K[1]", KIND_REAL, ROLE_TUNABLE, 2.6503147900654633e-06},
    {"gyro_error.rate_random_walk.K[2]", KIND_REAL, ROLE_TUNABLE, 4.007793097172164e-06},
    {"gyro_error.rate_random_walk.K[3]", KIND_REAL, ROLE_TUNABLE, 5.187506387872035e-06},
    {"gyro[1]", KIND_REAL, ROLE_OUTPUT, 0.0},
    {"gyro[2]", KIND_REAL, ROLE_OUTPUT, 0.0},
    {"gyro[3]", KIND_REAL, ROLE_OUTPUT, 0.0},
    {"accel[1]", KIND_REAL, ROLE_OUTPUT, 0.0},
    {"accel[2]", KIND_REAL, ROLE_OUTPUT, 0.0},
    {"accel[3]", KIND_REAL, ROLE_OUTPUT, 0.0},
    {"sample_period", KIND_REAL, ROLE_FIXED, 0.0010245901639344263},
    {"seed", KIND_SEED, ROLE_FIXED, 0.0},
};

/* The noise stream of each channel. */
static const uint64_t noise_channels[] = {
    UINT64_C(2090672062), /* gyro_error.angle_random_walk.w[1] */
    UINT64_C(1471171709), /* gyro_error.angle_random_walk.w[2] */
    UINT64_C(1319861564), /* gyro_error.angle_random_walk.w[3] */
    UINT64_C(269997735), /* gyro_error.rate_random_walk.w[1] */
    UINT64_C(993690980), /* gyro_error.rate_random_walk.w[2] */
    UINT64_C(572634149), /* gyro_error.rate_random_walk.w[3] */
};

#endif
